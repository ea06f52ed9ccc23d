"""What is shown over the curve, and how: neither saved with the document nor undone."""

from __future__ import annotations

import enum

import msgspec

from app.document.model import ParametrizationKind
from app.families import FAMILIES, Family
from app.view_model.analysis.laboratory_settings import LaboratorySettings


class Overlay(enum.StrEnum):
    """Something that can be drawn over the curve."""

    COMB = "comb"
    VELOCITIES = "velocities"
    ACCELERATIONS = "accelerations"
    CIRCLE = "circle"
    BEZIER = "bezier"
    POLYGON = "polygon"
    TICKS = "ticks"
    MARKS = "marks"
    BAND = "band"
    ENSEMBLE = "ensemble"


class Ghost(msgspec.Struct, frozen=True):
    """The same points under another family or another rule for the parameters: one of the two."""

    family: Family | None = None
    kind: ParametrizationKind | None = None

    @property
    def name(self) -> str:
        """The name of the family or the rule."""
        return self.family.name if self.family is not None else str(self.kind)

    @property
    def title(self) -> str:
        """What people read: Chord length."""
        return self.family.label if self.family is not None else str(self.kind).replace("_", " ").capitalize()

    @property
    def action_name(self) -> str:
        """The object name of its action: ghostChordLength."""
        return "ghost" + "".join(word.capitalize() for word in self.name.split("_"))

    @property
    def tip(self) -> str:
        """What its action does."""
        if self.family is not None:
            return f"Draw the same points as a {self.family.full_title} curve, too"
        rule = "Chebyshev" if self.kind is ParametrizationKind.CHEBYSHEV else str(self.kind).replace("_", "-")
        return f"Draw the curve with {rule} parameters, too"


GHOST_KINDS = tuple(
    kind
    for kind in ParametrizationKind
    if kind not in (ParametrizationKind.POWER, ParametrizationKind.MANUAL)
)
"""The rules that need nothing but the points."""


def all_ghosts() -> tuple[Ghost, ...]:
    """Return a ghost for every family and for every rule that needs nothing but the points, in order."""
    families = (Ghost(family=family) for family in FAMILIES)
    return (*families, *(Ghost(kind=kind) for kind in GHOST_KINDS))


class Plot(enum.StrEnum):
    """Something that can be plotted over t, in the order in which plots stand below each other."""

    SPEED = "speed"
    ACCELERATION = "acceleration"
    JERK = "jerk"
    CURVATURE = "curvature"
    LEBESGUE = "lebesgue"


class AnalysisSettings(msgspec.Struct, frozen=True):
    """Everything that can be chosen about overlays.

    Attributes
    ----------
    overlays
        What is switched on.
    comb_scale
        Length of the comb's teeth; 1 makes the longest a fifth of the curve's size.
    plots
        What is plotted over t.
    velocity_scale, acceleration_scale
        Length of the arrows; 1 makes the longest a quarter of the curve's size.
    tick_count
        Equal steps of t that the ticks show.
    point_error
        Largest error of every point, in the plane's unit; None until it is first needed.
    parameter_error
        Largest error of every parameter.
    ensemble_count, ensemble_seed
        How many disturbed curves, and which ones.
    ghosts
        The variants that are shown.
    laboratory
        The experiment with rounded arithmetic.
    """

    overlays: frozenset[Overlay] = frozenset()
    comb_scale: float = 1.0
    plots: frozenset[Plot] = frozenset()
    velocity_scale: float = 1.0
    acceleration_scale: float = 1.0
    tick_count: int = 20
    point_error: float | None = None
    parameter_error: float = 0.0
    ensemble_count: int = 30
    ensemble_seed: int = 0
    ghosts: frozenset[Ghost] = frozenset()
    laboratory: LaboratorySettings = LaboratorySettings()

    @property
    def is_empty(self) -> bool:
        """Whether nothing is switched on."""
        return not self.overlays and not self.ghosts
