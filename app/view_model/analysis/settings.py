"""The settings of all that is shown over the curve: neither saved with the document nor undone."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .laboratory_settings import LaboratorySettings
from .overlay_settings import SettingValues

if TYPE_CHECKING:
    from .ghost import Ghost
    from .overlay import Overlay
    from .plot import Plot


class AnalysisSettings(SettingValues, frozen=True):
    """Everything that can be chosen about overlays.

    Attributes
    ----------
    overlays
        The overlays that are switched on.
    plots
        The plots over t.
    ghosts
        The variants that are shown.
    laboratory
        The experiment with rounded arithmetic.
    """

    overlays: frozenset[Overlay] = frozenset()
    plots: frozenset[Plot] = frozenset()
    ghosts: frozenset[Ghost] = frozenset()
    laboratory: LaboratorySettings = LaboratorySettings()

    @property
    def is_empty(self) -> bool:
        """Whether nothing is switched on."""
        return not self.overlays and not self.ghosts
