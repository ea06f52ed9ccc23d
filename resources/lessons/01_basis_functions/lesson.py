"""Claims of the lesson, and what its steps ask for."""

import numpy as np


def claims(lesson):
    five, eleven = lesson.curve("Five points"), lesson.curve("Eleven points")
    chebyshev = lesson.curve("Eleven points", rule="chebyshev")
    second = lesson.core(five).basis([0.25])[0]
    yield "Each function is 1 at its own parameter and 0 at all the others", second[1, 0], second[2, 0]
    yield "always add up to 1.", lesson.samples(five)[2].sum(axis=1).max()
    yield "eleven uniform parameters", len(eleven.points)
    yield "between −6.5 and 6.1 near the ends", lesson.lowest(eleven), lesson.highest(eleven)
    yield "by 44 % of the width", lesson.percent_outside(eleven)
    yield "now 29.9", lesson.lebesgue(eleven)
    more = lesson.with_uniform_points(eleven, 14)
    yield "Append three points", 3
    yield "with fourteen points Λ is 158", len(eleven.points) + 3, lesson.lebesgue(more)
    yield "**Chebyshev (2nd kind)**", 2
    yield "between −0.30 and 1.03", lesson.lowest(chebyshev), lesson.highest(chebyshev)
    yield "|c′| is 32 at both ends", lesson.speed(chebyshev, 0.0)
    yield "and 3.7 in the middle", lesson.speed(chebyshev, 0.5)
    # It said that under Chebyshev parameters the curve runs slowly at its ends.
    speeds = lesson.speeds(chebyshev)
    yield "There the curve has to run", np.isclose(speeds[0], speeds[-1], rtol=1e-6)
    yield "There the curve has to run", min(speeds[0], speeds[-1]) > 8 * speeds[4000]


def do_step_3(editor):
    """Drag a point."""
    editor.drag_point(2, to=(2.5, 1.0))


def reach_goal_4(editor):
    """Append three points."""
    for k in range(3):
        editor.wheel((2.0, 0.0), -1)
        editor.add_point(5.5 + k / 2, -1.2)


def do_step_5(editor):
    """Undo the points that you appended."""
    for _ in range(3):
        editor.trigger("undo")


def reach_goal_5(editor):
    """Choose **Chebyshev (2nd kind)** in the box *Parameters*."""
    editor.choose_parametrization("chebyshev")
