"""Template of a family file: Lagrange's functions as the course writes them, with things to try."""

from __future__ import annotations

import re
from pathlib import Path

_TEXT = '''\
"""Lagrange's functions, written as in the course. Save this file, and the curve is redrawn."""

import numpy as np

name = "{name}"  # what documents store: a short word in small letters
title = "{title}"  # what the buttons say


def basis(t, parameters):
    """Return B_i(t_k), shape (m, n), of t (m,) and the ascending parameters t_i (n,)."""
    columns = []
    for i in range(len(parameters)):
        others = np.delete(parameters, i)
        # B_i is 1 at t_i and 0 at all others. Try it: leave one factor out, and read what the panel says.
        columns.append(np.prod((t[:, None] - others) / (parameters[i] - others), axis=1))
    return np.stack(columns, axis=1)


# Try bells instead of polynomials: np.exp(-((t[:, None] - parameters) * len(parameters)) ** 2).
# Then divide them by their sum, or make them 1 and 0 at the parameters by np.linalg.solve.
#
# A file may define more:
# def basis(t, parameters, order): ...    the order-th derivatives; without it they are differences
# def breaks(parameters): ...             where derivatives jump, as return parameters
# interpolates = False                    the curve passes beside its points, as over control points
# can_close = True                        a closed curve is smooth where it closes
# settings = [FamilySetting("width", "width of a bell", 1.0, limits=(0.2, 5.0), step=0.1)]
#     a field and a slider in the form of the curve, for basis(t, parameters, width); whole numbers where the
#     default is whole; from curvecore import FamilySetting
'''


def template(path: Path) -> str:
    """Return the text of a file at `path`, whose family is called as the file is."""
    word = re.sub(r"[^a-z0-9]+", "_", path.stem.lower()).strip("_")[:40].rstrip("_")
    name = word if re.match("[a-z]", word) else f"my_{word}"[:40].rstrip("_")
    return _TEXT.format(name=name, title=name.replace("_", " "))
