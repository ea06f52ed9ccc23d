"""Corners rounded by a radius that is typed."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING

from PySide6.QtCore import QPoint, Qt

from ...actions.declaration import action, also
from ...actions.sections import CURVE_OFFSETS
from ...actions.strips import POINT_BAR, POINT_MENU
from ...document.point_group import some_points
from ...document.several_curves import named, whole_curves
from ...document.words import count_of
from ...view_model.points.rounded import RoundedGroup, with_rounded
from ...workbench.context import WindowContext
from .. import shapes
from .chosen_shapes import A_SHAPE, beside_meant
from .shape_work import ShapeWork

if TYPE_CHECKING:
    from .distances import Distance

_USUAL_PX = 10.0
"""The radius before one was typed, at least: pixels of CSS, or of the screen without a unit of length."""

_SAME = 1e-9


class CornerCommands:
    """Rounded corners."""

    def __init__(self, context: WindowContext) -> None:
        self._context, self._session = context, context.session
        self._canvas, self._work = context.central.canvas, ShapeWork(context)
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
        """Round the corners that are meant, in one step, and select the arcs of selected ones."""
        self._context.preferences.corner_radius = radius.words
        session, marked = self._session, self._session.selected.highlight()
        document, points = session.committed, marked.points
        group = points if points.parts else whole_curves(document, marked.curves)
        names = named(document, marked.curves)

        def put(found: RoundedGroup) -> None:
            radii = [each for one in found.made.values() for each in one.radii]
            if not radii:
                session.refuse(_left(found.left) or "There is no corner to round.")
                return
            text = f"Round {count_of(len(radii), 'corner')} of {names}"
            if not session.change(text, lambda _: found.document):
                return
            if points.parts:
                session.selected.set_group(
                    some_points((place, each.new) for place, each in found.made.items())
                )
            session.say(_outcome(radii, radius, found.left))

        make = partial(with_rounded, document, session.views, group, radius.value)
        self._work.begin(f"Round Corners of {names}", make, put)


def _outcome(radii: Sequence[float], radius: Distance, left: int) -> str:
    """Say how many corners are round now, how many of them by less, and how many were left."""
    said = f"{count_of(len(radii), 'corner')} {'is' if len(radii) == 1 else 'are'} round now"
    smaller = sum(each < radius.value * (1 - _SAME) for each in radii)
    if smaller:
        which = "" if smaller == len(radii) else f" at {smaller} of them"
        said = f"{said}; {radius.words} does not fit{which}, so the largest radius that does was taken"
    return f"{said}. {_left(left)}".rstrip()


def _left(count: int) -> str:
    if not count:
        return ""
    return f"{count_of(count, 'corner')} {'was' if count == 1 else 'were'} left: no arc touches both sides."
