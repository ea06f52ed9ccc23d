"""A film of a motion: its content, size and length."""

from __future__ import annotations

from dataclasses import dataclass

from msgspec.structs import replace

from ...document.model import Document
from ...document.style import Style
from ...families import Family
from ...view_model.curve.curve_view import view_of
from ...view_model.motion import OWN, Course, Role, rivals_of
from ...view_model.motion_settings import Pace, Repeat
from ..errors import ExchangeError
from .styles import LIGHT, PictureStyle


@dataclass(frozen=True)
class Film:
    """Content, size and length of a film.

    Attributes
    ----------
    curve
        The index of the curve in its document.
    width
        In pixels; made even. The height follows from the drawing.
    fps
        Frames a second.
    seconds
        How long the film is: one round of the motion.
    compared
        The families whose curves run side by side with the curve itself.
    points
        Whether to draw the points.
    """

    curve: int = 0
    width: int = 640
    fps: int = 25
    seconds: float = 4.0
    repeat: Repeat = Repeat.LOOP
    pace: Pace = Pace.PARAMETER
    compared: frozenset[Family] = frozenset()
    style: PictureStyle = LIGHT
    points: bool = True

    @property
    def frames(self) -> int:
        """Number of frames, at least two."""
        return max(2, round(self.fps * self.seconds))

    def courses(self, document: Document) -> dict[Role, Course]:
        """Return the ways of the dots."""
        view = view_of(document.curves[self.curve])
        if not view.is_current or view.curve is None:
            raise ExchangeError(f"There is no curve to run along. {view.problem}")
        courses = {OWN: Course(view.curve, self.pace)}
        for role, rival in rivals_of(view, self.compared).items():
            assert rival.curve is not None
            courses[role] = Course(rival.curve, self.pace)
        return courses

    def drawn(self, document: Document) -> Document:
        """Return the document with all curves that are seen: those that are compared are among them."""
        source = document.curves[self.curve]
        others = [
            replace(each.source, style=Style(stroke=role.colour))
            for role, each in rivals_of(view_of(source), self.compared).items()
            if each.source is not source
        ]
        return Document((*others, *document.curves)) if others else document

    def durations(self, unit: int) -> list[int]:
        """Return how long each frame stands, in milliseconds that are multiples of `unit`.

        Rounded so that no frame is ever off by more than half a unit.
        """
        ends = [round(1000 * (i + 1) / self.fps / unit) * unit for i in range(self.frames)]
        return [end - start for start, end in zip([0, *ends], ends, strict=False)]
