"""What is known of the groups that a curve is in beside their names."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import groupby
from typing import Annotated, TypeVar

from msgspec.structs import replace

from .fields import SHARE
from .value import Value

_Part = TypeVar("_Part")


class GroupLook(Value, frozen=True):
    """How a group is drawn as a whole.

    All that is in it has the same, so that it goes with that wherever it comes; a group which is drawn as
    usual has none.

    Attributes
    ----------
    name
        That of the group.
    opacity
        Of all that is in it together.
    """

    name: str
    opacity: Annotated[float, SHARE] = 1.0


GroupLooks = tuple[GroupLook, ...]
"""Those of the groups around a curve that are not drawn as usual, the outermost first."""


def opacity_of(looks: Iterable[GroupLook], name: str) -> float:
    """Return the opacity of a group."""
    return next((each.opacity for each in looks if each.name == name), 1.0)


def with_opacity(looks: GroupLooks, groups: Sequence[str], name: str, opacity: float) -> GroupLooks:
    """Return the looks of groups within each other with another opacity of one of them."""
    found = {each.name: each.opacity for each in looks} | {name: opacity}
    return looks_of(groups, found)


def looks_of(groups: Iterable[str], opacities: Mapping[str, float]) -> GroupLooks:
    """Return the looks of groups within each other, of which some have these opacities."""
    return tuple(GroupLook(name, share) for name in groups if (share := opacities.get(name, 1.0)) < 1)


def with_names(looks: GroupLooks, names: Mapping[str, str]) -> GroupLooks:
    """Return the looks of groups that have other names now."""
    return tuple(replace(each, name=names.get(each.name, each.name)) for each in looks) if looks else looks


def together(
    parts: Iterable[_Part], looks: Callable[[_Part], GroupLooks], depth: int = 0
) -> Iterator[tuple[GroupLook | None, list[_Part]]]:
    """Yield parts that follow each other in one group which is seen through, and its look; None of others.

    `depth` is the number of such groups around all of them.
    """
    for look, run in groupby(parts, lambda part: next(iter(looks(part)[depth : depth + 1]), None)):
        yield look, list(run)
