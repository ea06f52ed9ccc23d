"""Older versions of the file format, turned into the present one step by step.

Version 1 is the first that there is, so the table is empty. Whoever raises the version adds here how a file
of the version before becomes one of the next; nothing else has to know about old files.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

Migration = Callable[[dict[str, Any]], dict[str, Any]]
"""Turns the plain values of a file of one version into those of the next."""

MIGRATIONS: dict[int, Migration] = {}
"""By the version that a migration starts from."""


def can_migrate(version: int, to: int) -> bool:
    """Whether there is a way from `version` to the version `to`."""
    return version < to and all(step in MIGRATIONS for step in range(version, to))


def migrated(values: dict[str, Any], version: int, to: int) -> dict[str, Any]:
    """Return the values of a file of `version` as they stand in a file of the version `to`."""
    for step in range(version, to):
        values = {**MIGRATIONS[step](values), "version": step + 1}
    return values
