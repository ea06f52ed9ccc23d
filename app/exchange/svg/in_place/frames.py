"""Texts and pictures written new into a file."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from msgspec.structs import replace

from curvecore.arrays import FloatArray

from ....document.content import Lettering, Picture
from ....document.contents import Plane, plane_of
from ..content_elements import content_element
from ..matrices import combined
from .courses import NEW_COURSE, inverse_of
from .found import Found, Wanted
from .on_paths import Carrier, on_carrier
from .rooms import new_room
from .source import Node, Source


def is_unwritten(node: Node) -> bool:
    """Whether an element was just made, and is yet to be what it shall be."""
    return node.get("d") == NEW_COURSE


def write_content(
    source: Source, node: Node, found: Found, wanted: Wanted, known: Mapping[str, Carrier]
) -> FloatArray:
    """Make an element the text or the picture of the document; return its map to the plane of the file.

    What may lie along an element that shows a curve is `known`.
    """
    content = wanted.content
    assert content is not None
    if isinstance(content, Picture) and content.link:
        # Its file lies where the others of the drawing say that it does.
        content = replace(content, data="")
    plane, path = plane_of(content, wanted.outlines[0].corners), ""
    if isinstance(content, Lettering) and content.along is not None:
        content, plane, path = on_carrier(source, content, plane, known)
    (a, b), (c, d) = plane.across, plane.down
    matrix = np.array([[a, c, plane.x], [b, d, plane.y]])
    (a, c, x), (b, d, y) = combined(inverse_of(found.drawn[0].anchor.around.matrix), matrix).tolist()
    if isinstance(content, Lettering) and content.flow is not None:
        path = new_room(source, content)
    (new,) = source.adopted(content_element(content, Plane(x, -y, (a, -b), (c, -d)), "", path))
    node.drop("d")
    node.take_over(new)
    if wanted.is_named_by_words:
        for name in [each for each in node.names if each.endswith(":label")]:
            node.drop(name)
    else:
        node.set(source.inkscape("label"), wanted.name)
    return matrix
