"""Claims of the lesson, and what its steps ask for."""

import numpy as np

from curvecore import joint_report


def claims(lesson):
    cubic, quintic = lesson.core(lesson.curve("Cubic")), lesson.core(lesson.curve("Quintic"))
    yield "passes three stations", len(cubic.points) - 2
    yield "It jumps at every station", {joint.parametric for joint in joint_report(cubic)} == {1}
    yield "it is large from the very first moment", np.hypot(*cubic.evaluate(0.0, 2)) > 1
    yield "when the tool is still at rest", not cubic.evaluate(0.0, 1).any()
    yield "Degree five", quintic.degree
    yield "no longer jumps", {joint.parametric for joint in joint_report(quintic)} == {2}
    yield "begins and ends at 0", np.abs(quintic.evaluate([0.0, 4.0], 2)).max()
    yield "Two dots", 2
    yield "One key does it: 3.", lesson.key("familyQuinticHermite")
    spline = lesson.core(lesson.with_estimated_velocities(lesson.curve("Cubic"), slice(1, -1)))
    yield "share the acceleration", {joint.parametric for joint in joint_report(spline)} == {2}
    yield "the tool stays at rest there", not spline.evaluate([0.0, 4.0], 1).any()


def reach_goal_5(editor):
    """One key does it: 3."""
    editor.press_key("3")
