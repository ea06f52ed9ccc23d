"""What has come from the clipboard or a file, and is chosen so."""

from __future__ import annotations

from collections.abc import Collection

from .next_style import Marked
from .selection import Selection


def choose_brought(selected: Selection, places: Collection[int]) -> None:
    """Choose curves that have come from the clipboard or a file: nobody chose their looks."""
    # Before, too: what is chosen until now is taken note of.
    selected.next_style.marked = Marked.BROUGHT
    selected.choose(places)
    selected.next_style.marked = Marked.BROUGHT
