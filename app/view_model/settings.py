"""Settings that belong to a record: an overlay or a tool. Qt-free; the widgets and the stored keys follow."""

from __future__ import annotations

from typing import Any, Generic, Self, TypeVar

import msgspec

Value_co = TypeVar("Value_co", covariant=True)


class OwnedSetting(msgspec.Struct, Generic[Value_co], frozen=True):
    """A value that an overlay or a tool works with.

    Attributes
    ----------
    name
        Object name of the widget that sets it.
    label
        Its name, for people.
    default
        Its value until it is set.
    """

    name: str
    label: str
    default: Value_co


class ChoiceSetting(OwnedSetting[Value_co], frozen=True, kw_only=True):
    """One member of a `NamedEnum`, set in a box of the preferences and by an action for each member.

    Attributes
    ----------
    tip
        The tooltip, without the member.
    key
        The key under which the choice is stored.
    """

    tip: str
    key: str


class SwitchSetting(OwnedSetting[bool], frozen=True, kw_only=True):
    """On or off, set by a check box of the preferences."""

    tip: str
    key: str


class SettingValues(msgspec.Struct, frozen=True):
    """Values of settings; `values` has those that were set."""

    values: frozenset[tuple[OwnedSetting[Any], Any]] = frozenset()

    def value(self, setting: OwnedSetting[Value_co]) -> Value_co:
        """Return the value of a setting."""
        value: Value_co = dict(self.values).get(setting, setting.default)
        return value

    def has(self, setting: OwnedSetting[Any]) -> bool:
        """Return whether a setting was ever set."""
        return setting in dict(self.values)

    def with_value(self, setting: OwnedSetting[Any], value: object) -> Self:
        """Return these with another value for one of them."""
        values = dict(self.values) | {setting: value}
        return msgspec.structs.replace(self, values=frozenset(values.items()))
