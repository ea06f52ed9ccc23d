"""Clips as elements of SVG, in the units of the drawing: what two shapes share is there once."""

from __future__ import annotations

from ...document.clip import Clip, ClipRing
from ..naming import Names
from .defined_elements import DefinedElements
from .numbers import number


class ClipElements(DefinedElements):
    """The clips of one file."""

    def __init__(self, ids: Names) -> None:
        super().__init__(ids)
        self._known: dict[tuple[Clip, ...], str] = {}

    def reference(self, clips: tuple[Clip, ...]) -> str:
        """Return what refers to what all of some clips leave; "none" of none."""
        if not clips:
            return "none"
        if clips not in self._known:
            # The path of a clip is cut by the others: Inkscape does not read it of the clip itself.
            rest = self.reference(clips[1:])
            self._known[clips] = name = self._ids.different("clip")
            self.lines += [f'    <clipPath id="{name}">', f"      {_path(clips[0], rest)}", "    </clipPath>"]
        return f"url(#{self._known[clips]})"

    def around(self, element: str, clips: tuple[Clip, ...]) -> str:
        """Return an element within groups that are cut by clips.

        Clips of clips are not read by all programs, and a group without a name is none of the drawing.
        """
        for each in clips:
            element = f'<g clip-path="{self.reference((each,))}">{element}</g>'
        return element


def _path(clip: Clip, rest: str) -> str:
    rule = ' clip-rule="evenodd"' if clip.evenodd else ""
    cut = "" if rest == "none" else f' clip-path="{rest}"'
    return f'<path d="{" ".join(map(_data, clip.rings))}"{rule}{cut}/>'


def _data(ring: ClipRing) -> str:
    start, *others = (f"{number(x)} {number(-y)}" for x, y in ring.places)
    pieces = (" ".join(others[at : at + 3]) for at in range(0, len(others), 3))
    return f"M {start} {' '.join(f'C {each}' for each in pieces)} Z"
