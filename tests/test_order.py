"""The order of tests by a seed."""

from __future__ import annotations

from itertools import groupby
from types import SimpleNamespace

from tests.order import reordered

ITEMS = [SimpleNamespace(path=path, name=name) for path in "abcdef" for name in range(9)]


def test_each_seed_has_an_order_of_its_own():
    orders = [[(item.path, item.name) for item in reordered(ITEMS, str(seed))] for seed in (1, 1, 2)]
    assert orders[0] == orders[1]
    assert orders[1] != orders[2]
    assert all(sorted(order) == [(item.path, item.name) for item in ITEMS] for order in orders)


def test_the_tests_of_a_file_stay_together_in_another_order():
    found = [
        (path, [item.name for item in items])
        for path, items in groupby(reordered(ITEMS, "7"), lambda item: item.path)
    ]
    assert sorted(path for path, _names in found) == list("abcdef")
    assert all(names != sorted(names) for _path, names in found)
