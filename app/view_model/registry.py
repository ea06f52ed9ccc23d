"""A registry: the records of a kind that the modules of a package define, found by listing them."""

from __future__ import annotations

import pkgutil
from collections.abc import Collection, Iterable, Iterator
from contextlib import contextmanager
from functools import cached_property
from importlib import import_module
from typing import Any, Protocol, TypeVar


class Record(Protocol):
    """A member of a registry."""

    @property
    def name(self) -> str:
        """Its name in the program."""
        ...

    @property
    def sort_key(self) -> tuple[int, ...]:
        """The key by which records are sorted in menus and panels."""
        ...


_Record = TypeVar("_Record", bound=Record)


class Registry(Collection[_Record]):
    """All records of a kind, in their order.

    A record is a value at the top level of a module in the package; nothing else lists it. So
    ``OVERLAYS = Registry(Overlay, "app.view_model.analysis.overlays")`` has an `Overlay` more as soon as a
    file with one is in that folder.

    Parameters
    ----------
    kind
        Class of the records.
    package
        Name of the package whose modules define them; imported at the first use.
    """

    def __init__(self, kind: type[_Record], package: str) -> None:
        self._kind, self._package = kind, package

    def __iter__(self) -> Iterator[_Record]:
        return iter(self._records)

    def __contains__(self, record: object) -> bool:
        return record in self._records

    def __len__(self) -> int:
        return len(self._records)

    @contextmanager
    def with_record(self, record: _Record) -> Iterator[None]:
        """Have one more record in a block, for tests."""
        before = self._records
        self.__dict__["_records"] = self._sorted([*before, record])
        try:
            yield
        finally:
            self.__dict__["_records"] = before

    @cached_property
    def _records(self) -> list[_Record]:
        package = import_module(self._package)
        names = [module.name for module in pkgutil.iter_modules(package.__path__, f"{self._package}.")]
        members: list[Any] = [value for name in names for value in vars(import_module(name)).values()]
        return self._sorted(member for member in members if isinstance(member, self._kind))

    @staticmethod
    def _sorted(records: Iterable[_Record]) -> list[_Record]:
        # Each once, also where another module imports it.
        return sorted(set(records), key=lambda record: (record.sort_key, record.name))
