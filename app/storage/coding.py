"""Hooks for msgspec: encoding and decoding of families, their settings, and numbers of NumPy."""

from __future__ import annotations

from types import NoneType

from ..families import FAMILIES, Family, FamilySettingValues, SettingValue, may_be_name

_JSON_NAMES = {bool: "bool", int: "int", float: "float", list: "array", dict: "object", NoneType: "null"}
"""Names of JSON types as in the messages of msgspec."""


def encode_hook(value: object) -> str | float | dict[str, SettingValue]:
    """Return the JSON value of a family (its name), of settings, or of a number of NumPy."""
    if isinstance(value, FamilySettingValues):
        return dict(value)
    return value.name if isinstance(value, Family) else float(value)  # type: ignore[arg-type]


def decode_hook(kind: type, value: object) -> Family | FamilySettingValues:
    """Return the family of a name, installed or not, or the settings of a family.

    Raises
    ------
    ValueError
        With a message like those of msgspec, which adds the field, if no family can have that name or the
        settings are not an object; `validate` checks their content.
    """
    if kind is FamilySettingValues:
        if not isinstance(value, dict):
            raise ValueError(f"Expected `object`, got `{_JSON_NAMES[type(value)]}`")
        return FamilySettingValues(value)
    if not isinstance(value, str):
        raise ValueError(f"Expected `str`, got `{_JSON_NAMES[type(value)]}`")
    if not may_be_name(value):
        raise ValueError(f"Invalid enum value '{value}'")
    return FAMILIES.named(value)
