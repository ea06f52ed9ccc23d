"""Trace Picture: a shape of what is dark in a picture."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QPoint, Qt

from ... import view_model
from ...actions.declaration import action, also
from ...actions.needs import Need
from ...actions.sections import CURVE_TRACES
from ...actions.situation import Situation
from ...actions.strips import CHOSEN_MENU, CURVE_MENU, IMAGE_BUTTONS
from ...canvas.image_file import ImageFileError, read_image
from ...document.content import Picture
from ...document.contents import Plane, corners_of, plane_of
from ...document.layers import free_layer, front_of
from ...document.words import count_of
from ...qt.contents import image_of
from ...qt.picture_data import brightness_of
from ...session import Session
from ...workbench.computed_step import ComputedStep
from ...workbench.context import WindowContext
from .. import tracing

if TYPE_CHECKING:
    from ...view_model.shapes.tracing import Source, Traced

_BESIDE = 6
"""Pixels between the field and the picture."""


def _picture(session: Session) -> int | None:
    """Return the place of the only picture that is chosen; None without one."""
    curves = session.document.curves
    pictures = [place for place in session.selected.marked if isinstance(curves[place].form, Picture)]
    return pictures[0] if len(pictures) == 1 else None


def _has_picture(now: Situation) -> bool:
    return _picture(now.session) is not None or now.session.document.image is not None


class TraceCommands:
    """Asks for a brightness, and makes a shape of what is darker."""

    def __init__(self, context: WindowContext) -> None:
        self._step, self._session = ComputedStep(context), context.session
        self._canvas = context.central.canvas
        self._made: tracing.field.DarknessField | None = None
        self._source: Source | None = None

    @property
    def field(self) -> tracing.field.DarknessField:
        """The field on the canvas; made when somebody first types into it."""
        if self._made is None:
            self._made = tracing.field.DarknessField(self._canvas.viewport())
            self._made.entered.connect(self._trace)
            self._made.closed.connect(lambda: self._canvas.setFocus(Qt.FocusReason.OtherFocusReason))
            self._session.interrupted.connect(self._made.close_field)
        return self._made

    @action(
        "tracePicture",
        "Trace Picture…",
        CURVE_TRACES,
        "Alt+Shift+B",
        "trace",
        needs=Need("a chosen picture, or a picture to trace", _has_picture),
        keywords="bitmap vectorize vectorise potrace outline scan image",
    )
    @also(CURVE_MENU(48), CHOSEN_MENU(37), IMAGE_BUTTONS(5))
    def _ask(self) -> None:
        """Make a shape of what is dark in the picture, with curves, corners and lines where it has such."""
        self._canvas.cancel_gesture()
        source = self._source_now()
        if source is not None:
            self._source = source
            self.field.open_for(source.parting, partial(self._corner, source.plane))

    def _corner(self, plane: Plane) -> QPoint:
        return self._canvas.to_pixel(*plane.place(1.0, 0.0)) + QPoint(_BESIDE, 0)

    def _source_now(self) -> Source | None:
        """Return the picture that is meant; None where it cannot be seen, which is told."""
        document, place = self._session.committed, _picture(self._session)
        if place is not None:
            frame = document.curves[place]
            picture = frame.form
            assert isinstance(picture, Picture)
            image = image_of(picture.data) if picture.data else None
            if image is None:
                self._session.refuse(f"“{frame.seen_name}” cannot be traced: its file is not there.")
                return None
            plane = plane_of(picture, corners_of(frame))
            return view_model.shapes.tracing.Source(
                frame.seen_name, brightness_of(image), plane, place + 1, frame.groups
            )
        behind = document.image
        assert behind is not None
        try:
            image = read_image(behind.path)
        except ImageFileError as problem:
            self._session.refuse(str(problem))
            return None
        plane = Plane(behind.x, behind.y + behind.height, (behind.width, 0.0), (0.0, -behind.height))
        front = front_of(document, free_layer(document, self._session.selected.layer))
        name = Path(behind.path).stem
        return view_model.shapes.tracing.Source(
            name, brightness_of(image), plane, front.place, front.container.groups
        )

    def _trace(self, limit: float) -> None:
        source, document = self._source, self._session.committed
        if source is None:
            return
        title = f"Trace {source.name}"
        make = partial(view_model.shapes.tracing.traced, document, source, limit)
        self._step.begin(title, make, partial(self._put, title))

    def _put(self, title: str, made: Traced) -> None:
        session = self._session
        if not session.change(title, lambda _: made.document, active=made.places.start):
            return
        session.selected.choose(made.places)
        outlines, points = count_of(len(made.places), "outline"), count_of(made.points, "point")
        session.say(f"{title}: {outlines}, {points}. The shape lies on the picture and is chosen.")


COMMAND_SETS = (TraceCommands,)
