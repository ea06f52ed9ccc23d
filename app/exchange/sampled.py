"""Curves as tables of samples: t, x, y, derivatives, curvature and arc length."""

from __future__ import annotations

from collections.abc import Iterator
from math import isnan

import numpy as np

from app.document.model import Document
from app.exchange.drawing import ExchangeError, Floats
from app.exchange.facts import lengths_between
from app.exchange.formats import SAMPLES, Spacing
from app.exchange.parts import Written, cell_of_name, checked_tolerance, distinct_names, sources_of
from app.exchange.progress import Report, part, silent
from app.view_model.curve_view import CoreCurve
from curvecore import flatten_parameters

MOST_SAMPLES = 1_000_000

TITLES = ("t", "x", "y", "vx", "vy", "ax", "ay", "curvature", "length")

_ROWS_AT_ONCE = 2_000
_TABLE_STEPS = 16
_NEWTON_STEPS = 8


def sampled_table(
    document: Document,
    *,
    separator: str = ",",
    samples: int = SAMPLES,
    spacing: Spacing = Spacing.T,
    tolerance: float | None = None,
    columns: tuple[str, ...] | None = None,
    report: Report = silent,
) -> Written:
    """Return the curves as a table; with several, the first column is the curve's name.

    Parameters
    ----------
    document
        A document with at least one curve.
    separator
        Between the cells; numbers have a decimal point whatever the locale.
    samples
        How many for each curve, 2 to `MOST_SAMPLES`, by `Spacing.T` and `Spacing.LENGTH`.
    spacing
        Equal steps of t, of the arc length, or as many samples as a polyline within the tolerance needs.
    tolerance
        Largest deviation of that polyline, in the document's unit.
    columns
        Those of `TITLES` that are wanted; by default all.
    report
        Hears how far it has come.

    Returns
    -------
    Written
        Its deviation is that of the polyline through the samples.

    Raises
    ------
    ExchangeError
        If there is no curve, or the number of samples is out of range.
    """
    if not 2 <= samples <= MOST_SAMPLES:
        raise ExchangeError(f"A table can have 2 to {MOST_SAMPLES} samples.")
    sources, remarks = sources_of(document)
    allowed = checked_tolerance(sources, tolerance)
    chosen = _columns(columns)
    named = len(sources) > 1
    titles = [TITLES[column] for column in chosen]
    lines, deviation = [separator.join(["curve", *titles] if named else titles)], 0.0
    for place, (source, name) in enumerate(zip(sources, distinct_names(sources), strict=True)):
        away = part(report, place / len(sources), (place + 1) / len(sources))
        away(0.0, "Computing samples")
        t = parameters_of(source.core, samples, spacing, allowed)
        lead = cell_of_name(name, separator) + separator if named else ""
        for rows, missed in _in_parts(source.core, t, away):
            deviation = max(deviation, missed)
            lines += [lead + separator.join(map(_cell, row)) for row in rows[:, chosen].tolist()]
    return Written("\n".join(lines) + "\n", deviation, remarks)


def _in_parts(core: CoreCurve, t: Floats, report: Report) -> Iterator[tuple[Floats, float]]:
    """Yield the rows of a curve, some at a time, with the deviation of the polyline through them."""
    length = 0.0
    for first in range(0, len(t) - 1, _ROWS_AT_ONCE):
        report(first / len(t), "Computing samples")
        # The last sample of a part is the first of the next.
        some = t[first : first + _ROWS_AT_ONCE + 1]
        rows = rows_of(core, some)
        rows[:, -1] += length
        length = float(rows[-1, -1])
        yield rows[1 if first else 0 :], polyline_deviation(core, some)


def _columns(titles: tuple[str, ...] | None) -> list[int]:
    """Return the places of the columns wanted, in their usual order."""
    unknown = [title for title in titles or () if title not in TITLES]
    if unknown or titles == ():
        raise ExchangeError(f"A table can have the columns {', '.join(TITLES)}; at least one is needed.")
    return [place for place, title in enumerate(TITLES) if titles is None or title in titles]


def parameters_of(core: CoreCurve, samples: int, spacing: Spacing, tolerance: float) -> Floats:
    """Return the parameters to sample a curve at, both ends of its domain among them."""
    if spacing is Spacing.TOLERANCE:
        return flatten_parameters(core, tolerance)
    if spacing is Spacing.T:
        start, end = core.domain
        return np.append(start + (end - start) * (np.arange(samples - 1) / (samples - 1)), end)
    return _by_length(core, samples)


def rows_of(core: CoreCurve, t: Floats) -> Floats:
    """Return the columns of `TITLES` at parameters t (m,) as (m, 9); the curvature of a point at rest is NaN.

    Curvature is positive where the curve turns to the left; the length counts from the first sample. At a
    corner the values are those after it.
    """
    point, velocity, acceleration = (core.evaluate(t, order) for order in range(3))
    with np.errstate(all="ignore"):
        cross = velocity[:, 0] * acceleration[:, 1] - velocity[:, 1] * acceleration[:, 0]
        curvature = cross / np.hypot(*velocity.T) ** 3
    length = np.append(0.0, np.cumsum(lengths_between(core, t)))
    return np.column_stack([t, point, velocity, acceleration, curvature, length])


def polyline_deviation(core: CoreCurve, t: Floats) -> float:
    """Return the largest distance of a curve from its chords between the parameters t (m,).

    Measured at seven parameters a chord and the joints between.
    """
    between = t[:-1, None] + np.diff(t)[:, None] * (np.arange(1, 8) / 8)
    inner = core.parameters[(core.parameters > t[0]) & (core.parameters < t[-1])]
    at = np.concatenate([between.ravel(), inner])
    chord = np.clip(np.searchsorted(t, at, side="right") - 1, 0, len(t) - 2)
    ends = core.evaluate(t)
    start, along = ends[chord], ends[chord + 1] - ends[chord]
    offset = core.evaluate(at) - start
    square = np.einsum("md,md->m", along, along)
    with np.errstate(all="ignore"):
        share = np.clip(np.nan_to_num(np.einsum("md,md->m", offset, along) / square), 0, 1)
    return float(np.hypot(*(offset - share[:, None] * along).T).max())


def _by_length(core: CoreCurve, samples: int) -> Floats:
    """Return parameters at equal arc lengths: from a table, then refined by Newton's method."""
    joints = core.parameters
    steps = max(_TABLE_STEPS, -(-2 * samples // len(joints)))
    fine = joints[:-1, None] + np.diff(joints)[:, None] * (np.arange(steps) / steps)
    fine = np.unique(np.append(fine.ravel(), joints[-1]))
    reached = np.append(0.0, np.cumsum(lengths_between(core, fine)))
    wanted = reached[-1] * (np.arange(1, samples - 1) / (samples - 1))
    if not 0 < reached[-1] < np.inf:
        raise ExchangeError("The curve has no length to divide.")
    before = np.clip(np.searchsorted(reached, wanted, side="right") - 1, 0, len(fine) - 2)
    low, high = fine[before], fine[before + 1]
    share = (wanted - reached[before]) / np.maximum(reached[before + 1] - reached[before], 1e-300)
    t = low + (high - low) * np.clip(share, 0, 1)
    for _ in range(_NEWTON_STEPS):
        error = reached[before] + lengths_between(core, low, t) - wanted
        with np.errstate(all="ignore"):
            step = np.nan_to_num(error / np.hypot(*core.evaluate(t, 1).T), posinf=0.0, neginf=0.0)
        t = np.clip(t - step, low, high)
    start, end = core.domain
    return np.unique(np.concatenate([[start], t, [end]]))


def _cell(value: float) -> str:
    return "" if isnan(value) else repr(value + 0.0)
