"""Hooks for msgspec: how the document's values are written that are no plain JSON values."""

from __future__ import annotations

from types import NoneType

from ..families import FAMILIES, ChosenSettings, Family, SettingValue, may_be_name

_JSON_NAMES = {bool: "bool", int: "int", float: "float", list: "array", dict: "object", NoneType: "null"}
"""The names that msgspec has for the values of JSON in its own refusals."""


def encode_hook(value: object) -> str | float | dict[str, SettingValue]:
    """Return what stands for a value: the name of a family, a number of NumPy's as one of Python's."""
    if isinstance(value, ChosenSettings):
        return dict(value)
    return value.name if isinstance(value, Family) else float(value)  # type: ignore[arg-type]


def decode_hook(kind: type, value: object) -> Family | ChosenSettings:
    """Return the family of a name, which may be there elsewhere if not here, or the settings of one.

    Raises
    ------
    ValueError
        In the words of msgspec, which adds the place, where no family can be called that, or settings are no
        object; `validate` looks at what they hold.
    """
    if kind is ChosenSettings:
        if not isinstance(value, dict):
            raise ValueError(f"Expected `object`, got `{_JSON_NAMES[type(value)]}`")
        return ChosenSettings(value)
    if not isinstance(value, str):
        raise ValueError(f"Expected `str`, got `{_JSON_NAMES[type(value)]}`")
    if not may_be_name(value):
        raise ValueError(f"Invalid enum value '{value}'")
    return FAMILIES.named(value)
