"""Layers in which there is no curve: those of the document come to be in a file, others go."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from ....document.empty_layer import EmptyLayer
from ...naming import Names
from ..tree import stem
from .found import Reading
from .placing import lock, show
from .source import Source


def set_empty_layers(
    source: Source, reading: Reading, wanted: Sequence[EmptyLayer], begun: Collection[str]
) -> bool:
    """Let a file have these empty layers; return whether it is another one now.

    Of others those go that the document `begun` with, unless there is something in them that does not come
    in, such as a text.
    """
    known = {layer.name: (node, layer) for node, layer in reading.empty_layers.items()}
    names = {each.name for each in wanted}
    gone = [
        node for name, (node, _) in known.items() if name in begun and name not in names and not node.elements
    ]
    for node in gone:
        node.take_out()
    has_changed, ids = bool(gone), Names(source.ids, between="_")
    by_name = {name: node for node, name in reading.groups.items()}
    for layer in wanted:
        if layer.name in by_name and layer.name not in known:
            # There are shapes in it that were not taken in.
            continue
        node, before = known.get(layer.name) or (source.new("g"), EmptyLayer(layer.name))
        if layer.name not in known:
            by_name[layer.name] = node
            node.set("id", ids.different(stem(layer.name, "layer")))
            node.set(source.inkscape("groupmode"), "layer")
            node.set(source.inkscape("label"), layer.name)
            node.put_last(by_name.get(layer.inside, source.root))
            has_changed = True
        if layer.visible != before.visible:
            show(node, layer.visible)
            has_changed = True
        if layer.locked != before.locked:
            lock(source, node, layer.locked)
            has_changed = True
    return has_changed


def arrange_empty_layers(reading: Reading, order: Sequence[str]) -> bool:
    """Put empty layers between those beside them as the `order` of all has them; whether some moved."""
    nodes = {name: node for node, name in reading.groups.items() if node in reading.layers}
    empty, has_moved = set(reading.empty_layers), False
    for around in {node.parent for node in nodes.values()}:
        wanted = [nodes[name] for name in order if name in nodes and nodes[name].parent is around]
        for index, node in enumerate(wanted):
            now = [each for each in around.elements if each in wanted] if around is not None else []
            place = now.index(node) if node in empty else 0
            before = now[place - 1] if place else None
            if node not in empty or before is (wanted[index - 1] if index else None):
                continue
            node.take_out()
            if index:
                node.put_behind(wanted[index - 1])
            else:
                node.put_before(now[0])
            has_moved = True
    return has_moved


def has_empty_layers(reading: Reading, wanted: Sequence[EmptyLayer], begun: Collection[str]) -> bool:
    """Whether a file has these empty layers, and no others that the document `begun` with."""
    known = {each.name: each for each in reading.empty_layers.values()}
    names = {each.name for each in wanted}
    filled = {name for name in reading.groups.values() if name not in known}
    return all(known.get(each.name) == each or each.name in filled for each in wanted) and not any(
        name in begun and name not in names for name in known
    )
