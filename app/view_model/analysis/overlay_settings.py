"""The numbers that overlays are drawn with, and what each of them is."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Self

import msgspec

if TYPE_CHECKING:
    from ..curve.curve_view import CurveView


class OverlaySetting(msgspec.Struct, frozen=True):
    """A number that an overlay is drawn with; this kind is set by an action.

    Attributes
    ----------
    name
        Object name of what sets it.
    label
        Its name, for people.
    default
        Its value until it is set.
    """

    name: str
    label: str
    default: float = 0.0


class Factor(OverlaySetting, frozen=True):
    """A factor from a tenth to ten, set by a slider."""

    default: float = 1.0


class Count(OverlaySetting, frozen=True, kw_only=True):
    """A whole number from `least` to `most`, set by a slider."""

    least: int
    most: int


class ErrorSize(OverlaySetting, frozen=True, kw_only=True):
    """The largest error of something, typed.

    Attributes
    ----------
    short
        The words before the field.
    tip
        More about it.
    usual
        Its value when it is first needed, from the curve that is then shown; None for the default.
    """

    short: str
    tip: str
    usual: Callable[[CurveView], float] | None = None


class SettingValues(msgspec.Struct, frozen=True):
    """What the settings of overlays are.

    Attributes
    ----------
    values
        Those that are not at their defaults.
    """

    values: frozenset[tuple[OverlaySetting, float]] = frozenset()

    def value(self, setting: OverlaySetting) -> float:
        """Return what a setting is."""
        return dict(self.values).get(setting, setting.default)

    def has(self, setting: OverlaySetting) -> bool:
        """Whether a setting was ever set."""
        return setting in dict(self.values)

    def with_value(self, setting: OverlaySetting, value: float) -> Self:
        """Return these with another value for one of them."""
        values = dict(self.values) | {setting: value}
        return msgspec.structs.replace(self, values=frozenset(values.items()))
