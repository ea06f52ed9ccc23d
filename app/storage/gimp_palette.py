"""GIMP palettes, files ending in .gpl, as Inkscape and Krita have them, too."""

from __future__ import annotations

import os
import re
from pathlib import Path

from ..document.words import number
from .files import StorageError, read

MOST_COLOURS = 4096
MOST_BYTES = 2**20

_ROW = re.compile(r"\s*(\d{1,3})\s+(\d{1,3})\s+(\d{1,3})(?:\s+(.*))?$")
_LONGEST_NAME = 80


def read_gimp_palette(path: str | os.PathLike[str]) -> tuple[str, tuple[tuple[str, str], ...]]:
    """Return the name of a palette, and its colours "#rrggbb" with their names.

    Raises
    ------
    StorageError
        With what is wrong in which line.
    """
    data = read(path)
    if len(data) > MOST_BYTES:
        raise StorageError(f"A palette has at most {number(MOST_BYTES / 2**20, 3)} MB.")
    lines = data.decode("utf-8-sig", errors="replace").splitlines()
    if not lines or lines[0].strip() != "GIMP Palette":
        raise StorageError("It is no GIMP palette: it does not begin with “GIMP Palette”.")
    title, found = Path(path).stem, []
    for place, line in enumerate(lines[1:], start=2):
        if line.startswith("Name:"):
            title = _printable(line.removeprefix("Name:")) or title
        elif line.strip() and not line.lstrip().startswith("#") and not line.startswith("Columns:"):
            found.append(_colour_in(line, place))
    if not 0 < len(found) <= MOST_COLOURS:
        raise StorageError(f"It has {len(found)} colours; a palette has 1 to {MOST_COLOURS}.")
    return title, tuple(found)


def _colour_in(line: str, place: int) -> tuple[str, str]:
    row = _ROW.match(line)
    channels = [int(each) for each in row.groups()[:3]] if row else [256]
    if row is None or max(channels) > 255:
        raise StorageError(f"Line {place} is no colour: it has to be three numbers from 0 to 255 and a name.")
    red, green, blue = channels
    return f"#{red:02x}{green:02x}{blue:02x}", _printable(row[4] or "")


def _printable(text: str) -> str:
    return "".join(each for each in " ".join(text.split()) if each.isprintable())[:_LONGEST_NAME]
