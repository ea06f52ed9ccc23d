"""Radial basis functions as a stranger writes them: multiquadrics (Hardy), and a linear system solved.

They reach everywhere, grow without end, are no polynomials and do not sum to one.
"""

import numpy as np

name = "tests_multiquadric"
title = "multiquadric"


def basis(t, parameters):
    """Return the combinations that are 1 at one parameter and 0 at the others, (m, n)."""
    width = (parameters[-1] - parameters[0]) / len(parameters)

    def radial(places):
        return np.sqrt(1 + ((places[:, None] - parameters[None, :]) / width) ** 2)

    return radial(t) @ np.linalg.inv(radial(parameters))
