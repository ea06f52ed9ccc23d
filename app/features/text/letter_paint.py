"""Paint of letters that are typed: of those that are chosen, or of the whole text."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Final

from msgspec.structs import replace

from ...document.content import RunPaint, TextRun
from ...document.contents import lettered_style
from ...document.style import Style
from ...document.words import count_of
from ...workbench.typed_letters import Restyle
from .wording import Letters, Typed

if TYPE_CHECKING:
    from .field import TextField

_OF_LETTERS: Final = ("fill", "fill_opacity", "stroke", "stroke_opacity", "width")
"""The fields of a style that letters may have for themselves; the others are those of the text."""

_OF_TEXT: Final = ("cap", "join", "miter_limit", "dash", "dash_offset", "fill_rule", "opacity")


class LetterPainter:
    """Paints letters in the field.

    Parameters
    ----------
    style
        That of the text.
    scale
        How long a unit of the text is.
    """

    def __init__(self, field: TextField, style: Style, scale: float) -> None:
        self._field, self._style, self._scale = field, style, scale
        # How the text looks, and what letters have a paint of their own.
        self._begun = style, _paints(field.typed)
        self._looked_at: Style | None = None

    @property
    def subject(self) -> str:
        chosen = len(self._field.words.textCursor().selectedText())
        return count_of(chosen, "letter") if chosen else "All letters"

    @property
    def styles(self) -> Sequence[Style]:
        return [self._style_of(run).flat for run in self._field.words.runs]

    def paint(self, change: Restyle) -> None:
        self._looked_at = None
        self._style = self._rest(change)
        self._field.restyle(lambda run: self._painted(run, change))

    def look_at(self, change: Restyle) -> None:
        self._looked_at = self._rest(change)
        self._field.look_at(lambda run: self._painted(run, change))

    def give_up(self) -> None:
        self._looked_at = None
        self._field.look_at(None)

    def _rest(self, change: Restyle) -> Style:
        """Return the style of the text with what letters do not have for themselves."""
        after = change(self._style.flat)
        return replace(self._style, **{name: getattr(after, name) for name in _OF_TEXT})

    def _style_of(self, run: TextRun) -> Style:
        return lettered_style(self._style, run.paint, self._scale)

    def _painted(self, run: TextRun, change: Restyle) -> TextRun:
        before = self._style_of(run).flat
        after = change(before)
        if all(getattr(before, name) == getattr(after, name) for name in _OF_LETTERS):
            return run
        own = {name: getattr(after, name) for name in _OF_LETTERS}
        width = after.width if after.width is not None else self._scale
        return replace(run, paint=RunPaint(**{**own, "width": width / self._scale}))

    def looks(self, typed: Typed) -> tuple[Style, Typed]:
        """Return the style of the text with what all letters have become, and the letters with the rest."""
        style, paints = self._looked_at or self._style, _paints(typed)
        if len(paints) != 1 or paints == self._begun[1]:
            return style, typed
        (paint,) = paints
        if paint is None:
            return style, typed
        whole = lettered_style(style, paint, self._scale)
        # What a scale makes of 0.3 is 0.3 still.
        width = float(f"{whole.width:.12g}") if whole.has_stroke else style.width
        plain = tuple(
            tuple(Letters(words, look._replace(run=replace(look.run, paint=None))) for words, look in line)
            for line in typed
        )
        return replace(whole, width=width), plain

    @property
    def is_as_it_was(self) -> bool:
        """Whether the style of the text is the same still."""
        return (self._looked_at or self._style) == self._begun[0]


def _paints(typed: Typed) -> set[RunPaint | None]:
    return {look.run.paint for line in typed for words, look in line if words}
