"""The settings of all that is shown over the curve: neither saved with the document nor undone."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import msgspec

from .laboratory_settings import LaboratorySettings

if TYPE_CHECKING:
    from ..curve.curve_view import CurveView
    from .ghost import Ghost
    from .overlay import Overlay
    from .plot import Plot


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


class AnalysisSettings(msgspec.Struct, frozen=True):
    """Everything that can be chosen about overlays.

    Attributes
    ----------
    overlays
        The overlays that are switched on.
    values
        The settings of overlays that are not at their defaults.
    plots
        The plots over t.
    ghosts
        The variants that are shown.
    laboratory
        The experiment with rounded arithmetic.
    """

    overlays: frozenset[Overlay] = frozenset()
    values: frozenset[tuple[OverlaySetting, float]] = frozenset()
    plots: frozenset[Plot] = frozenset()
    ghosts: frozenset[Ghost] = frozenset()
    laboratory: LaboratorySettings = LaboratorySettings()

    @property
    def is_empty(self) -> bool:
        """Whether nothing is switched on."""
        return not self.overlays and not self.ghosts

    def value(self, setting: OverlaySetting) -> float:
        """Return what a setting is."""
        return dict(self.values).get(setting, setting.default)

    def has(self, setting: OverlaySetting) -> bool:
        """Whether a setting was ever set."""
        return setting in dict(self.values)

    def with_value(self, setting: OverlaySetting, value: float) -> AnalysisSettings:
        """Return these settings with another value for one of them."""
        values = dict(self.values) | {setting: value}
        return msgspec.structs.replace(self, values=frozenset(values.items()))
