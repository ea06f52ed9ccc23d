"""Claims of the lesson, and what its steps ask for."""

import numpy as np

from curvecore import chord_length


def claims(lesson):
    step, out, careless = (lesson.curve(name) for name in ("In step", "Out of step", "Careless"))
    count = len(lesson.document.curves)
    yield "Three sets of parameters", count
    yield "Three travellers", count
    yield "Three curves pass", count
    yield "the same seven points", len(step.points)
    lengths = chord_length(lesson.points(step))
    yield "a time in proportion to its length", np.abs(lengths - lesson.parameters(step)).max() < 0.01
    mean_speeds = lesson.distances(step) / lesson.gaps(step)
    yield "between 7.6 and 8.0", mean_speeds.min(), mean_speeds.max()
    yield "by only 2.3 % of the width", lesson.percent_outside(step)
    yield "from −2.3 to 1.9", lesson.lowest(step), lesson.highest(step)
    t, _, basis = lesson.samples(step)
    knots = lesson.parameters(step)
    yield "near the ends they reach", np.abs(basis[(t > knots[1]) & (t < knots[-2])]).max() < 1.1
    yield "Λ is 7.2", lesson.lebesgue(step)
    yield "point 3 to point 4", lesson.point(out, 3), lesson.point(out, 4)
    yield "little time, 0.12", lesson.gaps(out)[3]
    yield "has much, 0.19", lesson.gaps(out)[2]
    distances = lesson.distances(out)
    yield "the shorter one before it", distances[2] < distances[3]
    t, points, _ = lesson.samples(out)
    yield "at its beginning", t[points[:, 0].argmin()] < lesson.parameters(out)[1]
    yield "by 12 % of the width", lesson.percent_outside(out)
    yield "Λ is 8.5", lesson.lebesgue(out)
    yield "they have hardly grown", lesson.lebesgue(out) < 1.2 * lesson.lebesgue(step)
    yield "Points 0 and 1, 2 and 3, and 4 and 5", *(lesson.point(careless, i) for i in range(6))
    yield "at most 0.05 apart", lesson.gaps(careless)[[0, 2, 4]].max()
    yield "by 95 % of the width", lesson.percent_outside(careless)
    yield "by 1.4 % of the width", lesson.percent_outside(lesson.curve("Careless", rule="chord_length"))


def reach_goal_5(editor):
    """Drag the triangles on the t-rail."""
    editor.type_parameters([0.2, 0.34, 0.48, 0.66, 0.81])


def reach_goal_6(editor):
    """Choose **Chord length** in the box *Parameters*."""
    editor.choose_parametrization("chord_length")
