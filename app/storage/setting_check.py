"""Check of the settings that a file gives a curve: those of its family, and allowed ones."""

from __future__ import annotations

import json
from collections.abc import Mapping

from msgspec.structs import replace

from ..document.limits import MAX_MAGNITUDE
from ..document.model import Curve
from ..families import Family, may_be_name


def settings_problem(curve: Curve) -> str:
    """Return what is wrong with the settings of a curve, with their place; empty where nothing is."""
    if problem := _problem(curve.family, curve.settings):
        return f"settings{problem}"
    seen = {curve.family}
    for index, (family, settings) in enumerate(curve.other_settings):
        place = f"other_settings[{index}]"
        if family in seen:
            return f"{place} must be of a family that has none before it, not {family}"
        seen.add(family)
        if problem := _problem(family, settings):
            return f"{place}[1]{problem}"
    return ""


def without_default_settings(curve: Curve) -> Curve:
    """Return the curve with those settings alone that are not their families' defaults."""
    others = (
        (family, family.settings.without_defaults(settings)) for family, settings in curve.other_settings
    )
    return replace(
        curve,
        settings=curve.family.settings.without_defaults(curve.settings),
        other_settings=tuple(each for each in others if each[1]),
    )


def _problem(family: Family, settings: Mapping[str, object]) -> str:
    """Return what is wrong with settings, to follow their place in the file; empty where nothing is.

    Of a family that is missing nobody knows which it has: names and values that one might are kept.
    """
    for name, value in settings.items():
        if setting := family.settings.named(name):
            is_allowed, requirement = setting.allows(value), setting.requirement
        elif family.is_missing and may_be_name(name):
            is_allowed, requirement = _may_be_setting(value), "a whole number or a word"
        else:
            return f" has a key that {family} does not know: {_shown(name)}"
        if not is_allowed:
            return f".{name} must be {requirement}, not {_shown(value)}"
    return ""


def _may_be_setting(value: object) -> bool:
    return may_be_name(value) or (type(value) is int and abs(value) <= MAX_MAGNITUDE)


def _shown(value: object) -> str:
    """Return a value of JSON as it stands in a file, where that is short."""
    if isinstance(value, list | dict):
        return "a list" if isinstance(value, list) else "an object {…}"
    if isinstance(value, int) and abs(value) > MAX_MAGNITUDE:
        return "a larger one"
    text = str(value)
    return json.dumps(f"{text[:40]}…" if isinstance(value, str) and len(text) > 40 else value)
