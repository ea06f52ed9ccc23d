"""The names of the formats, and how to write them; light, for the window's start."""

from __future__ import annotations

import os
from enum import StrEnum
from pathlib import Path

import msgspec

from app.exchange.drawing import ExchangeError
from app.exchange.svg import Style

SUFFIXES = (".png", ".svg", ".pdf")
"""Endings of the pictures that `export` can write."""

ENDINGS = (
    ".curve.json",
    ".coefficients.json",
    ".scipy.py",
    ".py",
    ".pgfplots.tex",
    ".tikz.tex",
    ".tikz",
    ".tex",
    ".desmos.txt",
    ".path.txt",
    ".csv",
    ".tsv",
    ".dxf",
    ".svg",
    ".png",
    ".pdf",
)
"""Endings of all files that `export` can write; the first that fits counts."""

READABLE = (".curve.json", ".csv", ".tsv", ".svg", ".dxf")
"""Endings of the files that `import_file` can read."""

SAMPLES = 201
"""Rows of a table of samples, unless asked otherwise."""


class Spacing(StrEnum):
    """How samples are spread along a curve."""

    T = "t"
    LENGTH = "length"
    TOLERANCE = "tolerance"


class Exported(msgspec.Struct, frozen=True):
    """What was written.

    Attributes
    ----------
    deviation
        Largest distance of what the file holds from the true curves, in the document's unit.
    remarks
        One sentence for every curve that was left out.
    """

    deviation: float
    remarks: tuple[str, ...] = ()


class Options(msgspec.Struct, frozen=True):
    """How to write; each format takes what concerns it. See `export`."""

    width: int | None = None
    tolerance: float | None = None
    style: Style | None = None
    points: bool = False
    samples: int = SAMPLES
    spacing: Spacing = Spacing.T


def ending_of(path: str | os.PathLike[str], endings: tuple[str, ...]) -> str:
    """Return the first of the endings that the name of a file has.

    Raises
    ------
    ExchangeError
        If it has none.
    """
    name = Path(path).name
    for ending in endings:
        if name.lower().endswith(ending):
            return ending
    known = ", ".join(endings[:-1])
    raise ExchangeError(f"The name “{name}” does not end in a known format; use {known} or {endings[-1]}.")
