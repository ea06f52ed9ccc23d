"""Claims of the lesson, and what its steps ask for."""

import numpy as np


def claims(lesson):
    yours, solved = lesson.curve("Yours"), lesson.solved_by_hand("Yours")
    hermite = lesson.curve("Yours", rule="chord_length", family="hermite")
    yield "Seven points", len(yours.points)
    yield "point 3 is far", lesson.farthest_point(yours)
    yield "Chord lengths, three decimals", 3
    yield "rounded to three decimals", 3
    yield "the two long segments have", 2
    growth = lesson.lebesgue(solved) / lesson.lebesgue(yours)
    yield "nearly doubled", 2 if 1.75 < growth < 2 else growth
    yield "from 4.5 to 8.2", lesson.lebesgue(yours), lesson.lebesgue(solved)
    yield "Λ is below 3", 3
    yield "Press 2, then 3", lesson.key("familyHermite"), lesson.key("familyQuinticHermite")
    yield "by only 0.03 %", lesson.percent_outside(hermite)
    t, functions = lesson.cardinals(hermite)
    knots = lesson.parameters(hermite)
    worst = t[np.abs(functions).sum(axis=0).argmax()]
    yield "errors still grow in the long segments", knots[2] < worst < knots[4]
    yield "Λ is 4.4", lesson.lebesgue_with_estimates(hermite)
    yield "instead of 8.2", lesson.lebesgue(solved)


def reach_goal_2(editor):
    """Type them into the table."""
    editor.type_chord_lengths()


def do_step_3(editor):
    """Move one of the close points very slightly."""
    x, y = editor.point(1)
    editor.drag_point(1, to=(x + 0.1, y + 0.1))


def reach_goal_4(editor):
    """Choose *Power α*."""
    editor.choose_parametrization("centripetal")


def reach_goal_5(editor):
    """Press 2."""
    editor.press_key("2")
