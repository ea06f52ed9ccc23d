"""Older versions of the file format, turned into the present one step by step.

Whoever raises the version adds here how a file of the version before becomes one of the next; nothing else
has to know about old files.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

Migration = Callable[[dict[str, Any]], dict[str, Any]]
"""Turns the plain values of a file of one version into those of the next."""


def _with_styles(values: dict[str, Any]) -> dict[str, Any]:
    """Return a file of version 1 as one of version 2: the colour of a curve is that of its stroke."""
    return {**values, "curves": [_with_style(curve) for curve in values["curves"]]}


def _with_style(curve: dict[str, Any]) -> dict[str, Any]:
    rest = {key: value for key, value in curve.items() if key != "colour"}
    return {**rest, "style": {"stroke": curve["colour"]}} if "colour" in curve else rest


MIGRATIONS: dict[int, Migration] = {1: _with_styles}
"""By the version that a migration starts from."""


def can_migrate(version: int, to: int) -> bool:
    """Whether there is a way from `version` to the version `to`."""
    return version < to and all(step in MIGRATIONS for step in range(version, to))


def migrated(values: dict[str, Any], version: int, to: int) -> dict[str, Any]:
    """Return the values of a file of `version` as they stand in a file of the version `to`."""
    for step in range(version, to):
        values = {**MIGRATIONS[step](values), "version": step + 1}
    return values
