"""How far a polyline is from its curve, by many points of the curve."""

from itertools import pairwise

import numpy as np

from curvecore.bezier.polylines import segment_distance


def worst_distance(curve, pieces, box):
    """Largest distance of the curve within the box from its polyline, at twenty places a piece."""
    t = np.concatenate([np.linspace(*ends, 20) for ends in pairwise(pieces.parameters)])
    piece = np.repeat(np.arange(len(pieces.parameters) - 1), 20)
    points = curve.evaluate(t)
    distance = segment_distance(points, pieces.points[piece], pieces.points[piece + 1])
    inside = ((points >= box[:2]) & (points <= box[2:])).all(axis=1)
    return float(distance[inside].max(initial=0.0))
