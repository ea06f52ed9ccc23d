"""Settings that belong to a record: an overlay or a tool. Qt-free; the widgets and the stored keys follow.

An overlay can have `SwitchSetting`, `Count`, `Factor` and its own `ErrorSize`; a tool `SwitchSetting`,
`Count` and `ChoiceSetting`.
"""

from __future__ import annotations

from typing import Any, Generic, Self, TypeVar

import msgspec

Value_co = TypeVar("Value_co", covariant=True)


class OwnedSetting(msgspec.Struct, Generic[Value_co], frozen=True):
    """A value that an overlay or a tool works with; the record that has it in its `settings` owns it.

    Attributes
    ----------
    name
        Object name of the widget that sets it.
    label
        The words beside that widget: what is set.
    default
        Its value until it is set.
    tip
        Tooltip of the widget; by default the label.
    stored_as
        Key in the file of settings, for a setting of a tool that has another one than the usual
        ``tools/<name of the tool>/<name of the setting>``. What is set of an overlay is not stored.
    """

    name: str
    label: str
    default: Value_co
    tip: str = ""
    stored_as: str = ""


class SwitchSetting(OwnedSetting[bool], frozen=True):
    """On or off, set by a check box."""


class Count(OwnedSetting[int], frozen=True, kw_only=True):
    """A whole number within limits, both included: a slider for an overlay, a spin box for a tool."""

    limits: tuple[int, int]


class Factor(OwnedSetting[float], frozen=True):
    """A factor from a tenth to ten, set by a slider; for overlays."""

    default: float = 1.0


class ChoiceSetting(OwnedSetting[Value_co], frozen=True):
    """One member of a `NamedEnum`, set in a box and by an action for each of few members; for tools."""

    @property
    def members(self) -> list[Any]:
        """All members of the enumeration."""
        return [*type(self.default)]  # type: ignore[misc]  # its metaclass is that of an enumeration


ToolSetting = ChoiceSetting[Any] | SwitchSetting | Count
"""The kinds of settings that a tool can have."""


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
