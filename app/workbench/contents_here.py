"""Texts of a drawing as they are on this computer, in its fonts."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from ..document.contents import has_contents
from ..qt.contents import measured

if TYPE_CHECKING:
    from ..exchange.cubics_in import Imported


def as_here(found: Imported) -> Imported:
    """Return what was read with frames that fit its texts."""
    if not has_contents(found.document.curves):
        return found
    return replace(found, document=measured(found.document))
