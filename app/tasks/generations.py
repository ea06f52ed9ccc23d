"""When each generation of garbage is due, where Python's own collector is off. No Qt."""

from __future__ import annotations

import gc

_GROWTH = 1.25
"""Factor by which the objects that have outlived two collections grow before all of them are searched again.
Python has the same rule, but not where it is asked for the oldest generation."""


class Generations:
    """Generations of Python's collector, and when each is due."""

    def __init__(self) -> None:
        # How often the middle generation had been collected when the oldest was last looked at.
        self._count_before = gc.get_count()[2]
        self._objects_before = 0

    def collect_due(self) -> None:
        """Collect the oldest generation that is due."""
        counts, thresholds = gc.get_count(), gc.get_threshold()
        self._count_before = min(self._count_before, counts[2])
        if 0 < thresholds[2] < counts[2] - self._count_before and self._have_grown(counts[2]):
            gc.collect()
            self._objects_before = len(gc.get_objects(2))
        elif 0 < thresholds[1] < counts[1]:
            gc.collect(1)
        elif 0 < thresholds[0] < counts[0]:
            gc.collect(0)

    def _have_grown(self, count: int) -> bool:
        self._count_before = count
        return len(gc.get_objects(2)) > _GROWTH * self._objects_before
