"""What becomes of each element of a file: what it shows of the document, in which groups, or that it goes."""

from __future__ import annotations

import math
import re
from collections import Counter, defaultdict
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

from ....document.group_look import opacity_of
from ..paint import share_of
from .found import Found, Reading, Wanted
from .looks import value_of
from .placing import Entry, GroupWanted
from .source import Node


@dataclass(frozen=True)
class Plan:
    """Elements that shall be there.

    Attributes
    ----------
    entries
        Those that show shapes, in their order.
    groups
        The groups around, by their names.
    removed
        The places, among all of the file, of those that show nothing any more.
    dissolved
        Those of groups that are none any more.
    """

    entries: tuple[Entry, ...]
    groups: Mapping[str, GroupWanted]
    removed: tuple[int, ...]
    dissolved: tuple[int, ...]


_NUMBERED = re.compile(r"\w+( \d+)?( \(\d+\))?")
"""A name that the reader gives to what has none."""


class Planner:
    """Plans for one document in one file.

    Parameters
    ----------
    wanted
        The shapes of the document.
    base
        The file.
    pairs
        For each shape of the document, the place of that of the file which it comes from.
    taken
        The places of the shapes of the file that came in.
    layers
        The names of the groups that are layers.
    clones
        The places of what shapes are clones of, by theirs.
    unlinked
        The places of those that are clones in the file alone.
    """

    def __init__(
        self,
        wanted: Sequence[Wanted],
        base: Reading,
        pairs: Mapping[int, int],
        taken: Collection[int],
        layers: Collection[str],
        clones: Mapping[int, int],
        unlinked: Collection[int],
    ) -> None:
        self._wanted, self._base, self.pairs, self._layers = wanted, base, pairs, layers
        self._clones, self.unlinked = clones, unlinked
        self._units: defaultdict[Node, list[int]] = defaultdict(list)
        for place, shape in enumerate(base.seen):
            if place in taken:
                self._units[shape.node].append(place)
        self._number = {node: number for number, node in enumerate(base.nodes)}

    def plan(self, anew: Collection[int]) -> Plan:
        """Return the plan with some elements, by their places in the file, to be written anew."""
        entries: list[Entry] = []
        kept: set[Node] = set()
        done = 0
        while done < len(self._wanted):
            entry, node = self._entry(done, anew, kept)
            entries.append(entry)
            done += len(entry.shapes)
            if node is not None:
                kept.add(node)
        alone = {each.shapes[0] for each in entries if len(each.shapes) == 1}
        entries = [each if each.of in alone else replace(each, of=None) for each in entries]
        removed = tuple(self._number[node] for node in self._units if node not in kept)
        groups = self._group_plan(entries)
        inside = {each for node in self._units for each in self._base.seen[self._units[node][0]].around}
        known = {self._number[node] for node in inside if node in self._base.groups}
        dissolved = tuple(known - {each.number for each in groups.values()})
        return Plan(tuple(entries), groups, removed, dissolved)

    def _entry(self, place: int, anew: Collection[int], kept: Collection[Node]) -> tuple[Entry, Node | None]:
        """Return what shows a shape, and those behind that the same element shows, and that element."""
        wanted = self._wanted[place]
        origin = self.pairs.get(place)
        of = self._clones.get(place) if -1 - place not in anew else None
        if origin is None:
            return Entry((place,), wanted.groups, name=wanted.name, of=of), None
        found = self._base.seen[origin]
        unit, number = self._units[found.node], self._number[found.node]
        places = tuple(range(place, place + len(unit)))
        is_whole = [self.pairs.get(each) for each in places] == unit and found.node not in kept
        groups = self._outer(found, wanted)
        stays = number not in anew and not any(each in self.unlinked for each in places)
        if is_whole and groups is not None and stays:
            is_renamed = wanted.name != found.name and not _is_unnamed(found.node, wanted.name)
            is_renamed = is_renamed and not (found.is_named_by_words and wanted.is_named_by_words)
            name = wanted.name if is_renamed and len(unit) == 1 else ""
            return Entry(places, groups, number, name=name), found.node
        identity = (found.node.get("id") or "") if len(unit) == 1 else ""
        return Entry((place,), wanted.groups, None, identity, wanted.name, of), None

    def _outer(self, found: Found, wanted: Wanted) -> tuple[str, ...] | None:
        """Return the groups around the element of a shape; None where those within it are others now."""
        inner = found.groups[len(self._outer_names(found)) :]
        if not inner:
            return wanted.groups
        return wanted.groups[: -len(inner)] if wanted.groups[-len(inner) :] == inner else None

    def _outer_names(self, found: Found) -> tuple[str, ...]:
        return tuple(self._base.groups[node] for node in found.around if node in self._base.groups)

    # Groups

    def _group_plan(self, entries: Iterable[Entry]) -> Mapping[str, GroupWanted]:
        inside: defaultdict[str, list[int]] = defaultdict(list)
        depths: dict[str, int] = {}
        for entry in entries:
            for depth, name in enumerate(entry.groups):
                inside[name] += entry.shapes
                depths[name] = depth
        nodes = self._group_nodes(inside, depths)
        groups = {name: self._group(name, places, nodes.get(name)) for name, places in inside.items()}
        for entry in entries:
            for outer, name in pairwise(entry.groups):
                # What is hidden or locked with all around it is not itself.
                hides, locks = (groups[outer].hides, groups[outer].locks)
                inner = groups[name]
                groups[name] = replace(
                    inner,
                    hides=None if hides and inner.hides else inner.hides,
                    locks=None if locks and inner.locks else inner.locks,
                )
        return groups

    def _group_nodes(
        self, inside: Mapping[str, Sequence[int]], depths: Mapping[str, int]
    ) -> Mapping[str, Node]:
        """Return the element of each group that there is in the file: of its name, or around its shapes."""
        known = {name: node for node, name in self._base.groups.items()}
        nodes: dict[str, Node] = {}
        around = {
            name: [
                self._outer_names(self._base.seen[self.pairs[each]]) for each in places if each in self.pairs
            ]
            for name, places in inside.items()
        }
        same = {name: name for name, outer in around.items() if any(name in each for each in outer)}
        at_depth = {
            name: [each[depths[name]] for each in outer if len(each) > depths[name]]
            for name, outer in around.items()
        }
        former = {name: Counter(outer).most_common(1)[0][0] for name, outer in at_depth.items() if outer}
        for wishes in (same, former, {name: name for name in inside if name in known}):
            for name, wish in wishes.items():
                if name not in nodes and known[wish] not in nodes.values():
                    nodes[name] = known[wish]
        return nodes

    def _group(self, name: str, places: Iterable[int], node: Node | None) -> GroupWanted:
        is_layer = name in self._layers
        shapes = [self._wanted[each] for each in places]
        opacity = opacity_of(shapes[0].outlines[0].group_looks, name)
        if node is None:
            return GroupWanted(name, is_layer=is_layer, opacity=opacity if opacity < 1 else None)
        was = self._base.opacities[node]
        if math.isclose(opacity, was, rel_tol=1e-6):
            new_opacity = None
        else:
            # What is around it, and none of the document's groups, may let something through, too.
            new_opacity = (
                min(opacity * share_of(value_of(node, "opacity") or "1") / was, 1.0) if was else opacity
            )
        before = [shape for shape in self._base.seen if node in shape.around]
        hidden = value_of(node, "display") == "none"
        locked = any(name.endswith(":insensitive") and node.get(name) == "true" for name in node.names)
        hides = _as_a_whole(
            all(not each.visible for each in shapes), all(not each.visible for each in before), hidden
        )
        locks = _as_a_whole(all(each.locked for each in shapes), all(each.locked for each in before), locked)
        return GroupWanted(
            name,
            self._number[node],
            is_layer,
            name != self._base.groups[node] and not _is_unnamed(node, name),
            is_layer != (node in self._base.layers),
            hides,
            locks,
            new_opacity,
        )


def _as_a_whole(all_now: bool, all_before: bool, group_is: bool) -> bool | None:
    """Return what is to become of a group, which is so or not; None for nothing."""
    if all_now and not all_before:
        return None if group_is else True
    return False if group_is and not all_now else None


def _is_unnamed(node: Node, name: str) -> bool:
    """Whether an element has no name, and the document none that somebody gave it."""
    has_name = any(each == "id" or each.endswith((":label", "data-name")) for each in node.names)
    return not has_name and _NUMBERED.fullmatch(name) is not None
