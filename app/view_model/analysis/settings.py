"""What is shown over the curve, and how: neither saved with the document nor undone."""

from __future__ import annotations

import enum

import msgspec

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


class Ghost(enum.StrEnum):
    """The same points under another family or another rule for the parameters."""

    LAGRANGE = "lagrange"
    HERMITE = "hermite"
    QUINTIC_HERMITE = "quintic_hermite"
    UNIFORM = "uniform"
    CHORD_LENGTH = "chord_length"
    CENTRIPETAL = "centripetal"
    CHEBYSHEV = "chebyshev"


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
