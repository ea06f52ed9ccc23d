"""Tests in a shuffled order, on which no result may depend; ``CURVEBENCH_ORDER=7`` shuffles with the seed 7.

Files are shuffled, and the tests within each. Those of one file stay together: they share costly fixtures.
"""

from __future__ import annotations

import os
import random

import pytest

SEED = os.environ.get("CURVEBENCH_ORDER", "")


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(items):
    """Shuffle where a seed is given; all worker processes get the same order."""
    if SEED:
        items[:] = reordered(items, SEED)


def reordered(items, seed):
    """Return test items in the order that belongs to a seed."""
    by_path = {}
    for item in items:
        by_path.setdefault(item.path, []).append(item)
    order, paths = random.Random(seed), list(by_path)
    order.shuffle(paths)
    return [item for path in paths for item in order.sample(by_path[path], len(by_path[path]))]
