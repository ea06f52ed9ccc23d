"""Texts and pictures of a drawing as they are on this computer: in its fonts, with the files beside it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from .. import exchange
from ..document.contents import has_contents
from ..qt.contents import measured

if TYPE_CHECKING:
    from ..exchange.cubics_in import Imported


def as_here(found: Imported, folder: Path | None = None) -> Imported:
    """Return what was read with frames that fit its texts, and with pictures in the folder of its file."""
    if not has_contents(found.document.curves):
        return found
    document = measured(found.document)
    if folder is None:
        return replace(found, document=document)
    document = exchange.linked.with_files(document, folder)
    missing = exchange.linked.words_about_missing(document)
    return replace(found, document=document, remarks=(*found.remarks, *missing))
