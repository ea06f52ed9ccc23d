"""Texts on paths, written on those that are in a file."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import count
from typing import NamedTuple

from ....document.along_path import Along, Ground
from ....document.content import Lettering
from ....document.contents import Plane
from ....document.forms import Ellipse
from ..inkscape_forms import arc_attributes
from ..text_path_elements import along_shown, course_data
from .found import Found, Wanted
from .letter_sizes import size_of
from .placing import Entry, definitions
from .source import Node, Source

_ROUND = {"circle": ("cx", "cy", "r"), "ellipse": ("cx", "cy", "rx", "ry")}


class Carrier(NamedTuple):
    """The element of a curve that texts may lie along.

    Attributes
    ----------
    node
        The element.
    ground
        From the units around it to the plane of the file.
    """

    node: Node
    ground: Ground


def carriers(
    entries: Iterable[tuple[Entry, Node]], wanted: Sequence[Wanted], shown: Mapping[Node, Sequence[Found]]
) -> dict[str, Carrier]:
    """Return the elements of curves, by their identities."""
    found = dict[str, Carrier]()
    for entry, node in entries:
        outlines = [each for place in entry.shapes if node in shown for each in wanted[place].outlines]
        for identity in {each.identity for each in outlines} - {""}:
            (a, c, x), (b, d, y) = shown[node][0].drawn[0].anchor.around.matrix.tolist()
            found[identity] = Carrier(node, (x, y, a, b, c, d))
    return found


def on_carrier(
    source: Source, text: Lettering, plane: Plane, known: Mapping[str, Carrier]
) -> tuple[Lettering, Plane, str]:
    """Return a text in the units of the path that it lies along, where it lies, and the id of that.

    One whose path is not in the file gets one there that is drawn nowhere.
    """
    assert text.along is not None
    carrier = known.get(text.along.of)
    shown = along_shown(text, plane, carrier.ground) if carrier is not None else None
    if carrier is not None and shown is not None:
        _make_path(source, carrier.node)
        return *shown, _id_of(source, carrier.node)
    (made,) = source.adopted(f'<path d="{course_data(text.along)}"/>')
    made.put_last(definitions(source))
    return text, plane, _id_of(source, made)


def _make_path(source: Source, node: Node) -> None:
    """Make a circle or an ellipse a path that Inkscape takes for one: browsers know no other courses."""
    if node.tag not in _ROUND:
        return
    own = {name: node.get(name) or "0" for name in _ROUND[node.tag]}
    try:
        x, y, rx, *ry = map(float, own.values())
    except ValueError:
        return
    ellipse = Ellipse(x - rx, -y - (ry or [rx])[0], 2 * rx, 2 * (ry or [rx])[0])
    for name in own:
        node.drop(name)
    node.rename("path")
    for name, text in arc_attributes(ellipse).items():
        node.set(source.prefixed(name), text)
    course = Along(tuple(tuple((x, -y) for x, y in piece) for piece in ellipse.pieces))  # type: ignore[misc]
    node.set("d", f"{course_data(course)} Z")


def _id_of(source: Source, node: Node) -> str:
    own = node.get("id")
    if not own:
        taken = source.ids
        own = next(name for number in count(1) if (name := f"path{number}") not in taken)
        node.set("id", own)
    return own


def set_start(node: Node, before: Lettering, after: Lettering) -> bool:
    """Let a text begin elsewhere on its path, or lie on the other side; return whether it has a path."""
    inner = next((each for each in node.elements if each.tag == "textPath"), None)
    along = after.along
    if inner is None or along is None:
        return False
    start = along.start * (1.0 if along.is_share else size_of(before) / size_of(after))
    inner.set("startOffset", f"{100 * start:.10g}%" if along.is_share else f"{start:.10g}")
    if along.is_flipped:
        inner.set("side", "right")
    else:
        inner.drop("side")
    return True
