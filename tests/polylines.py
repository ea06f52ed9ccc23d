"""How far a polyline is from its curve, by many points of the curve."""

import numpy as np

from curvecore.bezier.flatten import segment_distance


def worst_distance(curve, pieces, box):
    """Largest distance of the curve within the box from its polyline, at twenty places a piece."""
    t = np.linspace(pieces.parameters[:-1], pieces.parameters[1:], 20, axis=1).ravel()
    piece = np.repeat(np.arange(len(pieces.parameters) - 1), 20)
    points = curve.evaluate(t)
    distance = segment_distance(points, pieces.points[piece], pieces.points[piece + 1])
    inside = ((points >= box[:2]) & (points <= box[2:])).all(axis=1)
    return float(distance[inside].max(initial=0.0))
