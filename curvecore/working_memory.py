"""Memory for working arrays, kept from call to call.

The system clears every page of memory when it is first touched, and large arrays go back to it at once.
For 10,000 parameters of a cubic that took six times as long as the arithmetic.
"""

from __future__ import annotations

import math
import threading

import numpy as np

from curvecore.arrays import FloatArray

_MOST = 1 << 19  # numbers that are kept, for each thread: 4 MB


class _Kept(threading.local):
    """The memory of one thread."""

    numbers: FloatArray = np.empty(0)


_kept = _Kept()


def working_memory(shape: tuple[int, ...]) -> FloatArray:
    """Return an array with arbitrary content, valid until the same thread asks for the next one."""
    size = math.prod(shape)
    if size > _MOST:
        return np.empty(shape)
    if size > _kept.numbers.size:
        _kept.numbers = np.empty(size)
    return _kept.numbers[:size].reshape(shape)
