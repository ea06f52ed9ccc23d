"""What texts lie along or fill in a file: the path of a curve, a course or a frame of their own."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from ...document.content import Content, Lettering
from ...document.contents import Plane
from ..naming import Names
from .defined_elements import DefinedElements
from .flowed import frame_element
from .text_path_elements import along_shown, course_data


class Placed(NamedTuple):
    """A text or a picture in the units of what it refers to, where it lies, and the id of that or nothing."""

    content: Content
    plane: Plane
    path: str = ""


class CourseElements(DefinedElements):
    """The courses and the frames of one file that are no curves of it.

    Parameters
    ----------
    ids
        Those of the file.
    carrier
        Returns the id of the path that shows a curve; empty where none does.
    """

    def __init__(self, ids: Names, carrier: Callable[[str], str]) -> None:
        super().__init__(ids)
        self._carrier = carrier

    def under(self, content: Content, plane: Plane) -> Placed:
        """Return what lies so as it refers to what it needs; pictures and plain lines need nothing."""
        if not isinstance(content, Lettering):
            return Placed(content, plane)
        if content.along is not None:
            shown = along_shown(content, plane)
            path = self._carrier(content.along.of) if shown is not None and content.along.of else ""
            if shown is not None and path:
                return Placed(*shown, path)
            path = self._ids.different("course")
            self.lines.append(f'    <path id="{path}" d="{course_data(content.along)}"/>')
            return Placed(content, plane, path)
        if content.flow is not None and not content.flow.grows:
            path = self._ids.different("frame")
            self.lines.append(f"    {frame_element(content, path)}")
            return Placed(content, plane, path)
        return Placed(content, plane)
