"""Claims of the lesson, and what its steps ask for."""

from curvecore import self_intersections


def claims(lesson):
    uneven, chords = lesson.curve(), lesson.curve(rule="chord_length")
    hermite = [
        lesson.curve(rule=rule, family="hermite") for rule in ("uniform", "centripetal", "chord_length")
    ]
    start, end = lesson.parameters(chords)[2:4]
    yield "Two groups", 2
    t, points, _ = lesson.samples(uneven)
    yield "at its beginning", points[t < 1 / 6, 0].max() > 2 * uneven.points[1].x
    yield "and at its end", t[points[:, 0].argmax()] > 5 / 6
    yield "turns and comes back", lesson.core(uneven).evaluate(t, 1)[:, 0].min() < 0
    # The text spoke of loops: there is none, under either rule.
    loops = [len(self_intersections(lesson.core(curve), 1e-6).parameters) for curve in (uneven, chords)]
    yield "turns and comes back", loops == [0, 0]
    yield "on the right by 20.7 %", lesson.percent_outside(uneven)
    yield "0.67 of the time", lesson.gaps(chords)[2]
    yield "x never goes back", lesson.core(chords).evaluate(t, 1)[:, 0].min() >= 0
    yield "by 23.5 %", lesson.percent_outside(chords)
    yield "even further", lesson.percent_outside(chords) > lesson.percent_outside(uneven)
    t, points, _ = lesson.samples(chords)
    yield "it sags in the gap", start < t[points[:, 1].argmin()] < end
    yield "from −21 to 14", lesson.lowest(chords, start, end), lesson.highest(chords, start, end)
    yield "from 4.5 to 54.5", lesson.lebesgue(uneven), lesson.lebesgue(chords)
    yield "It is 1 at every point", lesson.lebesgue(uneven, 0.5, 0.5)
    yield "it reaches 54.5 in the gap", lesson.lebesgue(chords, start, end)
    yield "below 1.5 there", lesson.lebesgue(uneven, 1 / 3, 1 / 2)
    yield "largest near the ends, 4.5", lesson.lebesgue(uneven)
    yield "Move point 2", lesson.point(uneven, 2)
    yield "uniform (α = 0)", 0
    yield "chord length (α = 1)", 1
    yield "**centripetal** (α = ½)", lesson.curve(rule="centripetal").parametrization.alpha
    yield "(press 2)", lesson.key("familyHermite")
    yield "the two points at its ends", 2
    yield "Λ would be 1.", lesson.lebesgue(hermite[0])
    yield "Λ is 1.50 with uniform parameters", lesson.lebesgue_with_estimates(hermite[0])
    yield "3.12 with centripetal", lesson.lebesgue_with_estimates(hermite[1])
    yield "8.56 with chord lengths", lesson.lebesgue_with_estimates(hermite[2])
    yield "Try all three", len(hermite)
    yield "the 54.5 of the polynomial", lesson.lebesgue(chords)


def reach_goal_2(editor):
    """Choose **Chord length**."""
    editor.choose_parametrization("chord_length")


def do_step_3(editor):
    """Move point 2 a little."""
    x, y = editor.point(2)
    editor.drag_point(2, to=(x + 0.2, y + 0.2))


def reach_goal_4(editor):
    """Lies **centripetal** (α = ½). Choose it."""
    editor.choose_parametrization("centripetal")


def reach_goal_5(editor):
    """Switch to **Hermite** (press 2)."""
    editor.press_key("2")
