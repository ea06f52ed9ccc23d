"""Tests in another order, which no result may depend on: ``CURVEBENCH_ORDER=7`` is the seventh of them.

Files come in any order, and the tests of each; those of one file stay together, as they share what is dear.
"""

from __future__ import annotations

import os
import random

import pytest

SEED = os.environ.get("CURVEBENCH_ORDER", "")


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(items):
    """Change the order where that is asked for; it is the same one in all processes."""
    if SEED:
        items[:] = reordered(items, SEED)


def reordered(items, seed):
    """Return the items, which have a path, in the order of this seed."""
    by_path = {}
    for item in items:
        by_path.setdefault(item.path, []).append(item)
    order, paths = random.Random(seed), list(by_path)
    order.shuffle(paths)
    return [item for path in paths for item in order.sample(by_path[path], len(by_path[path]))]
