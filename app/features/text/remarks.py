"""What is said beside a text that is typed."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...document.words import enumerated
from ...qt import glyphs
from ...qt.glyphs import Outlines
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


def of_edited(edited: Written | Worded | None) -> str:
    """Say what of a text that is edited is not as it was written."""
    if edited is None or not edited.is_changed:
        return ""
    if not glyphs.has_family(edited.text.font):
        return f"“{edited.text.font}” is not on this computer; Ctrl+Enter writes the text in another font."
    return "The letters were changed by hand; Ctrl+Enter writes them anew at this place."
