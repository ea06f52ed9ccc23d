"""The functions that exported Python code consists of; the writer copies their source.

They are run here, too: the deviation that an export states is that of this code.
"""

# ruff: noqa: ANN001, ANN201
# mypy: ignore-errors
# Exported code is read by people with other habits; it goes without annotations.

import numpy as np


def lagrange(t, parameters, points):
    """Return the polynomial through points (n, 2) at t (m,): the product form, without divisions by zero."""
    # Products over an interval of length 4 neither grow nor shrink much; a power of two rounds nothing.
    scale = 2.0 ** np.round(2.0 - np.log2(parameters[-1] - parameters[0]))
    factors = (t[:, None] - parameters) * scale
    ones = np.ones((len(t), 1))
    left = np.cumprod(np.hstack([ones, factors[:, :-1]]), axis=1)
    right = np.cumprod(np.hstack([ones, factors[:, :0:-1]]), axis=1)[:, ::-1]
    differences = (parameters[:, None] - parameters) * scale
    np.fill_diagonal(differences, 1.0)
    return (left * right / np.prod(differences, axis=1)) @ points


def hermite(t, parameters, jets):
    """Return the curve with jets (n, 2 or 3, 2) - point, velocity, acceleration - at t (m,)."""
    i = np.clip(np.searchsorted(parameters, t, side="right") - 1, 0, len(parameters) - 2)
    h = (parameters[i + 1] - parameters[i])[:, None]
    s = (t - parameters[i])[:, None] / h
    r = (parameters[i + 1] - t)[:, None] / h
    p, q = jets[i], jets[i + 1]
    if jets.shape[1] == 2:
        b1 = p[:, 0] + h * p[:, 1] / 3
        b2 = q[:, 0] - h * q[:, 1] / 3
        return r**3 * p[:, 0] + 3 * r**2 * s * b1 + 3 * r * s**2 * b2 + s**3 * q[:, 0]
    b1 = p[:, 0] + h * p[:, 1] / 5
    b2 = p[:, 0] + 2 * h * p[:, 1] / 5 + h**2 * p[:, 2] / 20
    b3 = q[:, 0] - 2 * h * q[:, 1] / 5 + h**2 * q[:, 2] / 20
    b4 = q[:, 0] - h * q[:, 1] / 5
    outer = r**5 * p[:, 0] + 5 * r**4 * s * b1 + 5 * r * s**4 * b4 + s**5 * q[:, 0]
    return outer + 10 * r**3 * s**2 * b2 + 10 * r**2 * s**3 * b3


def evaluate(pieces, t):
    """Return the points (..., 2) at t (...) of a curve of pieces (parameters, jets) between corners."""
    t = np.asarray(t, dtype=float)
    flat = t.ravel()
    piece_of = np.searchsorted([parameters[0] for parameters, _ in pieces[1:]], flat, side="right")
    result = np.empty((flat.size, 2))
    for index, (parameters, jets) in enumerate(pieces):
        here = piece_of == index
        if jets.shape[1] == 1:
            result[here] = lagrange(flat[here], parameters, jets[:, 0])
        else:
            result[here] = hermite(flat[here], parameters, jets)
    return result.reshape(*t.shape, 2)
