"""SVG as people copy it: whole files, elements out of one, path data alone."""

from __future__ import annotations

import re
from dataclasses import dataclass
from dataclasses import replace as with_fields
from typing import TYPE_CHECKING

from msgspec.structs import replace

from ... import exchange
from ...document.style import PLAIN_STYLE
from ...tasks.progress import Report, silent
from .. import svg

if TYPE_CHECKING:
    from ..cubics_in import ImportResult

_ELEMENTS = "svg|g|path|rect|circle|ellipse|line|polyline|polygon|use|symbol|defs"
_ROOT = re.compile(r"<(?:[\w-]+:)?svg[\s/>]")
_ELEMENT = re.compile(rf"<(?:{_ELEMENTS})[\s/>]")
_PROLOGUE = re.compile(
    r"\s*(?:<\?[^>]*\?>\s*|<!--.*?-->\s*|<!DOCTYPE[^>\[]*(?:\[.*?\]\s*)?>\s*)*<", re.DOTALL
)
_PATH = re.compile(r"[Mm]\s*[-+.\d][-+.,\d\sMmZzLlHhVvCcSsQqTtAaEe]*")
_SVG, _XLINK = "http://www.w3.org/2000/svg", "http://www.w3.org/1999/xlink"

SMALL = 2**16
"""Bytes that are read in this process: to start another one takes longer."""


@dataclass(frozen=True)
class Fragment:
    """Text to be read as SVG.

    Attributes
    ----------
    data
        A whole file.
    is_bare
        Whether the text was path data alone, without a style.
    """

    data: bytes
    is_bare: bool = False


def fragment_in(text: str) -> Fragment | None:
    """Return the SVG in a text: a file, elements of one, or path data; None for other text."""
    data = text.strip().removeprefix("d=").strip("\"';")
    if _PATH.fullmatch(data):
        return Fragment(f'<svg xmlns="{_SVG}"><path d="{data}"/></svg>'.encode(), is_bare=True)
    if not (match := _PROLOGUE.match(text)):
        return None
    elements, start = text[match.end() - 1 :], match.end() - 1
    if _ROOT.match(elements):
        return Fragment(_declared(text).encode())
    if _ELEMENT.match(elements):
        return Fragment(f'<svg xmlns="{_SVG}" xmlns:xlink="{_XLINK}">{text[start:]}</svg>'.encode())
    return None


def _declared(text: str) -> str:
    """Return a file with the namespaces that it needs, which are implied within HTML."""
    root = _ROOT.search(text)
    assert root is not None
    end = root.end() - 1
    tag = text[end : text.find(">", end)]
    missing = "" if "xmlns=" in tag or ":" in root[0] else f' xmlns="{_SVG}"'
    if "xlink:" in text and "xmlns:xlink" not in text:
        missing += f' xmlns:xlink="{_XLINK}"'
    return text[:end] + missing + text[end:]


def read_fragment(fragment: Fragment, report: Report = silent) -> ImportResult:
    """Return the curves of a fragment, in a unit; path data alone become lines in ink, without a unit.

    Raises
    ------
    ExchangeError
        As `read_svg`, and if there is no curve; a large one is read in a process with limits.
    """
    report(0.0, "Reading")
    reader = svg.reader.read_svg
    if len(fragment.data) <= SMALL:
        result = exchange.reader_process.read_in_this_process(reader, fragment.data)
    else:
        result = exchange.reader_process.read_in_process(reader, fragment.data, None, report=report)
    result = result.with_curves()
    if not fragment.is_bare:
        is_ours = svg.own_files.MARK.encode() in fragment.data
        # Without a unit SVG is in pixels, but a file of Curvebench in a unit-less document's units.
        unit = result.document.unit or ("" if is_ours else "px")
        return with_fields(result, document=replace(result.document, unit=unit))
    curves = tuple(replace(curve, name="Path", style=PLAIN_STYLE) for curve in result.document.curves)
    return with_fields(result, document=replace(result.document, curves=curves))
