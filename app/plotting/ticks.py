"""Ticks of an axis: where they stand, and their numbers, which are told apart at every zoom."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from typing import TypeVar

import msgspec

from ..document.words import number

LEAST_LABELS = 2
"""Numbers that an axis has at least: one alone tells no scale."""

_MOST_DIGITS = 15
_USUAL_DIGITS = 7

_LEAST_MARK_GAP = 5.0
"""Pixels between two ticks without a number, at least."""

_MOST_TICKS = 2000

_FACTORS = tuple(factor * 10.0**power for power in range(-4, 13) for factor in (1, 2, 5))
"""Distances of numbers in terms of that of the ticks: with these, each number stands at a tick or between."""

_SQUEEZED = 0.8
"""Share of its width to which a number may be pressed together before a part of it stands elsewhere."""


T = TypeVar("T", str, float)


class Ticks(msgspec.Struct, frozen=True):
    """Ticks of one axis.

    Attributes
    ----------
    labels
        Places with their numbers, ascending.
    marks
        Places of further ticks, each with its size as a share of the usual.
    offset
        What has to be added to all numbers, such as "1700000000 +"; empty for nothing.
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
        How much a number takes along the axis, and across it.
    gap
        Between two of them.
    strip
        How much there is across.
    before, after
        How far a number may reach beyond the beginning and the end of the axis.
    """

    along: Callable[[str], float]
    across: Callable[[str], float]
    gap: float
    strip: float
    before: float
    after: float


class Stretch(msgspec.Struct, frozen=True):
    """Part of an axis that is seen: from `low` to `high`, on `size` pixels; numbers are times `factor`."""

    low: float
    high: float
    size: float
    factor: float = 1.0

    @property
    def scale(self) -> float:
        """Pixels per unit."""
        return self.size / (self.high - self.low)

    def multiples(self, step: float) -> list[float]:
        """Return the multiples of `step` in sight; none where there are more than anybody could see."""
        first, last = self.low / step, self.high / step
        if not last - first < _MOST_TICKS:
            return []
        # A multiple at the very edge may be off by a rounding.
        slack = 1e-9 * max(last - first, 1.0)
        places = (count * step for count in range(math.ceil(first - slack), math.floor(last + slack) + 1))
        return sorted(set(places))


def nice_step(needed: float) -> float:
    """Return the least of 1, 2, 5, 10, … times a power of ten that is at least `needed`."""
    power = math.floor(math.log10(needed))
    digit = next(digit for digit in (1, 2, 5, 10) if digit * 10.0**power >= needed * (1 - 1e-12))
    # As the decimal number that is meant: 0.2, not 2 · 0.1 in binary.
    return float(f"{digit}e{power}")


def tick_labels(values: Sequence[float], scale: float, spacing: float) -> list[str]:
    """Return the numbers at ticks `spacing` apart, times `scale`: as many digits as tell them apart."""
    # A multiple of the spacing that should be zero may be off by a rounding.
    exact = [round(value / spacing) * spacing * scale for value in values]
    largest = max((abs(value / spacing) for value in values), default=1.0)
    digits = min(max(_USUAL_DIGITS, math.ceil(math.log10(max(largest, 1.0))) + 1), _MOST_DIGITS)
    return [number(value, digits) for value in exact]


def choose_ticks(seen: Stretch, tick: float, wanted: float, room: LabelRoom) -> Ticks:
    """Return the ticks of an axis, with two numbers at least that do not overlap.

    Parameters
    ----------
    tick
        The distance of the ticks.
    wanted
        The distance of the numbers, where there is room: one of `tick` times 1, 2, 5, 10, ….
    """
    best: Ticks | None = None
    # What is asked again where numbers may be squeezed.
    known: dict[tuple[float, float], Ticks] = {}
    least = (room.gap + min(map(room.along, "0123456789"))) / seen.scale
    for offset, squeezed in ((0.0, 1.0), (0.0, _SQUEEZED), (_offset(seen), 1.0), (0.0, 0.0)):
        for step in _steps(tick, wanted):
            if best is not None and step < min(wanted, least):
                # From here on they are ever denser.
                break
            found = known.get((offset, step)) or _labels_at(seen, step, offset, room)
            known[offset, step] = found
            if len(found.labels) < LEAST_LABELS:
                if step >= wanted:
                    continue
                if step * seen.scale < room.gap:
                    break
                continue
            if _fits(found, seen, room, squeezed):
                return found
            best = best or found
    return best or _labels_at(seen, tick, 0.0, room)


def with_marks(ticks: Ticks, seen: Stretch, tick: float, *, finer: bool) -> Ticks:
    """Return the ticks with those between the numbers; on a ruler with `finer` ones where there is room."""
    sizes = dict.fromkeys(seen.multiples(tick), 1.0) if _has_room(seen, tick) else {}
    if finer:
        share = next((share for share in (0.1, 0.2, 0.5) if _has_room(seen, share * tick)), None)
        for place in seen.multiples(share * tick) if share else ():
            sizes.setdefault(place, 0.5)
    return msgspec.structs.replace(ticks, marks=tuple(sorted(sizes.items())))


def _has_room(seen: Stretch, step: float) -> bool:
    return step * seen.scale >= _LEAST_MARK_GAP


def _steps(tick: float, wanted: float) -> Iterator[float]:
    """Yield distances of numbers: the wanted one, then larger ones, then smaller ones."""
    steps = [factor * tick for factor in _FACTORS]
    start = min(range(len(steps)), key=lambda place: abs(math.log(steps[place] / wanted)))
    yield from steps[start:]
    yield from reversed(steps[:start])


def _labels_at(seen: Stretch, step: float, offset: float, room: LabelRoom) -> Ticks:
    """Return numbers `step` apart, as far as they are not cut off at the ends."""
    places = seen.multiples(step)
    words = tick_labels([place - offset for place in places], seen.factor, step)
    labels = []
    for place, text in zip(places, words, strict=True):
        half, at = room.along(text) / 2, (place - seen.low) * seen.scale
        if -room.before <= at - half and at + half <= seen.size + room.after:
            labels.append((place, text))
    said = f"{number(offset * seen.factor, _MOST_DIGITS)} +" if offset else ""
    return Ticks(tuple(labels), offset=said, step=step)


def _fits(found: Ticks, seen: Stretch, room: LabelRoom, squeezed: float) -> bool:
    texts = [text for _, text in found.labels]
    if len(set(texts)) < len(texts):
        return False
    return (
        max(map(room.along, texts)) + room.gap <= found.step * seen.scale
        and max(map(room.across, texts)) * squeezed <= room.strip
    )


def _offset(seen: Stretch) -> float:
    """Return what all numbers in sight have in common: a multiple of a power of ten; 0 for nothing."""
    power = 10.0 ** math.ceil(math.log10(seen.high - seen.low))
    common = math.floor(seen.low / power) * power
    return common if common > 0 else math.ceil(seen.high / power) * power if seen.high < 0 else 0.0
