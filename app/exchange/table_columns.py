"""What the columns of a table are: numbers of a point, or words that say which curve it belongs to."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, fields

ROLES = ("t", "x", "y", "vx", "vy", "ax", "ay")
"""What a column of numbers can be, for every point."""

AFTER = ("vx_after", "vy_after", "ax_after", "ay_after")
"""The derivatives after a corner; those of `ROLES` are the ones before it then."""

WORDS = ("curve", "family")
"""What a column of text can be: the name of the row's curve, and its family."""


@dataclass(frozen=True)
class Mapping:
    """Which column is what, counted from 0; None where there is no such column."""

    x: int
    y: int
    t: int | None = None
    vx: int | None = None
    vy: int | None = None
    ax: int | None = None
    ay: int | None = None
    vx_after: int | None = None
    vy_after: int | None = None
    ax_after: int | None = None
    ay_after: int | None = None
    curve: int | None = None
    family: int | None = None

    def columns(self, roles: Sequence[str]) -> dict[str, int]:
        """Return the columns that there are for some of the roles."""
        found = {role: getattr(self, role) for role in roles}
        return {role: column for role, column in found.items() if column is not None}


def guessed(titles: tuple[str, ...]) -> Mapping | None:
    """Return the columns by their titles; without titles x and y, or t, x and y if there are three."""
    plain = [re.split(r"[\s\[(]", title.strip().lower())[0] for title in titles]
    known = {each.name: plain.index(each.name) for each in fields(Mapping) if each.name in plain}
    if "x" in known and "y" in known:
        return Mapping(**known)
    if len(titles) < 2:
        return None
    return Mapping(1, 2, t=0) if len(titles) == 3 else Mapping(0, 1)
