"""Clones of a file that are paths afterwards, and why."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence

from ....document.words import names_of
from ..names import name_of
from .courses import motion_of
from .found import Found, Wanted
from .looks import Looks
from .plan import Plan, Planner


def lost_clones(
    plan: Plan,
    planner: Planner,
    seen: Sequence[Found],
    wanted: Sequence[Wanted],
    room: float,
    looks: Looks,
) -> tuple[str, ...]:
    """Return which clones a plan leaves as paths, in a sentence for each reason.

    Not those that a person unlinked.
    """
    names: defaultdict[tuple[str, str], dict[str, None]] = defaultdict(dict)
    told = set()
    for entry in plan.entries:
        place = entry.shapes[0]
        if entry.number is not None or entry.of is not None:
            continue
        now, origin = wanted[place], planner.pairs.get(place)
        if origin is None:
            if now.clone_of:
                names[_noun(now), "it looks otherwise than its original"][f"“{now.name}”"] = None
            continue
        found = seen[origin]
        is_meant = place in planner.unlinked and motion_of([found], [now], room) is not None
        if found.is_used and found.node not in told and not is_meant:
            told.add(found.node)
            name = name_of(found.drawn[0].anchor.element) or found.name
            names[_noun(now), _reason(found, now, room, looks)][f"“{name}”"] = None
    return tuple(_sentence(list(each), *what) for what, each in names.items())


def _noun(shape: Wanted) -> str:
    """Return what a shape is in the file that is no clone."""
    return shape.content.noun if shape.content is not None else "path"


def _reason(found: Found, now: Wanted, room: float, looks: Looks) -> str:
    """Return why a clone cannot stay one: what of it is not as in the file."""
    if motion_of([found], [now], room) is None:
        return "its own points were moved"
    if looks.differing(found.style, now.style) or found.visible != now.visible:
        return "it looks otherwise than its original"
    return "its original was changed and it was not"


def _sentence(names: list[str], noun: str, reason: str) -> str:
    if len(names) == 1:
        return f"The clone {names[0]} became a {noun}, because {reason}."
    return f"The clones {names_of(names)} became {noun}s; of each, {reason}."
