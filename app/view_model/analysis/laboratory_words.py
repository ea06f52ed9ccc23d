"""The findings of the laboratory, in a sentence or two."""

from __future__ import annotations

from math import log10

from .laboratory import Outcome, Trial
from .laboratory_settings import Calculation, RoundedPart
from .wording import short

_HOPELESS = 0.7
"""With fewer right digits than this nothing is right."""

_NEARLY_ALL = 0.5
"""Within so many digits of the worst case nothing needs to be explained."""


def trial_words(trial: Trial) -> str:
    """Say what is to be seen, and how what was lost goes with what may be lost."""
    if not trial.outcomes:
        return "Choose a method to compute the curve with."
    monomial = trial.outcome(Calculation.MONOMIAL)
    match trial.settings.rounding:
        case RoundedPart.DATA:
            return (
                "Only the data are rounded: every method gives the same curve. An error of the points grows "
                "Λ times at the most, one of tᵢ moves the curve by Lᵢ(t) c′(tᵢ) times as much."
            )
        case RoundedPart.COEFFICIENTS if monomial is not None:
            return (
                f"Only the coefficients are rounded, to {trial.settings.digits} digits. An error in the "
                "coefficient of tᵏ moves the curve by tᵏ times as much, so that the error grows with |t|."
            )
        case RoundedPart.EVERY_STEP if monomial is not None and trial.condition is not None:
            return _on_solving(trial, monomial, trial.condition)
    best = min(trial.outcomes, key=lambda each: each.lost)
    return f"{best.calculation.label} loses {best.lost:.1f} of {trial.settings.digits} digits."


def growth_words(trial: Trial) -> str:
    """Say which Λ the table has, where the one in the status line is another; else nothing."""
    is_of_data = trial.settings.rounding is RoundedPart.DATA
    shown = [each for each in trial.outcomes if is_of_data or each.calculation is not Calculation.MONOMIAL]
    if not (trial.view.source.family.derivatives and shown):
        return ""
    return (
        "Λ here is of the data, estimates held fixed; in the status line, of the points, which they follow."
    )


def _on_solving(trial: Trial, monomial: Outcome, condition: float) -> str:
    """Say what the condition number bounds, and why less was lost where it was."""
    digits, may_go = trial.settings.digits, log10(max(condition, 1.0))
    most = f"all {digits} digits" if may_go >= digits else f"{may_go:.1f} of {digits} digits"
    bound = f"κ = {short(condition)} bounds what rounding can do to the monomials' coefficients"
    if monomial.lost > digits - _HOPELESS:
        return f"{digits} digits are not enough for the monomials. {bound}: {most} may go."
    if monomial.lost > min(may_go, digits) - _NEARLY_ALL:
        return f"{bound}: {most} may go."
    return (
        f"{bound}: at worst {most} go. The curve lost {monomial.lost:.1f}: these points and roundings are "
        "not the worst, and elimination finds coefficients that nearly fit the points even where it errs."
    )
