"""What is said beside a text that is typed."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...document.content import Lettering
from ...document.model import Curve
from ...document.words import count_of, enumerated
from ...document.wrapping import words_about_room
from ...qt import glyphs
from ...qt.glyphs import Outlines
from ...qt.letters_along import hidden_letters
from ...qt.run_fonts import font_of
from .rewriting import Written
from .wording import Worded

if TYPE_CHECKING:
    from .field import TextField


def of_typed(field: TextField, outlines: Outlines, most: int) -> str:
    """Say what of what is typed is not written as it was meant; empty for nothing."""
    if len(field.text) > most:
        return f"A text has at most {most} letters; the rest is left out."
    if outlines.missing:
        return f"No font here has {enumerated([f'“{each}”' for each in outlines.missing[:5]])}."
    return f"“{field.face.family}” has no bold letters." if outlines.lacks_bold else ""


def of_shown(curve: Curve) -> str:
    """Say what of a text has no room on its path or in its frame."""
    text = curve.form
    if not isinstance(text, Lettering):
        return ""
    if text.along is None:
        return words_about_room(text)
    many = hidden_letters(text.lines, text.along, font_of)
    return f"The path has no room for {count_of(many, 'letter')}." if many else ""


def of_edited(edited: Written | Worded | None) -> str:
    """Say what of a text that is edited is not as it was written."""
    if edited is None or not edited.is_changed:
        return ""
    if not glyphs.has_family(edited.text.font):
        return f"“{edited.text.font}” is not on this computer; Ctrl+Enter writes the text in another font."
    return "The letters were changed by hand; Ctrl+Enter writes them anew at this place."
