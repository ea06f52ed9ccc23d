"""Each chosen object of a document in a file of its own, named by its name."""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence
from pathlib import Path
from typing import NamedTuple

from ..document.model import Document
from ..document.shape_edits import objects
from ..tasks.progress import Report, part
from .choice import ExportChoice, Order
from .formats import Written
from .naming import Names
from .writing import put, written_for

_LONGEST = 100


class OwnFile(NamedTuple):
    """A file for one object: its name with its ending, and what is written to it."""

    name: str
    order: Order


def own_files(
    choice: ExportChoice, document: Document, chosen: Collection[int], *, with_estimates: bool = False
) -> list[OwnFile]:
    """Return the files of all chosen objects, each with a name that no other has; a whole group is one.

    For `with_estimates` see `ExportChoice.order`.
    """
    names, files = _FileNames(), []
    for node in objects(document, chosen):
        places = frozenset(node.places)
        order = choice.order(document, node.places.start, places, with_estimates=with_estimates)
        files.append(OwnFile(f"{names.different(node.name)}{choice.ending}", order))
    return files


def write_all(folder: Path, files: Sequence[OwnFile], report: Report) -> list[Written]:
    """Write files into a folder, once all have been made: where one cannot be, there is none.

    Raises
    ------
    ExchangeError
        If an object cannot be written in that format.
    StorageError
        If a file cannot be written.
    """
    made = []
    for place, (name, (document, options)) in enumerate(files):
        own = part(report, place / len(files), (place + 1) / len(files))
        made.append(written_for(document, folder / name, options.reporting(own)))
    for written, (name, _) in zip(made, files, strict=True):
        put(written, folder / name, report)
    return made


class _FileNames:
    """Source of names of files; some systems do not tell small letters from capitals."""

    def __init__(self) -> None:
        self._names = Names()

    def different(self, name: str) -> str:
        """Return a name that every system allows and that was not given before."""
        kept = "".join(character for character in name if character.isprintable())
        base = re.sub(r'[<>:"/\\|?*]+', " ", kept).strip(" .")[:_LONGEST] or "object"
        folded = self._names.different(base.casefold())
        return base + folded[len(base.casefold()) :]
