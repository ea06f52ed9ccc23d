"""Files that are imported one after the other, and their curves in the document, with the views of them."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path

import msgspec

from ... import exchange
from ...document.groups import tidy_shapes
from ...document.model import Document
from ...document.plain_numbers import with_plain_numbers
from ...document.several_curves import add_imported, ignored_on_import, is_blank
from ...document.words import names_of
from ...view_model.curve.transformed import views_ahead
from ...view_model.paste import AddedCurves


class SeriesPosition(msgspec.Struct, frozen=True):
    """Number of a file in a series of imports, from 1, and the count of files."""

    number: int = 1
    count: int = 1

    @property
    def waiting(self) -> int:
        """Number of files that come after it."""
        return self.count - self.number


class ImportSeries:
    """Files that are imported one after the other.

    Parameters
    ----------
    begin
        Begins the import of a file; it ends with a call of `end`, whatever its outcome.
    is_free
        Whether a file can be read now.
    warn
        Shows a warning about files that could not be imported.

    Attributes
    ----------
    changed
        Called with the new position when files are added during the dialog of another.
    """

    def __init__(
        self, begin: Callable[[Path], None], is_free: Callable[[], bool], warn: Callable[[str], None]
    ) -> None:
        self._begin, self._is_free, self._warn = begin, is_free, warn
        self._now: Path | None = None
        self._waiting: list[Path] = []
        self._number = 0
        self._problems: list[str] = []
        self.changed: Callable[[SeriesPosition], object] | None = None

    @property
    def is_busy(self) -> bool:
        """Whether a file is being imported, or waits."""
        return self._now is not None or bool(self._waiting)

    @property
    def position(self) -> SeriesPosition:
        """Position of the file that is being imported."""
        return SeriesPosition(self._number, self._number + len(self._waiting))

    def add(self, paths: Iterable[Path]) -> None:
        """Import files after those that wait."""
        self._waiting += paths
        if self.changed is not None:
            self.changed(self.position)
        self.go_on()

    def go_on(self) -> None:
        """Begin the next file, if it can be read now."""
        if self._now is None and self._waiting and self._is_free():
            self._now = self._waiting.pop(0)
            self._number += 1
            self._begin(self._now)

    def end(self, problem: str = "") -> None:
        """Go on with the next file; `problem` is the reason why this one was not imported."""
        self._now = None
        self._problems += [problem] if problem else []
        if self._problems:
            # All of them each time, as an import removes the sentence.
            self._warn(" ".join(self._problems))
        if not self._waiting:
            self._number, self._problems = 0, []
        self.go_on()

    def skip_rest(self) -> list[str]:
        """Forget the files that wait; return their names, after that of the current file."""
        left = [path.name for path in (self._now, *self._waiting) if path is not None]
        self._waiting.clear()
        return left


MANY_POINTS = 1000
"""Points of curves whose views are made beside the window."""


def points_of(document: Document) -> int:
    """Return the number of points of all curves."""
    return sum(len(curve.points) for curve in document.curves)


def intake(
    document: Document,
    new: Document,
    report: Callable[[float], object] | None = None,
) -> AddedCurves:
    """Return a document with the curves of another in front, and their views if there is a `report`.

    Lengths are converted to the unit of the document; an empty document gets the unit and the guides.
    """
    new = _sized_for(document, new)
    filled, first = add_imported(document, new)
    # As the session will store it, so that the views are of the same curves.
    filled = tidy_shapes(with_plain_numbers(filled, document), document)
    indices = range(first, first + len(new.curves))
    views = views_ahead(filled.curves[indices.start : indices.stop], report) if report is not None else ()
    return AddedCurves(filled, indices, tuple(views))


def rest_message(document: Document, new: Document) -> str:
    """Return sentences on the content that is not added to a document with the curves of another."""
    sentences = []
    sized = _sized_for(document, new)
    if sized.unit != new.unit:
        sentences.append(f"Lengths are converted from {new.unit} to {sized.unit}.")
    if rest := ignored_on_import(document, sized):
        verb = "is" if len(rest) == 1 and not rest[0].endswith("guides") else "are"
        words = names_of(rest)
        sentences.append(f"{words[0].upper()}{words[1:]} {verb} left out.")
    return " ".join(sentences)


def _sized_for(document: Document, new: Document) -> Document:
    """Return the document to add in the unit of another; unchanged where the other has no curves."""
    if is_blank(document):
        return new
    return exchange.units.in_unit(new, document.unit)
