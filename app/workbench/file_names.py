"""Names of documents and of their files."""

from __future__ import annotations

import re
from pathlib import Path

from .. import exchange
from ..document.model import Document
from ..document.paper import DocumentKind, kind_of
from ..exchange.formats import DOCUMENT_ENDING, FORMATS, endings_of, format_of
from ..session import Session

SUFFIX = DOCUMENT_ENDING
_SVG = ".svg"
_PACKED = ".svgz"
_KINDS = {
    f"Curvebench documents (*{SUFFIX})": SUFFIX,
    f"SVG drawings (*{_SVG})": _SVG,
    f"Compressed SVG drawings (*{_PACKED})": _PACKED,
}
SAVED_KINDS = ";;".join([*_KINDS, "All files (*)"])
"""The kinds of files that a document is saved as, for the dialog that asks for a name."""

_LONGEST_STEM = 80


def short_name(name: str) -> str:
    """Return a name without its middle where it is long; the title of the window has it whole."""
    half = _LONGEST_STEM // 2
    return name if len(name) <= _LONGEST_STEM else f"{name[:half]}…{name[-half:]}"


def title_of(session: Session) -> str:
    """Return what the document is called: its file; a curve's name would change with the order of curves."""
    files = session.files
    path = files.path or (files.foreign.path if files.foreign is not None else None)
    return path.name if path is not None else files.beginning.title or "Untitled"


def file_stem(session: Session) -> str:
    """Return a file name for the document, without ending."""
    if session.files.path is not None:
        return _stem_of(session.files.path)
    if session.files.foreign is not None:
        return _stem_of(session.files.foreign.path)
    curves = session.document.curves
    drawn = "Drawing" if session.document.page is not None or len(curves) > 1 else curves[0].name
    return own_name(session.files.beginning.file_stem or drawn)


def own_name(name: str) -> str:
    """Return a file name without ending for what has a name."""
    name = "".join(character for character in name if character.isprintable())
    # What some system does not allow in a file's name.
    return re.sub(r'[<>:"/\\|?*]+', " ", name).strip(" .")[:_LONGEST_STEM] or "curve"


def _stem_of(path: Path) -> str:
    return path.with_suffix("").name if is_svg(path) else path.name.removesuffix(SUFFIX)


def is_svg(path: Path) -> bool:
    """Whether a file is an SVG by its name, packed or not."""
    return path.name.lower().endswith((_SVG, _PACKED))


def is_misnamed(path: Path) -> bool:
    """Whether a document of ours has the name of another format's file, where nothing would look for one."""
    return is_svg(path) or bool(why_not_saved_as(path.name))


def proposed_ending(document: Document) -> str:
    """Return the ending under which a new document is saved unless somebody wants another one.

    A drawing of which an SVG keeps everything is one: others can open it, too.
    """
    counts = {len(curve.points) for curve in document.curves}
    # A point alone is nothing to draw.
    if kind_of(document) is not DocumentKind.DRAWING or 1 in counts or counts == {0}:
        return SUFFIX
    path, lasting = Path(f"drawing{_SVG}"), exchange.lasting
    is_kept = not lasting.words_about_loss(document, path) and not lasting.words_about_plain(document, path)
    return _SVG if is_kept else SUFFIX


def kind_to_save(path: Path) -> str:
    """Return the kind of files of `SAVED_KINDS` that a document is proposed to be saved as."""
    kinds = (kind for kind, ending in _KINDS.items() if path.name.lower().endswith(ending))
    return next(kinds, next(iter(_KINDS)))


def path_to_save(typed: Path, kind: str, proposed: Path) -> Path:
    """Return where a document is saved for a typed name and a kind of files, as `SAVED_KINDS` has it.

    The kind counts where it is another than that of the proposed path, and for a name without an ending. What
    is neither JSON nor a file of a known format by its name gets the suffix of documents.
    """
    name, ending = typed.name, _KINDS.get(kind, "")
    first = _KINDS[kind_to_save(proposed)]
    is_other = ending not in ("", first) and not name.lower().endswith(ending)
    if is_other and (ending != SUFFIX or is_svg(typed)):
        there = max((each for each in _KINDS.values() if name.lower().endswith(each)), key=len, default="")
        return typed.with_name(name[: len(name) - len(there)] + ending)
    known = (".json", *endings_of(FORMATS.written))
    return typed if name.lower().endswith(known) else typed.with_name(name + (ending or SUFFIX))


def why_not_saved_as(name: str) -> str:
    """Return why no document may have such a name, as sentences; empty where it may.

    Under the ending of another format no program, this one among them, would open it.
    """
    name = name.lower()
    others = tuple(each for each in endings_of(FORMATS.written) if each not in _KINDS.values())
    if not name.endswith(others):
        return ""
    title = format_of(name, FORMATS.written).title
    return f"A document is saved as {SUFFIX} or {_SVG}. File › Export writes a {title}."
