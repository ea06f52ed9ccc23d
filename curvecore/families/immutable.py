"""Base class of objects that never change: their copies, and what comes back from a pickle.

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

    def __copy__(self) -> Self:
        """Return the object itself."""
        return self

    def __deepcopy__(self, memo: dict[int, Any]) -> Self:
        """Return the object itself."""
        return self

    def __getstate__(self) -> dict[str, Any]:
        """Return what the slots hold, without what is computed when needed."""
        names = (name for each in type(self).__mro__ for name in getattr(each, "__slots__", ()))
        return {name: getattr(self, name) for name in names if name not in self._caches}

    def __setstate__(self, state: dict[str, Any]) -> None:
        """Take over what the slots held; arrays become read-only again."""
        for name, value in state.items():
            _freeze(value)
            setattr(self, name, value)
        for name in self._caches:
            setattr(self, name, None)


def _freeze(value: object) -> None:
    if isinstance(value, np.ndarray):
        value.setflags(write=False)
    elif isinstance(value, tuple):
        for each in value:
            _freeze(each)
