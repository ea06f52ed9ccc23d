"""From point to point by a quarter of a cosine squared, with a rest at every point.

No polynomials either; only the two points beside t count, and c'' jumps at every parameter.
"""

import numpy as np

name = "tests_cosine_steps"
title = "cosine steps"
can_close = True


def breaks(parameters):
    """Return where derivatives jump."""
    return parameters


def basis(t, parameters):
    """Return the cardinal functions, (m, n)."""
    last = len(parameters) - 1
    segment = np.clip(np.searchsorted(parameters, t, side="right") - 1, 0, last - 1)
    share = (t - parameters[segment]) / np.diff(parameters)[segment]
    values = np.zeros((len(t), len(parameters)))
    rows = np.arange(len(t))
    values[rows, segment] = np.cos(0.5 * np.pi * share) ** 2
    values[rows, segment + 1] = np.sin(0.5 * np.pi * share) ** 2
    # Exactly 0 and 1 where a quarter of a turn is rounded.
    values[np.abs(values) < 1e-30] = 0.0
    return values
