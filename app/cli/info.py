"""Facts about curves, as ``info`` prints them: as text, and as plain values for JSON."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

from msgspec.structs import asdict

from curvecore.arithmetic import LARGEST

from ..document.style import NO_PAINT, Style
from ..document.words import digits_of_range, rounded_up
from ..view_model.basis_findings import digits_in_words
from .output import one_line

if TYPE_CHECKING:
    from ..exchange.facts import CurveFacts, LebesgueConstants

_EDGES = ("left", "bottom", "right", "top")
"""Edges of the box of a curve."""

_BEYOND = "too large to represent"


def facts_as_json(facts: CurveFacts) -> dict[str, Any]:
    """Return the facts as plain values, with null for unknown ones."""
    rule = facts.parametrization
    box = dict(zip(_EDGES, facts.box, strict=True)) if facts.box else None
    length = {"about": facts.length.value, "error": facts.length.error} if facts.length else None
    return {
        "name": facts.name,
        "family": facts.family.name,
        "settings": {setting.name: value for setting, value in facts.settings.items()},
        "degree": facts.degree,
        "kind": facts.kind or None,
        "difference_digits": facts.difference_digits or None,
        "points": facts.points,
        "closed": facts.closed,
        "corners": facts.corners,
        "smooth": facts.smooth,
        "visible": facts.visible,
        "shape": facts.shape or None,
        "groups": facts.groups,
        "style": asdict(facts.style),
        "parametrization": {"kind": rule.kind, "alpha": rule.alpha, "start": rule.start, "end": rule.end},
        "domain": facts.domain,
        "missing": _missing(facts),
        "lebesgue_constant": _finite_only(facts.lebesgue_constant),
        "lebesgue_constant_holds": (facts.lebesgue_constant and facts.lebesgue_constant.holds) or None,
        "length": length,
        "box": box,
        "warnings": facts.warnings,
    }


def facts_as_text(facts: CurveFacts, unit: str) -> str:
    """Return the facts as lines: the name, and one for each; the document may have a unit."""
    rows = [("shape", one_line(facts.shape))] if facts.shape else []
    rows += [("group", " > ".join(map(one_line, facts.groups)))] if facts.groups else []
    rows.append(("family", facts.family.full_title))
    rows += [(setting.title, setting.text_of(value)) for setting, value in facts.settings.items()]
    if facts.degree is not None:
        where = "" if facts.pieces == 1 else " on every segment"
        rows.append(("degree", f"{facts.degree}{where}"))
    if facts.kind:
        rows.append(("kind", facts.kind))
    if facts.difference_digits:
        rows.append(("derivatives", f"differences, {digits_in_words(facts.difference_digits)}"))
    rows += [("points", _points_text(facts)), ("parametrization", _rule_text(facts))]
    if facts.domain is not None:
        rows.append(("domain", _range_text(*facts.domain)))
        rows.append(("length", _length_text(*facts.length) if facts.length else _BEYOND))
    if facts.lebesgue_constant is not None:
        rows.append(("Λ (Lebesgue)", _lebesgue_text(facts.lebesgue_constant)))
    if facts.box is not None:
        left, bottom, right, top = facts.box
        rows.append(("box", f"about x {_edges_text(left, right)}, y {_edges_text(bottom, top)}"))
    rows.append(("style", _style_text(facts.style, unit)))
    if unit:
        rows.append(("unit", one_line(unit)))
    if not facts.visible:
        rows.append(("hidden", "not drawn in pictures"))
    rows += [("warning", warning) for warning in facts.warnings]
    return "\n".join([one_line(facts.name), *(f"  {key:<16} {value}" for key, value in rows)])


def _edges_text(low: float, high: float) -> str:
    """Return two edges of a box; one that is a rounding error of the larger one is 0."""
    noise = sys.float_info.epsilon * max(abs(low), abs(high))
    low, high = (0.0 if abs(edge) <= noise else edge for edge in (low, high))
    return _range_text(low, high) if high - low > 4.0 * noise else f"{low:.6g} to {high:.6g}"


def _range_text(low: float, high: float) -> str:
    """Return two numbers with enough digits to distinguish them."""
    digits = digits_of_range(low, high)
    return f"{low:.{digits}g} to {high:.{digits}g}"


def _missing(facts: CurveFacts) -> dict[str, str]:
    """Return the reasons why length or constant are unknown, by their names."""
    if facts.domain is None:
        return dict.fromkeys(("length", "lebesgue_constant"), facts.warnings[0])
    growth = facts.lebesgue_constant
    is_missing = {"length": not facts.length, "lebesgue_constant": growth and max(growth[:2]) >= LARGEST}
    return {name: _BEYOND for name, missing in is_missing.items() if missing}


def _finite_only(growth: LebesgueConstants | None) -> dict[str, float | None] | None:
    """Return the constants by name; null stands for one beyond all floats."""
    if growth is None:
        return None
    constants = {"data": growth.data, "points": growth.points}
    return {name: value if value < LARGEST else None for name, value in constants.items()}


def _lebesgue_text(growth: LebesgueConstants) -> str:
    points = f"{growth.points:.3g}" if growth.points < LARGEST else _BEYOND
    points = f"{points} {growth.holds}".rstrip()
    if growth.points >= LARGEST:
        return points
    if growth.data == growth.points:
        return points
    return f"{points} (with fixed estimated derivatives: {growth.data:.3g})"


def _length_text(value: float, bound: float) -> str:
    """Return a length with as many digits as its bound is worth, and a bound that covers their rounding."""
    texts = (f"{value:.{digits}g}" for digits in range(1, 18))
    text = next((text for text in texts if abs(float(text) - value) <= bound), repr(value))
    error = bound + abs(float(text) - value)
    return f"about {text} (error at most {rounded_up(error, 1):g})"


def _points_text(facts: CurveFacts) -> str:
    corners = f"{facts.corners} of them " + ("a corner" if facts.corners == 1 else "corners")
    parts = [str(facts.points), "closed" * facts.closed, corners * bool(facts.corners)]
    parts.append(f"{facts.smooth} of them smooth, with two speeds" * bool(facts.smooth))
    return ", ".join(filter(None, parts))


def _rule_text(facts: CurveFacts) -> str:
    kind = facts.parametrization.kind.replace("_", " ")
    return f"{kind}, α = {facts.parametrization.alpha:g}" if kind == "power" else kind


def _style_text(style: Style, unit: str) -> str:
    """Return stroke and fill in a line."""
    parts = []
    if style.has_fill:
        paint = style.fill or "in ink"
        parts.append(f"fill {paint}{_opacity_text(style.fill_opacity)}")
    if style.has_stroke:
        width = "the default width" if style.width is None else f"{style.width:.6g} {one_line(unit)}".rstrip()
        dashes = f", dashes {' '.join(f'{length:g}' for length in style.dash)}" if style.dash else ""
        paint = style.stroke or "in ink"
        parts.insert(0, f"stroke {paint}{_opacity_text(style.stroke_opacity)}, {width}{dashes}")
    return "; ".join(parts) or NO_PAINT


def _opacity_text(opacity: float) -> str:
    return f", {opacity:.0%} opaque" if opacity < 1 else ""
