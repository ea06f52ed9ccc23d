"""Claims of the lesson, and what its steps ask for."""

import numpy as np


def claims(lesson):
    bell, blend = lesson.curve("Bell"), lesson.curve("Blend")
    lower, highest = (lesson.with_setting(blend, degree=degree) for degree in (1, 10))
    degree = lesson.core(blend).chosen["degree"]
    t, points, _ = lesson.samples(bell)
    top = lesson.points(bell)[:, 1].max()
    yield "Eleven points of", len(bell.points)
    yield "climbs to 1.96", points[:, 1].max()
    yield (
        "in the first and in the last segment",
        set((10 * t[points[:, 1] > top + 1e-9]).astype(int)) == {0, 9},
    )
    yield "higher than 1.", top
    yield "there: Λ is 29.9", lesson.lebesgue(bell)
    yield "its Λ is only 3.7", lesson.lebesgue(blend)
    yield "degree 3, each through four", degree, degree + 1
    yield "to 1: Λ falls to 2.27", 1, lesson.lebesgue(lower)
    yield "drag the slider to 10", 10
    yield "Through eleven points", len(blend.points)
    yield "Λ is 29.9 again", lesson.lebesgue(highest)
    down = np.array([0.0, 1.5])
    yield (
        "has the shape that the upper one had",
        (np.abs(lesson.samples(highest)[1] + down - points).max() < 1e-12),
    )
    highest_point = lesson.points(blend)[:, 1].max()
    yield "it does not oscillate", lesson.samples(blend)[1][:, 1].max() < highest_point + 1e-9


def reach_goal_3(editor):
    """Click **Barycentric rational** in the legend."""
    editor.choose_in_legend("floater_hormann")


def reach_goal_4(editor):
    """Set its **blended degree** to 1."""
    editor.type_setting("degree", "1")
