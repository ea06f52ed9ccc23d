"""Files dropped on a window or given on the command line, sorted by their use. No Qt."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from ..document.words import count_of
from ..exchange.formats import can_import
from ..storage.files import IMAGE_SUFFIXES


@dataclass(frozen=True)
class GivenFiles:
    """Files sorted by their use: opened, imported or traced.

    Attributes
    ----------
    documents, imports, pictures
        To be opened, imported, traced.
    elsewhere
        The number of addresses of files that are not local.
    """

    documents: tuple[Path, ...] = ()
    imports: tuple[Path, ...] = ()
    pictures: tuple[Path, ...] = ()
    elsewhere: int = 0

    @property
    def invitation(self) -> str:
        """Sentence about the effect of a drop; only the first of several pictures is traced."""
        kinds = (
            ("open", "document", self.documents),
            ("import", "file", self.imports),
            ("trace", "picture", self.pictures[:1]),
        )
        there = [kind for kind in kinds if kind[2]]
        if len(there) == 1 and len(there[0][2]) == 1:
            return f"Drop to {there[0][0]} {there[0][2][0].name}"
        return f"Drop to {', '.join(f'{verb} {count_of(len(paths), what)}' for verb, what, paths in there)}"


def given_files(paths: Iterable[Path], *, elsewhere: int = 0) -> GivenFiles:
    """Return files sorted by their use; files of unknown formats are opened as documents."""
    paths = list(dict.fromkeys(paths))
    pictures = tuple(path for path in paths if path.suffix.lower() in IMAGE_SUFFIXES)
    imports = tuple(path for path in paths if can_import(path))
    documents = tuple(path for path in paths if path not in (*pictures, *imports))
    return GivenFiles(documents, imports, pictures, elsewhere)
