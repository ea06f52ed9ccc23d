"""The functions that exported Python code consists of; the writer copies their source.

They are run here, too: the deviation that an export states is that of this code.
"""

# ruff: noqa: ANN001, ANN201
# mypy: ignore-errors
# Exported code has no annotations, so that everybody can read it.

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
    """Return the curve with jets (n, R, 2), points and derivatives by t, at t (m,): de Casteljau's scheme."""
    i = np.clip(np.searchsorted(parameters, t, side="right") - 1, 0, len(parameters) - 2)
    h = (parameters[i + 1] - parameters[i])[:, None]
    s = (t - parameters[i])[:, None] / h
    r = (parameters[i + 1] - t)[:, None] / h
    ahead, behind = [], []
    for controls, end, step in ((ahead, jets[i], h), (behind, jets[i + 1], -h)):
        for m in range(jets.shape[1]):
            # Control point m: the sum of m! / (m - k)! / k! * (d - k)! / d! * step**k times derivative k.
            control, factor = end[:, 0], 1.0
            for k in range(1, m + 1):
                factor = factor * (m - k + 1) / (k * (2 * jets.shape[1] - k)) * step
                control = control + factor * end[:, k]
            controls.append(control)
    controls = ahead + behind[::-1]
    while len(controls) > 1:
        controls = [r * controls[m] + s * controls[m + 1] for m in range(len(controls) - 1)]
    return controls[0]


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
