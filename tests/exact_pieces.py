"""Hermite curves of a document in exact fractions: Bézier pieces, values, derivatives and curvatures."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise
from math import comb, perm


def pieces_of(view):
    """The pieces of a view: where each begins and ends in t, and its control points.

    They are exact for the derivatives in force, which are floats, whether set or estimated.
    """
    before, after = ([[exact(vector) for vector in jet] for jet in side.tolist()] for side in view.sides)
    t = [Fraction(value) for value in view.parameters.tolist()]
    return [
        (t[at], t[at + 1], controls(after[at], before[at + 1], t[at + 1] - t[at])) for at in range(len(t) - 1)
    ]


def exact(vector):
    return tuple(map(Fraction, vector))


def controls(start, end, h):
    """The control points of a piece from its jets at both ends."""
    degree = 2 * len(start) - 1

    def inwards(jet, step):
        for count in range(len(jet)):
            terms = [(comb(count, k) * step**k / perm(degree, k), jet[k]) for k in range(count + 1)]
            yield tuple(sum(share * vector[axis] for share, vector in terms) for axis in (0, 1))

    return [*inwards(start, h), *reversed([*inwards(end, -h)])]


def value(points, s):
    """The point at s in [0, 1], by de Casteljau's algorithm."""
    while len(points) > 1:
        points = [tuple((1 - s) * a + s * b for a, b in zip(p, q, strict=True)) for p, q in pairwise(points)]
    return points[0]


def at(pieces, t, order=0):
    """The value, or a derivative with respect to t, at a fraction t inside the domain."""
    start, end, points = next(piece for piece in pieces if piece[0] <= t <= piece[1])
    return value(differences(points, end - start, order), (t - start) / (end - start))


def differences(points, h, order):
    for degree in range(len(points) - 1, len(points) - 1 - order, -1):
        points = [tuple(degree * (b - a) / h for a, b in zip(p, q, strict=True)) for p, q in pairwise(points)]
    return points


def cross(v, w):
    return v[0] * w[1] - v[1] * w[0]


def curvature_at(piece, s):
    """The signed curvature at s of a piece; exact but for a square root."""
    start, end, points = piece
    velocity, acceleration = (value(differences(points, end - start, order), s) for order in (1, 2))
    size = velocity[0] ** 2 + velocity[1] ** 2
    return float(cross(velocity, acceleration)) / float(size) ** 1.5


def sign_changes(function, start, end, count=2000):
    """How often a function of fractions changes its sign at samples of a stretch."""
    signs = [function(start + (end - start) * Fraction(2 * k + 1, 2 * count)) > 0 for k in range(count)]
    return sum(a != b for a, b in pairwise(signs))
