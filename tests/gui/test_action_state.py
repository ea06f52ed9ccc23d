"""Actions are rendered when the facts that decide about them have changed: never less, and not in a drag."""

import random

import pytest
from msgspec.structs import replace

from app.actions.needs import NOTHING
from app.actions.state import DerivedValues, changed_facts
from app.document.model import Document, make_curve
from app.families import FAMILIES, HERMITE
from app.tools.canvas.add import ADD
from app.window.connect import all_actions
from tests.count_drag import codes_called
from tests.gui.editor_facts import assert_actions_as_rendered_anew

WAVE = make_curve([(0, 0), (1, 1), (2, 0), (3, 1)], name="Wave", family=HERMITE)
LINE = make_curve([(0, 3), (3, 4)], name="Line")
SWITCHES = ("curveLocked", "curveVisible", "closeCurve", "toggleGrid", "turnGrips", "toggleTransformBox")
STEPS_OF_EDITING = (
    "undo",
    "undo",
    "redo",
    "deleteSelection",
    "insertMidpoints",
    "groupCurves",
    "ungroupCurves",
)


def test_actions_are_as_if_rendered_anew_after_each_edit(editor):
    """With documents in which most can be done, so that most is switched."""
    choose, session = random.Random(1), editor.session

    def begin():
        session.commit(Document((WAVE, LINE, WAVE)), "Begin", active=choose.randrange(2))

    def select_points():
        count = len(session.active_curve.points)
        session.selected.set_points(choose.sample(range(count), choose.randint(0, count)))

    def select_curves():
        curves = range(len(session.document.curves))
        session.selected.select_whole(choose.sample(curves, choose.randint(0, len(curves))))

    def edit_curve():
        session.selected.activate(choose.randrange(len(session.document.curves)))

    def trigger(*names):
        action = editor.action(choose.choice(names))
        if action.isEnabled():
            action.trigger()

    deeds = (
        begin,
        select_points,
        select_points,
        select_curves,
        edit_curve,
        lambda: trigger(*(family.action_name for family in FAMILIES)),
        lambda: trigger(*SWITCHES),
        lambda: trigger(*STEPS_OF_EDITING),
        lambda: trigger("selectTool", "addTool", "pencilTool", "measureTool"),
        lambda: trigger("tangentCorner", "tangentSmooth", "straightSegment", "parameters_uniform"),
        lambda: trigger("combineCurves", "breakApart", "joinCurve", "splitCurve", "duplicateCurve"),
        lambda: trigger("raiseCurve", "lowerCurve", "showAll", "unlockAll", "convertToHermite"),
        lambda: session.scrub.set(choose.choice((None, 0.5))),
        lambda: session.files.replace(Document((choose.choice((WAVE, LINE)),)), None),
    )
    begin()
    for _ in range(150):
        choose.choice(deeds)()
        editor.settle()
        assert_actions_as_rendered_anew(editor)


def predicates():
    """Return the code of all that is asked of an action."""
    asked = set()
    for each in all_actions():
        needs = (each.needs, each.section.needs, each.key_needs)
        asked |= {each.checked, each.title, each.when_opened}
        asked |= {question for need in needs for question in (need.is_met, need.why)}
    return {question.__code__ for question in asked if callable(question)}


def test_during_a_gesture_on_another_curve_actions_refer_to_the_drawn_curve(editor):
    """A menu would have shown the family of the curve that was edited before."""
    editor.session.commit(
        Document((make_curve([(0, 0), (1, 2), (3, 2)], family=FAMILIES.named("b_spline")),)), "Begin"
    )
    editor.trigger("rectangleTool")
    editor.fit()
    editor.press((0.2, 1.8))
    editor.move((0.4, 1.7))
    editor.move((0.6, 1.5))
    assert editor.session.is_previewing
    assert editor.session.active_curve.family is not FAMILIES.named("b_spline")
    assert_actions_as_rendered_anew(editor)
    editor.escape()
    assert_actions_as_rendered_anew(editor)


def test_a_drag_of_a_selected_point_updates_no_action(editor):
    for family in FAMILIES[:8]:
        curve = make_curve(((0, 0), (1, 1), (2, 0), (3, 1)), family=family)
        editor.session.commit(Document((curve,)), "Begin")
        editor.fit()
        editor.drag_point(1, (1.2, 0.8))
        assert editor.session.selection == {1}, family
        codes = codes_called(lambda: editor.drag_point(1, (1.4, 1.1)))
        assert editor.point(1) == pytest.approx((1.4, 1.1), abs=0.02), family
        assert codes.keys() & predicates() == set(), family
        assert editor.action("undo").text() == "Undo: Move point 1", family


def test_one_changed_fact_updates_only_the_dependent_actions(editor):
    editor.session.commit(Document((make_curve(((0, 0), (1, 1), (2, 0), (3, 1))),)), "Begin")
    editor.settle()

    def asked(deed):
        return codes_called(deed).keys() & predicates() - {NOTHING.is_met.__code__}

    actions, window = {each.name: each for each in all_actions()}, editor.window
    assert asked(lambda: window.store.change(grid=False)) == {actions["toggleGrid"].checked.__code__}
    tools = {actions[name].checked.__code__ for name in ("addTool", "explainWiggle")}
    assert asked(lambda: window.store.change(tool=ADD)) == tools
    assert 10 < len(asked(lambda: editor.session.selected.set_points([1]))) < len(predicates()) / 2


def test_facts_are_noted_that_properties_and_methods_read(editor):
    state = editor.window.actions_by_name._facts.read()
    values = DerivedValues(
        {
            "is_hermite": lambda state: state.has_derivatives,
            "adds": lambda state: state.window.uses(ADD),
            "adds_to_hermite": lambda state: state.has_derivatives and state.window.uses(ADD),
        }
    )
    nothing = dict.fromkeys(("is_hermite", "adds", "adds_to_hermite"), False)
    assert dict(values.renewed(state, set())) == nothing
    assert dict(values.renewed(state, set())) == {}
    as_hermite = replace(state, family=HERMITE)
    changed = replace(as_hermite, window=replace(state.window, tool=ADD))
    assert changed_facts(state, changed) == {"family", "window.tool"}
    assert dict(values.renewed(changed, changed_facts(state, changed))) == dict.fromkeys(nothing, True)
    # Not asked again where only other facts differ.
    assert dict(values.renewed(as_hermite, {"window.tool"})) == {"adds": False, "adds_to_hermite": False}
    assert dict(values.renewed(state, {"family"})) == {"is_hermite": False, "adds_to_hermite": False}
    # The last one did not get as far as the tool.
    assert dict(values.renewed(replace(state, window=changed.window), {"window.tool"})) == {"adds": True}


def test_another_selected_point_updates_no_action(editor):
    editor.session.commit(Document((make_curve(((0, 0), (1, 1), (2, 0), (3, 1))),)), "Begin")
    editor.fit()
    editor.drag_point(1, (1.2, 0.8))
    assert codes_called(lambda: editor.drag_point(2, (2.2, 0.2))).keys() & predicates() == set()
