"""Elements made to run otherwise: moved as they are, or drawn anew as paths."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from msgspec.structs import replace

from curvecore.arrays import FloatArray

from .. import own_data
from ..basic_shapes import LENGTHS
from ..form_elements import FORMS, element_of, mapped
from ..matrices import combined, moved, transform_of
from ..matrices import inverse_of as inverse_of  # noqa: PLC0414 - most have it from here
from ..numbers import number
from ..shapes import SHAPES
from ..tree import node_types, path_data
from .found import Found, Wanted
from .source import Node, Source

_ALONG = {
    "rect": (("x",), ("y",)),
    "circle": (("cx",), ("cy",)),
    "ellipse": (("cx",), ("cy",)),
    "line": (("x1", "x2"), ("y1", "y2")),
    "use": (("x",), ("y",)),
}
"""The attributes that say where an element is: across, and down."""

_OF_COURSES = ("points", "x", "y", "width", "height", "rx", "ry", "cx", "cy", "r", "x1", "y1", "x2", "y2")
_OF_PROGRAMS = (
    *("type", "cx", "cy", "rx", "ry", "start", "end", "open", "arc-type", "sides", "r1", "r2", "arg1"),
    *("arg2", "expansion", "revolution", "radius", "argument", "t0", "flatsided", "rounded"),
    *("randomized", "path-effect", "original-d", "original", "connector-curvature"),
)
"""What programs note of a shape that is more to them than a path: it would not be true any more."""

NEW_COURSE = "M0 0L1 1"
"""Where a path runs that was just made, until it is drawn."""

_HANGING = ("clip-path", "mask", "filter", "transform")
_DIGITS = 10
_EVEN = 1e-9


def motion(
    before: Sequence[FloatArray], after: Sequence[FloatArray], room: float, *, turns_lines: bool = False
) -> FloatArray | None:
    """Return the affine map (2, 3) from some pieces to others; None where there is none.

    Straight lines are turned and scaled where that is asked for: nothing says what is done across them.
    """
    if [len(each) for each in before] != [len(each) for each in after] or not before:
        return None
    here, there = (np.concatenate(each).reshape(-1, 2) for each in (before, after))
    shift = (there - here).mean(axis=0)
    if (np.abs(here + shift - there) <= room).all():
        return np.column_stack([np.eye(2), shift])
    middle = here.mean(axis=0)
    solved, _, rank, _ = np.linalg.lstsq(here - middle, there - there.mean(axis=0), rcond=1e-9)
    if rank == 2:
        linear = solved.T
    elif turns_lines and rank == 1:
        linear = _turn(here - middle, there - there.mean(axis=0))
    else:
        return None
    result = np.column_stack([linear, there.mean(axis=0) - linear @ middle])
    return result if (np.abs(moved(here, result) - there) <= room).all() else None


def _turn(here: FloatArray, there: FloatArray) -> FloatArray:
    """Return the turn and scaling about the origin that takes places on a line to others, if one does."""
    one, other = here @ (1.0, 1.0j), there @ (1.0, 1.0j)
    by = np.vdot(one, other) / np.vdot(one, one)
    return np.array([[by.real, -by.imag], [by.imag, by.real]])


def motion_of(found: Sequence[Found], wanted: Sequence[Wanted], room: float) -> FloatArray | None:
    """Return the affine map from shapes of a file to those of the document; None where there is none."""
    if [each.closed for each in found] != [each.closed for each in wanted]:
        return None
    after = [piece for each in wanted for piece in each.pieces]
    turns = bool(found) and found[0].is_used
    as_written = motion([piece for each in found for piece in each.pieces], after, room, turns_lines=turns)
    if as_written is not None:
        return as_written
    smooth = [piece for each in found for piece in each.smooth_pieces]
    return motion(smooth, after, room, turns_lines=turns)


def is_plain_path(node: Node, found: Found) -> bool:
    """Whether an element is a path and nothing else: no star or spiral, nothing that hangs at its place."""
    is_more = any(name.rpartition(":")[2] in ("type", "path-effect") for name in node.names if ":" in name)
    css = node.get("style") or ""
    hangs = any(node.get(each) is not None or f"{each}:" in css for each in _HANGING)
    return node.tag == "path" and not is_more and not hangs and not found.style.is_placed


def move_whole(node: Node, around: FloatArray, by: FloatArray) -> None:
    """Move an element with all that is in it; `around` is the map of what is around it."""
    own = transform_of(node.get("transform") or "")
    inner = combined(combined(inverse_of(around), by), around)
    node.set("transform", _transform(combined(inner, own)))


def move(node: Node, found: Found, by: FloatArray) -> None:
    """Move an element as it is, with all that hangs at its place."""
    around = found.drawn[0].anchor.around.matrix
    inner = combined(combined(inverse_of(around), by), around)
    own = transform_of(node.get("transform") or "")
    is_shift = bool(np.allclose(inner[:, :2], np.eye(2), rtol=0, atol=_EVEN))
    css = node.get("style") or ""
    hangs = found.style.is_placed or any(
        node.get(each) is not None or f"{each}:" in css for each in _HANGING[:3]
    )
    if is_shift and not hangs and _shifted(node, inverse_of(own)[:, :2] @ inner[:, 2]):
        return
    move_whole(node, around, by)


def _shifted(node: Node, by: FloatArray) -> bool:
    """Move an element by the attributes that say where it is; return whether it has such in plain numbers."""
    names = _ALONG.get(node.tag, ())
    try:
        places = [
            (name, float(node.get(name) or 0.0) + step)
            for each, step in zip(names, by.tolist(), strict=False)
            for name in each
        ]
    except ValueError:
        return False
    for name, place in places:
        if (text := _short(place)) != (node.get(name) or "0"):
            node.set(name, text)
    return bool(places)


def _transform(matrix: FloatArray) -> str:
    (a, c, e), (b, d, f) = matrix.tolist()
    if max(abs(a - 1), abs(b), abs(c), abs(d - 1)) <= _EVEN:
        return f"translate({_short(e)},{_short(f)})"
    return f"matrix({','.join(map(_short, (a, b, c, d, e, f)))})"


def _short(value: float) -> str:
    plain = float(f"{value:.{_DIGITS}g}")
    return number(0.0 if abs(plain) < 1e-12 else plain)


def redraw(source: Source, node: Node, wanted: Wanted, inverse: FloatArray) -> None:
    """Make an element run so, as a path or as what it is in SVG or to Inkscape.

    Its map to the plane of the file is undone by a matrix.
    """
    tag, attributes, matrix = _form_for(node, wanted, inverse) or ("path", {}, None)
    texts = {source.prefixed(name): text for name, text in attributes.items()}
    for name in node.names:
        prefix, _, own = name.rpartition(":")
        gone = _OF_PROGRAMS if prefix else ("d", *_OF_COURSES) if tag != "path" else _OF_COURSES
        is_kinds = own == "nodetypes" and bool(attributes)
        if (own in gone or is_kinds) and name not in texts and not prefix.startswith("xml"):
            node.drop(name)
    node.rename(tag)
    if tag == "path":
        upside_down = np.array([1.0, -1.0])
        outlines = [
            replace(each, control_points=moved(each.control_points, inverse) * upside_down)
            for each in wanted.outlines
        ]
        texts["d"] = " ".join(path_data(outlines).split())
    if not attributes:
        note_kinds(source, node, wanted)
    if matrix is not None:
        texts["transform"] = _transform(combined(transform_of(node.get("transform") or ""), matrix))
    for name, text in texts.items():
        if node.get(name) != text:
            node.set(name, text)


def note_kinds(source: Source, node: Node, wanted: Wanted) -> None:
    """Have a path say of what kinds its points are, where it did so before or nobody would know."""
    name = next((each for each in node.names if each.endswith(":nodetypes")), "")
    if words := node_types(wanted.outlines, always=bool(name)):
        node.set(name or source.sodipodi("nodetypes"), words)
    elif name:
        node.drop(name)


def note_own_data(node: Node, wanted: Wanted) -> None:
    """Have an element say what we know of a shape beside what SVG says; as it is where it does."""
    data = own_data.of_shape(wanted.outlines)
    if own_data.read(node.get(own_data.ATTRIBUTE), wanted.pieces) == data:
        return
    if words := own_data.words_of(data, wanted.pieces):
        node.set(own_data.ATTRIBUTE, words)
    else:
        node.drop(own_data.ATTRIBUTE)


def _form_for(
    node: Node, wanted: Wanted, inverse: FloatArray
) -> tuple[str, dict[str, str], FloatArray | None] | None:
    """Return what an element becomes that shows a form; None for no more than a path.

    What is none in the file stays one.
    """
    is_form = node.tag in FORMS or any(name.rpartition(":")[1:] == (":", "type") for name in node.names)
    if not (is_form or node.get("d") == NEW_COURSE) or len(wanted.outlines) > 1 or wanted.style.is_placed:
        return None
    if any(node.get(each) is not None for each in _HANGING[:3]):
        return None
    is_path = node.tag == "path" and node.get("d") != NEW_COURSE
    return element_of(mapped(wanted.outlines[0].form, inverse), as_path=is_path)


def can_be_redrawn(node: Node) -> bool:
    """Whether an element draws, and can be made a path."""
    return node.tag in SHAPES and (node.tag == "path" or node.tag in (*LENGTHS, "polyline", "polygon"))
