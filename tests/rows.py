"""One test over a table of rows: where pytest takes longer for each test than most rows take."""

from __future__ import annotations

import copy
import functools
import inspect
import reprlib
from collections.abc import Callable, Iterable
from itertools import product
from typing import NamedTuple

import numpy as np
import pytest

_FAILURES = (Exception, pytest.fail.Exception, pytest.skip.Exception)


def each_row(
    names: str | tuple[str, ...],
    rows: Iterable[object],
    ids: Callable[[object], object] | Iterable[object] | None = None,
) -> Callable:
    """Return a decorator that calls a test for every row, with the values of the row as arguments.

    It is used as ``pytest.mark.parametrize``; several of them, one above the other, combine their rows. All
    rows are tested, and the failure names those that fail. A row that is skipped is a failure. Fixtures are
    made once for all rows, but a generator of random numbers is in the same state for each of them.
    """
    arguments = tuple(names.replace(" ", "").split(",")) if isinstance(names, str) else names
    values = [row if len(arguments) > 1 else (row,) for row in rows]
    if not values:
        raise ValueError(f"There are no rows of {arguments}.")
    if ids is None or callable(ids):
        labels = ["-".join(str((ids or _label)(each)) for each in row) for row in values]
    else:
        labels = [str(each) for each in ids]
    parts = [
        _Part(label, dict(zip(arguments, row, strict=True)))
        for label, row in zip(labels, values, strict=True)
    ]

    def with_table(test: Callable) -> Callable:
        over_rows = test if hasattr(test, "tables") else _over_rows(test)
        over_rows.tables.insert(0, parts)
        signature = inspect.signature(over_rows)
        left = [each for name, each in signature.parameters.items() if name not in arguments]
        if len(left) != len(signature.parameters) - len(arguments):
            raise ValueError(f"The test does not take {arguments}.")
        over_rows.__signature__ = signature.replace(parameters=left)
        return over_rows

    return with_table


class _Part(NamedTuple):
    """One table's part of a row."""

    label: str
    values: dict[str, object]


def _over_rows(test: Callable) -> Callable:
    tables: list[list[_Part]] = []

    @functools.wraps(test)
    def over_rows(**fixtures: object) -> None:
        rows = list(product(*tables))
        failures, labels = [], []
        for row in rows:
            values = {name: value for part in row for name, value in part.values.items()}
            try:
                test(**values, **{name: _as_made(value) for name, value in fixtures.items()})
            except _FAILURES as failure:
                labels.append("-".join(part.label for part in row))
                failure.add_note(f"In the row {labels[-1]}.")
                failures.append(failure)
        if failures:
            message = f"{len(failures)} of {len(rows)} rows fail: {', '.join(labels)}"
            raise BaseExceptionGroup(message, failures)

    over_rows.tables = tables
    return over_rows


def _as_made(fixture: object) -> object:
    return copy.deepcopy(fixture) if isinstance(fixture, np.random.Generator) else fixture


def _label(value: object) -> str:
    name = getattr(value, "__name__", None) or getattr(value, "name", None)
    return name if isinstance(name, str) else reprlib.repr(value)
