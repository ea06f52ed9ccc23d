"""Base class of immutable objects: equality, copies and pickles.

NumPy pickles values and not flags, so an array that came back would be
writeable, next to values computed from what it held before. A copy of what
never changes is the thing itself, as with tuples.
"""

from __future__ import annotations

from typing import Any, ClassVar, Self

import numpy as np


class Immutable:
    """An object with slots whose arrays are read-only, in itself, in copies and after unpickling.

    Subclasses list in `_caches` the slots that are computed when first needed, with None before; these are
    not pickled.
    """

    __slots__ = ()

    _caches: ClassVar[tuple[str, ...]] = ()

    def __eq__(self, other: object) -> bool:
        """Whether the other object is of the same class and holds the same."""
        if self is other:
            return True
        if type(self) is not type(other) or not isinstance(other, Immutable):
            return NotImplemented
        return self._key() == other._key()

    def __hash__(self) -> int:
        """Return a number that equal objects share."""
        return hash(self._key())

    def _key(self) -> tuple[object, ...]:
        return tuple(_key(value) for value in self.__getstate__().values())

    def __copy__(self) -> Self:
        """Return the object itself."""
        return self

    def __deepcopy__(self, memo: dict[int, Any]) -> Self:
        """Return the object itself."""
        return self

    def __getstate__(self) -> dict[str, Any]:
        """Return the values of the slots, without the caches."""
        names = (name for base in type(self).__mro__ for name in getattr(base, "__slots__", ()))
        return {name: getattr(self, name) for name in names if name not in self._caches}

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Set the values of the slots; arrays become read-only again."""
        for name, value in state.items():
            _freeze(value)
            setattr(self, name, value)
        for name in self._caches:
            setattr(self, name, None)


def _key(value: object) -> object:
    """Return a key that is equal, and has the same hash, where values and their shapes are the same."""
    if isinstance(value, np.ndarray):
        # Adding 0 makes -0.0, which is equal to 0.0, the same bytes.
        return value.shape, (value + 0.0).tobytes()
    return tuple(_key(item) for item in value) if isinstance(value, tuple) else value


def _freeze(value: object) -> None:
    if isinstance(value, np.ndarray):
        value.setflags(write=False)
    elif isinstance(value, tuple):
        for item in value:
            _freeze(item)
