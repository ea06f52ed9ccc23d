"""What is shown over the curve, and how: neither saved with the document nor undone."""

from __future__ import annotations

import enum

import msgspec

from app.view_model.analysis.laboratory_settings import LaboratorySettings


class Overlay(enum.StrEnum):
    """Something that can be drawn over the curve."""

    COMB = "comb"


class AnalysisSettings(msgspec.Struct, frozen=True):
    """Everything that can be chosen about overlays.

    Attributes
    ----------
    overlays
        What is switched on.
    comb_scale
        Length of the comb's teeth; 1 makes the longest a fifth of the curve's size.
    laboratory
        The experiment with rounded arithmetic.
    """

    overlays: frozenset[Overlay] = frozenset()
    comb_scale: float = 1.0
    laboratory: LaboratorySettings = LaboratorySettings()
