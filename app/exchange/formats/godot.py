"""Curves of Godot in: the `Curve2D` of text resources and scenes, with y turned up."""

from __future__ import annotations

import re
from itertools import zip_longest

import numpy as np

from curvecore.arrays import FloatArray

from ..cubics_in import ImportedPath, ImportResult, Look, import_paths, lines
from ..errors import ExchangeError, Loss, Losses
from . import ContentKind, Format

_SECTION = re.compile(r"^\[(\w+)(.*)\]\s*$", re.MULTILINE)
_POINTS = re.compile(r'"points"\s*:\s*P(?:acked|ool)Vector2Array\(([^)]+)\)')
_USED = re.compile(r'^curve = SubResource\(\s*"?(.*?)"?\s*\)', re.MULTILINE)
_PLACED = re.compile(r"^(?:position|rotation|scale|skew|transform) = ", re.MULTILINE)
_NOT_APPLIED = Loss("node", "with a position, rotation or scale of its own imported without it")


def read_curves(data: bytes, _tolerance: float | None = None) -> ImportResult:
    """Return the curves of a resource or scene, named after the nodes that use them.

    A curve whose last point is its first is closed. A piece without handles is a straight line.

    Raises
    ------
    ExchangeError
        With the line of points that are no numbers, or not six for each point; and where there is no curve.
    """
    text = data.decode("utf-8", "replace")
    sections = list(_SECTION.finditer(text))
    curves, names, losses = dict[str, FloatArray](), dict[str, str](), Losses()
    for head, following in zip_longest(sections, sections[1:]):
        owner = sections[0] if head[1] == "resource" else head
        body = text[head.end() : following.start() if following else None]
        if _attribute(owner, "type") == "Curve2D" and (points := _POINTS.search(body)):
            line = text.count("\n", 0, head.end() + points.start()) + 1
            curves[_attribute(head, "id")] = _points(points[1], line)
        if head[1] == "node" and (used := _USED.search(body)):
            name = names.setdefault(used[1], _attribute(head, "name"))
            if _PLACED.search(body):
                losses.note(_NOT_APPLIED, head.start(), name)
    if not curves:
        raise ExchangeError("The file contains no Curve2D. Save it or its scene as text (.tres, .tscn).")
    paths = [
        ImportedPath(names.get(key, f"Curve {number}"), Look(), *_pieces(points))
        for number, (key, points) in enumerate(curves.items(), start=1)
    ]
    return import_paths(paths, losses).with_curves()


def _attribute(head: re.Match[str], name: str) -> str:
    match = re.search(rf'\b{name}\s*=\s*(?:"(.*?)"|(\w+))', head[2])
    return (match[1] or match[2]) if match else ""


def _points(text: str, line: int) -> FloatArray:
    """Return handles in, handles out and positions, (3, n, 2), with y up."""
    try:
        values = np.asarray_chkfinite(text.split(","), dtype=float).reshape(-1, 3, 2)
    except ValueError:
        raise ExchangeError(f"Line {line}: a curve needs six numbers per point.") from None
    return values.swapaxes(0, 1) * (1.0, -1.0) + 0.0


def _pieces(points: FloatArray) -> tuple[FloatArray, bool]:
    """Return cubic pieces, and whether they are closed."""
    into, out, at = points
    pieces = np.stack([at[:-1], at[:-1] + out[:-1], at[1:] + into[1:], at[1:]], axis=1)
    straight = (out[:-1] == 0).all(axis=1) & (into[1:] == 0).all(axis=1)
    pieces[straight] = lines(at)[straight]
    return pieces, len(at) > 2 and bool((at[0] == at[-1]).all())


GODOT = Format(
    endings=(".tres", ".tscn"),
    title="Godot curve",
    rank=78,
    kind=ContentKind.DRAWING,
    read=read_curves,
)
