"""Corners rounded by a radius that is typed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from PySide6.QtCore import QPoint, Qt

from ...actions.declaration import action, also
from ...actions.sections import CURVE_OFFSETS
from ...actions.strips import POINT_BAR, POINT_MENU
from ...document.edits import EditError
from ...document.point_group import PointGroup, some_points
from ...document.several_curves import named, whole_curves
from ...document.straight_edits import why_not_straight
from ...document.words import count_of
from ...view_model.rounded import Rounded, rounded, with_rounded
from ...workbench.context import WindowContext
from .. import shapes
from .chosen_shapes import A_SHAPE, beside_meant

if TYPE_CHECKING:
    from .distances import Distance

_USUAL_PX = 10.0
"""The radius before one was typed, at least: pixels of CSS, or of the screen without a unit of length."""

_SAME = 1e-9


class CornerCommands:
    """Rounded corners."""

    def __init__(self, context: WindowContext) -> None:
        self._context, self._session = context, context.session
        self._canvas = context.central.canvas
        self._made: shapes.field.RadiusField | None = None

    @property
    def field(self) -> shapes.field.RadiusField:
        """The field on the canvas; made when somebody first types into it."""
        if self._made is None:
            self._made = shapes.field.RadiusField(self._canvas.viewport())
            self._made.entered.connect(self._take)
            self._made.closed.connect(lambda: self._canvas.setFocus(Qt.FocusReason.OtherFocusReason))
            self._session.interrupted.connect(self._made.close_field)
        return self._made

    @action(
        "roundCorners",
        "Round Corners by…",
        CURVE_OFFSETS,
        "Alt+Shift+R",
        "round-corners",
        needs=A_SHAPE,
        keywords="fillet radius rounded rectangle arc soften",
    )
    @also(POINT_MENU(16), POINT_BAR(32))
    def _ask(self) -> None:
        """Type a radius, such as 5 mm, for the selected corners, or for all those of the chosen shapes."""
        self._canvas.cancel_gesture()
        words = self._context.preferences.corner_radius
        unit, pixel_size = self._session.document.unit, self._canvas.camera.pixel_size
        last = shapes.distances.read_again(words, unit, pixel_size, _USUAL_PX)
        self.field.open_for(last.words, unit, self._corner)

    def _corner(self) -> QPoint:
        return beside_meant(self._session, self._canvas)

    def _take(self, radius: Distance) -> None:
        self._context.preferences.corner_radius = radius.words
        try:
            self._round(radius)
        except EditError as reason:
            self._session.refuse(str(reason))

    def _round(self, radius: Distance) -> None:
        """Round the corners that are meant, in one step, and select the arcs of selected ones."""
        session, marked = self._session, self._session.selected.highlight()
        document, points = session.document, marked.points
        made = self._computed(points if points.parts else whole_curves(document, marked.curves), radius.value)
        left = sum(each.left for each in made.values())
        made = {curve: each for curve, each in made.items() if each.radii}
        radii = [each for one in made.values() for each in one.radii]
        if not radii:
            raise EditError(_why_none(left))
        corners = count_of(len(radii), "corner")
        text = f"Round {corners} of {named(document, marked.curves)}"
        if not session.change(text, lambda document: with_rounded(document, made)):
            return
        if points.parts:
            session.selected.set_group(some_points((curve, each.new) for curve, each in made.items()))
        session.say(_outcome(radii, radius, left))

    def _computed(self, group: PointGroup, radius: float) -> dict[int, Rounded]:
        """Return what becomes of those curves of a group that can have corners; refuse where none can."""
        views, made, reasons = self._session.views, dict[int, Rounded](), list[str]()
        for curve, indices in group.parts:
            view = views[curve]
            if reason := why_not_straight(view.source.family) or view.problem:
                reasons.append(reason)
            elif view.has_curve:
                made[curve] = rounded(view, indices, radius)
        if reasons and not made:
            raise EditError(reasons[0])
        return made


def _outcome(radii: Sequence[float], radius: Distance, left: int) -> str:
    """Say how many corners are round now, how many of them by less, and how many were left."""
    said = f"{count_of(len(radii), 'corner')} {'is' if len(radii) == 1 else 'are'} round now"
    smaller = sum(each < radius.value * (1 - _SAME) for each in radii)
    if smaller:
        which = "" if smaller == len(radii) else f" at {smaller} of them"
        said = f"{said}; {radius.words} does not fit{which}, so the largest radius that does was taken"
    return f"{said}. {_left(left)}".rstrip()


def _why_none(left: int) -> str:
    """Say why nothing is to be rounded."""
    return _left(left) or "There is no corner to round."


def _left(count: int) -> str:
    if not count:
        return ""
    return f"{count_of(count, 'corner')} {'was' if count == 1 else 'were'} left: no arc touches both sides."
