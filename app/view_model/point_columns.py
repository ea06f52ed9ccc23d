"""The columns of the point table: a record for each. No Qt.

Table, header, tooltips, widths, copying, typing, filling, pasting and resetting read these records.

To add a column: a record in `COLUMNS`, with `get` and, where the number can be changed, `set`::

    Column(name="r", tip="Distance from the origin", get=distances, set=at_distance)

A column with an `order` is a part of a point, from which pasted rows make new points. One without is a number
of its own: a paste fills it afterwards, or skips it where it is computed; Delete calls `reset`. `derivatives`
limits it to families with derivatives. ``tests/gui/test_table_columns.py`` adds two.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from functools import partial
from itertools import pairwise

import msgspec
import numpy as np
from msgspec.structs import replace

from curvecore.arrays import BoolArray, FloatArray

from ..document import limits, point_edits, rule_edits
from ..document.constraints import is_straight_beside, with_derivative
from ..document.derivatives import DERIVATIVES, Derivative
from ..document.limits import EditError, not_after
from ..document.model import Curve, Document, Vector
from .curve.curve_view import CurveView
from .curve.handles import handle_offsets, with_length_or_angle

PARAMETER, POSITION = -1, 0
"""Orders of columns that are no derivatives."""

_SAME = 1e-9
"""Share of the largest derivative of an order up to which both sides of a point are the same."""


def _nothing_estimated(view: CurveView) -> BoolArray:
    return np.zeros(len(view.source.points), dtype=bool)


class Column(msgspec.Struct, frozen=True, kw_only=True):
    """A column of the point table.

    Attributes
    ----------
    name
        Its name on the screen.
    tip
        Its content, in words.
    get
        Returns its numbers (n,), one for each point, in the plane of the document; NaN where there is none.
    set
        Returns the document (document, curve, view, index, value) with another number for one point, given
        the view of the old curve; None if the numbers are computed. Raises `EditError` with the reason.
    set_many
        The same for several points at once (document, curve, view, values by index), where that differs from
        setting one after the other.
    is_estimated
        Returns the mask of the numbers (n,) that a rule estimates.
    estimate
        Returns the name of that rule.
    reset
        Returns the document (document, curve, indices) in which a rule estimates the numbers of some points
        again; None for a column without estimates.
    after
        Returns the number after a point that is a corner, where `get` returns the one before it; None if a
        corner has one number.
    label
        Its name in sentences: "length of the handle ahead"; empty where `name` says it.
    is_of_handle
        Whether it is displayed only where handles are to be shown by length and angle.
    order, component
        The datum of a point: -1 its parameter, 0 its position, from 1 on its derivatives,
        and 0 for x, 1 for y; order None for anything else.
    derivatives
        The least number of derivatives of a family that shows the column; one that needs some is written with
        as few digits as they are.
    more_digits
        Digits beyond those: an angle has three before the point.
    """

    name: str
    tip: str
    get: Callable[[CurveView], FloatArray]
    set: Callable[[Document, int, CurveView, int, float], Document] | None = None
    set_many: Callable[[Document, int, CurveView, Mapping[int, float]], Document] | None = None
    is_estimated: Callable[[CurveView], BoolArray] = _nothing_estimated
    estimate: Callable[[Curve], str] | None = None
    reset: Callable[[Document, int, Collection[int]], Document] | None = None
    after: Callable[[CurveView, int], float] | None = None
    label: str = ""
    is_of_handle: bool = False
    order: int | None = None
    component: int = 0
    derivatives: int = 0
    more_digits: int = 0

    @property
    def title(self) -> str:
        """Its name above a pasted block of numbers, in lower case."""
        return self.name.lower()

    @property
    def is_derivative(self) -> bool:
        """Whether the column is a derivative of the point, which a rule may estimate."""
        return self.order is not None and self.order > POSITION

    @property
    def is_position(self) -> bool:
        """Whether the column is a coordinate or the parameter of the point."""
        return self.order is not None and self.order <= POSITION

    def at(self, index: int) -> str:
        """Return the name of its number of a point: "x of point 3"."""
        return f"{self.label or self.name} of point {index}"

    def put(self, document: Document, curve: int, view: CurveView, values: Mapping[int, float]) -> Document:
        """Return the document with other numbers, by the indices of their points.

        Raises
        ------
        EditError
            If they are computed, or a document may not hold them.
        """
        if self.set is None:
            raise EditError(f"{self.name} is computed and cannot be set.")
        if self.set_many is not None:
            return self.set_many(document, curve, view, values)
        for index, value in values.items():
            # An empty cell, of a handle that a point has not, leaves it without.
            if not np.isnan(value):
                document = self.set(document, curve, view, index, value)
        return document


def columns_of(derivatives: int, *, with_handles: bool = False) -> tuple[Column, ...]:
    """Return the columns of a family whose points have so many derivatives."""
    return tuple(
        column
        for column in COLUMNS
        if column.derivatives <= derivatives and (with_handles or not column.is_of_handle)
    )


def known_titles() -> set[str]:
    """Return the titles that may stand above a block of numbers."""
    return {column.title for column in COLUMNS}


# The parameter


def _displayed_parameters(view: CurveView) -> FloatArray:
    count = len(view.source.points)
    if view.is_current:
        return np.array(view.parameters[:count])
    if view.source.is_manual:
        return np.array(view.arrays.times)
    return np.full(count, np.nan)


def _set_parameter(document: Document, curve: int, view: CurveView, index: int, t: float) -> Document:
    return rule_edits.set_parameter(document, curve, index, t, knot_parameters(view))


def _set_parameters(document: Document, curve: int, view: CurveView, values: Mapping[int, float]) -> Document:
    """Return the document with manual parameters, the given ones among them; appended points need theirs."""
    count = len(document.curves[curve].points)
    present = [] if len(values) == count else _parameters_in_force(view)[: len(view.source.points)]
    parameters = [
        limits.checked(float(values[index]), "A t") if index in values else present[index]
        for index in range(count)
    ]
    for index, (before, after) in enumerate(pairwise(parameters), start=1):
        if not after > before:
            raise not_after(index, parameters)
    if view.source.is_closed:
        parameters = [*parameters, _closing(view, parameters)]
    return rule_edits.freeze_parameters(document, curve, parameters)


def _closing(view: CurveView, parameters: Sequence[float]) -> float:
    """Return the parameter of the return to the start: the present one, or a mean step after the last."""
    end, last = view.source.parametrization.end, parameters[-1]
    return end if end > last else last + (last - parameters[0]) / (len(parameters) - 1)


def knot_parameters(view: CurveView) -> list[float]:
    """Return the parameters at the knots: of a closed curve also that of its return to the first point."""
    parameters = _parameters_in_force(view)[: len(view.source.points)]
    return [*parameters, view.source.parametrization.end] if view.source.is_closed else parameters


def _parameters_in_force(view: CurveView) -> list[float]:
    """Return the present parameters; of a closed curve, that of the return included."""
    if view.is_current:
        return [float(t) for t in view.parameters]
    given = [point.t for point in view.source.points if view.source.is_manual and point.t is not None]
    if len(given) < len(view.source.points):
        raise EditError(f"There are no parameters to change. {view.problem}")
    return given


# Position and derivatives: vectors, each with two columns


def shows_ahead(view: CurveView, index: int) -> bool:
    """Whether the table has the derivatives after a corner: at the first point, which has no others.

    At every other corner the table has those before it.
    """
    return index == 0 and not view.source.is_closed and view.source.points[0].corner


def _positions(component: int, view: CurveView) -> FloatArray:
    return np.array(view.points[:, component])


def with_component(vector: Vector, component: int, value: float) -> Vector:
    """Return `vector` with another x (component 0) or y (1)."""
    return (value, vector[1]) if component == 0 else (vector[0], value)


def _set_position(
    component: int, document: Document, curve: int, _view: CurveView, index: int, value: float
) -> Document:
    position = document.curves[curve].points[index].position
    return point_edits.set_position(document, curve, index, with_component(position, component, value))


def _set_positions(
    component: int, document: Document, curve: int, _view: CurveView, values: Mapping[int, float]
) -> Document:
    """Return the document with moved points; unlike a typed coordinate, handles of others may change."""
    points = list(document.curves[curve].points)
    for index, value in values.items():
        x, y = with_component(points[index].position, component, float(value))
        points[index] = replace(points[index], x=x, y=y)
    return point_edits.set_points(document, curve, points)


def _given(order: int, component: int, view: CurveView) -> FloatArray:
    """Return the derivatives that the person set, on the side in the table, (n,); NaN for others."""
    given = view.arrays.given[:, :, order - 1, component]
    displayed = np.array(given[:, 0])
    if len(displayed) and shows_ahead(view, 0):
        displayed[0] = given[0, 1]
    return displayed


def _derivatives(order: int, component: int, view: CurveView) -> FloatArray:
    if not view.is_current:
        return _given(order, component, view)
    count = len(view.source.points)
    if view.sides is None:
        return np.full(count, np.nan)
    displayed = np.array(view.sides.before[:count, order, component])
    displayed[0] = view.sides[shows_ahead(view, 0)][0, order, component]
    return displayed


def _derivative_after(order: int, component: int, view: CurveView, index: int) -> float:
    return np.nan if view.sides is None else float(view.sides.after[index, order, component])


def sides_differ(view: CurveView, index: int, order: int) -> bool:
    """Return whether the derivative before a point is another than that after it, beyond rounding."""
    if view.sides is None or index not in view.two_sided:
        return False
    before, after = (side[:, order] for side in view.sides)
    jump = np.abs(before[index] - after[index]).max()
    return bool(jump and jump > _SAME * np.abs(after).max())


def _set_derivatives(
    order: int, component: int, document: Document, curve: int, view: CurveView, values: Mapping[int, float]
) -> Document:
    """Return the document with one component of derivatives set; the other component stays as displayed.

    Where both sides of a point are equal, as at a new corner, both are set.
    """
    old = document.curves[curve]
    points = list(old.points)
    for index, value in values.items():
        ahead, differ = shows_ahead(view, index), sides_differ(view, index, order)
        present = points[index].explicit_sides(order)[ahead] or view.derivative_of(index, order, ahead=ahead)
        if present is None:
            raise EditError(f"The other component cannot be estimated. {view.problem}")
        given = with_component(present, component, float(value))
        point = with_derivative(old, index, order, given, ahead=ahead)
        if point.corner and not differ and not is_straight_beside(old, index, ahead=not ahead):
            both = (DERIVATIVES[order - 1].name, DERIVATIVES[order - 1].after)
            point = replace(point, **dict.fromkeys(both, point.explicit_sides(order)[ahead]))
        points[index] = point
    return point_edits.set_points(document, curve, points)


# Handles: the same derivatives, by length and angle of the line that is dragged


def _lengths(order: int, ahead: bool, view: CurveView) -> FloatArray:
    return np.asarray(np.hypot(*handle_offsets(view, order, ahead=ahead).T))


def _angles(order: int, ahead: bool, view: CurveView) -> FloatArray:
    """Return the degrees of handles, counterclockwise from x, (n,); NaN where the length is 0."""
    x, y = handle_offsets(view, order, ahead=ahead).T
    # Without a negative zero, which would be −180°.
    return np.where((x == 0.0) & (y == 0.0), np.nan, np.degrees(np.arctan2(y + 0.0, x)))


def _set_handle(
    order: int,
    ahead: bool,
    changed: str,
    document: Document,
    curve: int,
    view: CurveView,
    index: int,
    value: float,
) -> Document:
    given = document.curves[curve].points[index].explicit_sides(order)[ahead]
    present = given or view.derivative_of(index, order, ahead=ahead) or (0.0, 0.0)
    derivative = with_length_or_angle(view, index, order, present, ahead=ahead, **{changed: value})
    return point_edits.set_derivative(document, curve, index, order, derivative, ahead=ahead)


# The records


def _position_column(component: int) -> Column:
    axis = "xy"[component]
    return Column(
        name=axis,
        tip=f"Position, {axis}",
        get=partial(_positions, component),
        set=partial(_set_position, component),
        set_many=partial(_set_positions, component),
        order=POSITION,
        component=component,
    )


def _reset(order: int, document: Document, curve: int, indices: Collection[int]) -> Document:
    return point_edits.clear_derivatives(document, curve, indices, (order,))


def _derivative_column(derivative: Derivative, component: int) -> Column:
    order, axis = derivative.order, "xy"[component]
    set_many = partial(_set_derivatives, order, component)
    return Column(
        name=f"{derivative.letter}{axis}",
        tip=f"{derivative.name.capitalize()} {derivative.unit}, {axis}",
        get=partial(_derivatives, order, component),
        set=lambda document, curve, view, index, value: set_many(document, curve, view, {index: value}),
        set_many=set_many,
        is_estimated=lambda view: np.isnan(_given(order, 0, view)),
        estimate=lambda curve: str(getattr(curve, derivative.rule_field).estimate),
        reset=partial(_reset, order),
        after=partial(_derivative_after, order, component),
        order=order,
        component=component,
        derivatives=order,
    )


def _handle_columns(derivative: Derivative, ahead: bool) -> Iterator[Column]:
    order, side, arrow = derivative.order, ("behind", "ahead")[ahead], "←→"[ahead]
    kind = "handle" if order == 1 else f"{derivative.name} handle"
    prefix = "" if order == 1 else derivative.letter
    for sign, what, measure, changed, unit, more_digits in (
        ("ℓ", "length", _lengths, "length", "on the canvas", 0),
        ("∠", "angle", _angles, "degrees", "in degrees, counterclockwise from x", 1),
    ):
        yield Column(
            name=f"{prefix}{sign}{arrow}",
            label=f"{what} of the {kind} {side}",
            tip=f"{what.capitalize()} of the {kind} {side} {unit}",
            get=partial(measure, order, ahead),
            set=partial(_set_handle, order, ahead, changed),
            is_estimated=lambda view: np.isnan(view.arrays.given[:, int(ahead), order - 1, 0]),
            estimate=lambda curve: str(getattr(curve, derivative.rule_field).estimate),
            reset=partial(_reset, order),
            is_of_handle=True,
            derivatives=order,
            more_digits=more_digits,
        )


def _columns_of_derivative(derivative: Derivative) -> Iterator[Column]:
    # Handles that are shown by length and angle are in sight before the velocity.
    for ahead in (False, True):
        yield from _handle_columns(derivative, ahead)
    yield from (_derivative_column(derivative, component) for component in (0, 1))


COLUMNS: Sequence[Column] = (
    Column(
        name="t",
        tip="Parameter: the curve passes the point at this t",
        get=_displayed_parameters,
        set=_set_parameter,
        set_many=_set_parameters,
        order=PARAMETER,
    ),
    *(_position_column(component) for component in (0, 1)),
    *(column for derivative in DERIVATIVES for column in _columns_of_derivative(derivative)),
)
"""All columns, in the order in which the table shows them."""
