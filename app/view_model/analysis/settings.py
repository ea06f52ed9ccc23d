"""What is shown over the curve, and how: neither saved with the document nor undone."""

from __future__ import annotations

import enum

import msgspec


class Overlay(enum.StrEnum):
    """Something that can be drawn over the curve."""

    COMB = "comb"


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
    """

    overlays: frozenset[Overlay] = frozenset()
    comb_scale: float = 1.0
    plots: frozenset[Plot] = frozenset()
