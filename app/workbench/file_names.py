"""Names of documents and of their files."""

from __future__ import annotations

import re
from pathlib import Path

from ..exchange.formats import DOCUMENT_ENDING, FORMATS, endings_of, format_of
from ..session import Session

SUFFIX = DOCUMENT_ENDING
SAVED_KINDS = f"Curvebench documents (*{SUFFIX});;All files (*)"
"""The kinds of files that a document is saved as, for the dialog that asks for a name."""

_LONGEST_STEM = 80


def short_name(name: str) -> str:
    """Return a name without its middle where it is long; the title of the window has it whole."""
    half = _LONGEST_STEM // 2
    return name if len(name) <= _LONGEST_STEM else f"{name[:half]}…{name[-half:]}"


def title_of(session: Session) -> str:
    """Return what the document is called: its file; a curve's name would change with the order of curves."""
    files = session.files
    return files.path.name if files.path is not None else files.beginning.title or "Untitled"


def file_stem(session: Session) -> str:
    """Return a file name for the document, without ending."""
    if (path := session.files.path) is not None:
        return path.stem if is_misnamed(path) else path.name.removesuffix(SUFFIX)
    curves = session.document.curves
    drawn = "Sketch" if len(curves) > 1 else curves[0].name
    return own_name(session.files.beginning.file_stem or drawn)


def own_name(name: str) -> str:
    """Return a file name without ending for what has a name."""
    name = "".join(character for character in name if character.isprintable())
    # What some system does not allow in a file's name.
    return re.sub(r'[<>:"/\\|?*]+', " ", name).strip(" .")[:_LONGEST_STEM] or "curve"


def is_misnamed(path: Path) -> bool:
    """Whether a document of ours has the name of another format's file, where nothing would look for one."""
    return bool(why_not_saved_as(path.name))


def path_to_save(typed: Path) -> Path:
    """Return where a document is saved for a typed name.

    What is neither JSON nor a file of a known format by its name gets the suffix of documents.
    """
    name, known = typed.name.lower(), (".json", *endings_of(FORMATS.written))
    return typed if name.endswith(known) else typed.with_name(typed.name + SUFFIX)


def why_not_saved_as(name: str) -> str:
    """Return why no document may have such a name, as sentences; empty where it may.

    Under the ending of another format no program, this one among them, would open it.
    """
    name = name.lower()
    others = tuple(each for each in endings_of(FORMATS.written) if each != SUFFIX)
    if not name.endswith(others):
        return ""
    title = format_of(name, FORMATS.written).title
    return f"A document is saved as {SUFFIX}. File › Export writes a {title}."
