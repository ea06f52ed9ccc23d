"""Ticks of an axis: their values, and numbers that differ at every zoom."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from typing import TypeVar

import msgspec

from ..document.words import number

LEAST_LABELS = 2
"""Smallest number of labels of an axis: one alone gives no scale."""

_MOST_DIGITS = 15
_USUAL_DIGITS = 7

_LEAST_MARK_GAP = 5.0
"""Smallest distance in pixels of two ticks without numbers."""

_MOST_TICKS = 2000

_FACTORS = tuple(factor * 10.0**power for power in range(-4, 13) for factor in (1, 2, 5))
"""Distances of numbers in units of the distance of ticks."""

_SQUEEZE = 0.8
"""Share of its width to which a number may be squeezed before an offset is split off."""


T = TypeVar("T", str, float)


class Ticks(msgspec.Struct, frozen=True):
    """Ticks of one axis.

    Attributes
    ----------
    labels
        Values with their numbers, ascending.
    marks
        Values of further ticks, each with its size relative to the usual one.
    offset
        Offset of all numbers, such as "1700000000 +"; empty for none.
    step
        The distance of the numbers, 0 where they were given.
    """

    labels: tuple[tuple[float, str], ...]
    marks: tuple[tuple[float, float], ...] = ()
    offset: str = ""
    step: float = 0.0


class LabelRoom(msgspec.Struct, frozen=True):
    """Room for the numbers beside an axis, in pixels.

    Attributes
    ----------
    along, across
        Return the size of a number along the axis, and across it.
    gap
        Free pixels between two numbers.
    strip
        Available pixels across the axis.
    before, after
        Pixels by which a number may extend beyond the beginning and the end of the axis.
    """

    along: Callable[[str], float]
    across: Callable[[str], float]
    gap: float
    strip: float
    before: float
    after: float


class Stretch(msgspec.Struct, frozen=True):
    """Visible part of an axis: from `low` to `high`, on `size` pixels; numbers are values times `factor`."""

    low: float
    high: float
    size: float
    factor: float = 1.0

    @property
    def scale(self) -> float:
        """Pixels per unit."""
        return self.size / (self.high - self.low)

    def multiples(self, step: float) -> list[float]:
        """Return the visible multiples of `step`; none where they are far too many."""
        first, last = self.low / step, self.high / step
        if not last - first < _MOST_TICKS:
            return []
        # Rounding may move a multiple at the very edge outside.
        slack = 1e-9 * max(last - first, 1.0)
        multiples = (count * step for count in range(math.ceil(first - slack), math.floor(last + slack) + 1))
        return sorted(set(multiples))


def nice_step(needed: float) -> float:
    """Return the least of 1, 2, 5, 10, … times a power of ten that is at least `needed`."""
    power = math.floor(math.log10(needed))
    digit = next(digit for digit in (1, 2, 5, 10) if digit * 10.0**power >= needed * (1 - 1e-12))
    # As the decimal number: 0.2, not 2 · 0.1 in binary.
    return float(f"{digit}e{power}")


def tick_labels(values: Sequence[float], scale: float, spacing: float) -> list[str]:
    """Return the numbers at ticks `spacing` apart, times `scale`, with enough digits to differ."""
    # Rounding may turn a multiple that should be zero into a tiny number.
    exact = [round(value / spacing) * spacing * scale for value in values]
    largest = max((abs(value / spacing) for value in values), default=1.0)
    digits = min(max(_USUAL_DIGITS, math.ceil(math.log10(max(largest, 1.0))) + 1), _MOST_DIGITS)
    if digits > _USUAL_DIGITS:
        # All as plain decimals: 1e9 between 999999950 and 1000000050 would be read as another scale.
        most = max(map(abs, exact))
        digits = min(max(digits, math.floor(math.log10(most)) + 1), _MOST_DIGITS)
    return [number(value, digits) for value in exact]


def choose_ticks(visible: Stretch, tick: float, number_distance: float, room: LabelRoom) -> Ticks:
    """Return the ticks of an axis, with at least two numbers that do not overlap.

    Parameters
    ----------
    tick
        The distance of the ticks.
    number_distance
        The distance of the numbers, where there is room: `tick` times 1, 2, 5, 10, ….
    """
    best: Ticks | None = None
    # The same steps are tried again with squeezed numbers.
    cache: dict[tuple[float, float], Ticks] = {}
    minimum = (room.gap + min(map(room.along, "0123456789"))) / visible.scale
    for offset, squeezed in ((0.0, 1.0), (0.0, _SQUEEZE), (_offset(visible), 1.0), (0.0, 0.0)):
        for step in _steps(tick, number_distance):
            if best is not None and step < min(number_distance, minimum):
                # Further steps are denser still.
                break
            ticks = cache.get((offset, step)) or _labels_at(visible, step, offset, room)
            cache[offset, step] = ticks
            if len(ticks.labels) < LEAST_LABELS:
                if step >= number_distance:
                    continue
                if step * visible.scale < room.gap:
                    break
                continue
            if _fits(ticks, visible, room, squeezed):
                return ticks
            best = best or ticks
    return best or _labels_at(visible, tick, 0.0, room)


def with_marks(ticks: Ticks, visible: Stretch, tick: float, *, finer: bool) -> Ticks:
    """Return the ticks with marks between the numbers, with `finer` ones on a ruler where there is room."""
    sizes = dict.fromkeys(visible.multiples(tick), 1.0) if _has_room(visible, tick) else {}
    if finer:
        share = next((share for share in (0.1, 0.2, 0.5) if _has_room(visible, share * tick)), None)
        for value in visible.multiples(share * tick) if share else ():
            sizes.setdefault(value, 0.5)
    return msgspec.structs.replace(ticks, marks=tuple(sorted(sizes.items())))


def _has_room(visible: Stretch, step: float) -> bool:
    return step * visible.scale >= _LEAST_MARK_GAP


def _steps(tick: float, number_distance: float) -> Iterator[float]:
    """Yield distances of numbers: the preferred one, then larger ones, then smaller ones."""
    steps = [factor * tick for factor in _FACTORS]
    start = min(range(len(steps)), key=lambda index: abs(math.log(steps[index] / number_distance)))
    yield from steps[start:]
    yield from reversed(steps[:start])


def _labels_at(visible: Stretch, step: float, offset: float, room: LabelRoom) -> Ticks:
    """Return numbers `step` apart, without those that would be cut off at the ends."""
    values = visible.multiples(step)
    texts = tick_labels([value - offset for value in values], visible.factor, step)
    labels = []
    for value, text in zip(values, texts, strict=True):
        half, pixel = room.along(text) / 2, (value - visible.low) * visible.scale
        if -room.before <= pixel - half and pixel + half <= visible.size + room.after:
            labels.append((value, text))
    offset_text = f"{number(offset * visible.factor, _MOST_DIGITS)} +" if offset else ""
    return Ticks(tuple(labels), offset=offset_text, step=step)


def _fits(ticks: Ticks, visible: Stretch, room: LabelRoom, squeezed: float) -> bool:
    texts = [text for _, text in ticks.labels]
    if len(set(texts)) < len(texts):
        return False
    return (
        max(map(room.along, texts)) + room.gap <= ticks.step * visible.scale
        and max(map(room.across, texts)) * squeezed <= room.strip
    )


def _offset(visible: Stretch) -> float:
    """Return the offset that the visible numbers share, a multiple of a power of ten; 0 for none."""
    power = 10.0 ** math.ceil(math.log10(visible.high - visible.low))
    common = math.floor(visible.low / power) * power
    return common if common > 0 else math.ceil(visible.high / power) * power if visible.high < 0 else 0.0
