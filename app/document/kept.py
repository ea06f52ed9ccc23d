"""What a drawing of another program shows beside its curves: texts and pictures, only to be moved.

They lie in front of all curves, or behind them; of both kinds the later ones are in front, and texts in front
of pictures.
"""

from __future__ import annotations

from typing import Annotated, Final

from .clip import MOST_CLIPS, Clip
from .fields import LENGTH, SHARE, Requirement, above, at_least, between, few, matching
from .guide import Length
from .value import Value, Vector
from .words import NamedEnum

MOST_LETTERS: Final = 20_000
"""Letters of all texts of a drawing that are shown."""

MOST_DATA: Final = 24_000_000
"""Characters that the files of all pictures of a drawing take."""

_COLOUR = matching("#[0-9a-f]{6}|none", 'be written as "#rrggbb" in lower case, or be "none"')
_WORDS = Requirement(
    lambda words: len(words) <= MOST_LETTERS and not any(each < " " for each in words),
    f"be a line of at most {MOST_LETTERS} letters",
    shown=len,
)
_FEW_CLIPS = few(MOST_CLIPS, f"hold at most {MOST_CLIPS} clips")
_DATA = matching("[A-Za-z0-9+/]*={0,2}", "be the file of a picture in Base64")


WHOLE: Final = (0.0, 0.0, 1.0, 1.0)
"""All of a picture."""


class Anchor(NamedEnum):
    """Where the place of a text lies along it."""

    START = "start", "Start"
    MIDDLE = "middle", "Middle"
    END = "end", "End"


class KeptRun(Value, frozen=True):
    """A part of a text in one font and one paint; its lengths are in units of the text.

    Attributes
    ----------
    words
        The letters.
    font
        Families of fonts, the first that there is counts.
    size
        What an em is long.
    weight, italic
        The style of the font, 400 being regular.
    spacing
        What lies between letters beyond the usual.
    right, down
        By how much it is moved from where it would follow.
    fill, fill_opacity, stroke, stroke_opacity, width
        How it is painted, as in `Style`.
    """

    words: Annotated[str, _WORDS]
    font: tuple[str, ...] = ()
    size: Annotated[float, above(0)] = 16.0
    weight: Annotated[float, between(1, 1000)] = 400.0
    italic: bool = False
    spacing: float = 0.0
    right: float = 0.0
    down: float = 0.0
    fill: Annotated[str, _COLOUR] = "#000000"
    fill_opacity: Annotated[float, SHARE] = 1.0
    stroke: Annotated[str, _COLOUR] = "none"
    stroke_opacity: Annotated[float, SHARE] = 1.0
    width: Annotated[float, at_least(0)] = 1.0


class KeptText(Value, frozen=True):
    """A line of a text.

    Attributes
    ----------
    x, y
        Where it is anchored on its baseline.
    across, down
        Where one of its units leads, along the baseline and down from it.
    runs
        Its parts, one after the other.
    anchor
        What of it lies there.
    behind
        Whether it lies behind the curves.
    follows
        Whether it is a further line of the text before it, with which it goes.
    locked
        Whether it stays where it is, as the file has it.
    groups
        As in `Curve`.
    clips
        Areas beyond each of which nothing of it is seen.
    """

    x: Length
    y: Length
    across: Annotated[Vector, LENGTH]
    down: Annotated[Vector, LENGTH]
    runs: Annotated[tuple[KeptRun, ...], few(MOST_LETTERS, f"be at most {MOST_LETTERS}")]
    anchor: Anchor = Anchor.START
    behind: bool = False
    follows: bool = False
    locked: bool = False
    groups: tuple[str, ...] = ()
    clips: Annotated[tuple[Clip, ...], _FEW_CLIPS] = ()

    @property
    def words(self) -> str:
        """All of it."""
        return "".join(run.words for run in self.runs)


class KeptPicture(Value, frozen=True):
    """A picture.

    Attributes
    ----------
    x, y
        Where its upper left corner lies.
    across, down
        Where its upper edge leads from there, and its left one.
    data
        A PNG or JPEG file in Base64; empty for one that lies elsewhere, whose place is shown.
    part
        What of it is seen: left and upper, right and lower edge, each from 0 to 1.
    opacity
        From 0 to 1.
    behind
        Whether it lies behind the curves.
    locked
        Whether it stays where it is, as the file has it.
    groups
        As in `Curve`.
    clips
        Areas beyond each of which nothing of it is seen.
    """

    x: Length
    y: Length
    across: Annotated[Vector, LENGTH]
    down: Annotated[Vector, LENGTH]
    data: Annotated[str, _DATA] = ""
    part: Annotated[tuple[float, float, float, float], SHARE] = WHOLE
    opacity: Annotated[float, SHARE] = 1.0
    behind: bool = False
    locked: bool = False
    groups: tuple[str, ...] = ()
    clips: Annotated[tuple[Clip, ...], _FEW_CLIPS] = ()
