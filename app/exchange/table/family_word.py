"""Families in the cells of a table: the name, whether the curve is closed, and what is set of the family."""

from __future__ import annotations

from typing import NamedTuple

from ...document.model import Curve
from ...families import FAMILIES, NO_SETTINGS, ChosenSettings, Family, FamilySetting, SettingValue

_CLOSED = "closed"


class FamilyWord(NamedTuple):
    """A cell's words about a curve.

    Attributes
    ----------
    family, closed, settings
        As in the document; the last row of a closed curve is its first point again.
    """

    family: Family
    closed: bool = False
    settings: ChosenSettings = NO_SETTINGS


def family_word(curve: Curve) -> str:
    """Return the cell for a curve: closed hermite, or floater_hormann degree=5."""
    words = [_CLOSED] if curve.is_closed else []
    return " ".join(
        [*words, curve.family.name, *(f"{name}={value}" for name, value in curve.settings.items())]
    )


def read_family_word(text: str) -> FamilyWord:
    """Return what a cell says.

    Raises
    ------
    ValueError
        With what it must be, to follow "must be".
    """
    words = text.strip().lower().split()
    closed = words[:1] == [_CLOSED]
    name, *pairs = words[closed:] or [""]
    family = FAMILIES.called(name)
    if family is None:
        raise ValueError(f"one of {', '.join(map(str, FAMILIES))}")
    chosen = dict(_read_setting(family, pair) for pair in pairs)
    return FamilyWord(family, closed, family.settings.without_defaults(chosen))


def _read_setting(family: Family, pair: str) -> tuple[str, SettingValue]:
    name, _, text = pair.partition("=")
    setting = family.settings.named(name)
    if setting is None:
        known = ", ".join(f"{family} {each.name}={each.default}" for each in family.settings.all)
        raise ValueError(known or f"{family} alone, which has no settings")
    value = _value(setting, text)
    if not setting.allows(value):
        raise ValueError(f"{family} with {name}= and {setting.requirement}")
    return name, value


def _value(setting: FamilySetting, text: str) -> SettingValue:
    return int(text) if setting.limits is not None and text.removeprefix("-").isdecimal() else text
