"""Random gestures and edits against a list of documents: undo and redo are exact, cancel leaves nothing.

The tools are driven as the canvas drives them, with plain pointer records and the canvas's own hit test,
against a real session.
"""

from __future__ import annotations

from hypothesis import HealthCheck, settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, precondition, rule
from msgspec.structs import replace

from app.canvas.hit_test import PixelPoints, hit_test, nearer
from app.document import curve_edits, point_edits, rule_edits
from app.document.limits import EditError
from app.document.model import Document, ParametrizationKind, Point, make_curve
from app.document.selection import all_points
from app.document.transforms import Edge, align_points, distribute_points
from app.families import FAMILIES, HERMITE, LAGRANGE
from app.features.wiggle.commands import EXPLAIN
from app.plotting.pixel_map import PixelMap
from app.session import Session
from app.storage.format import decode, encode
from app.storage.validation import validate
from app.tools.box import TransformKind
from app.tools.canvas.select import SELECT
from app.tools.parameters import RAIL
from app.tools.pointer import Hit, Part, Pointer
from app.tools.snapping import Snapping
from app.tools.tool import TOOLS, CanvasQueries
from app.tools.toolbox import Toolbox
from app.tools.transform import transform_by_key
from app.view_model.curve.handles import handles_at, handles_on, sides_facing

SHOWN = PixelMap(-3.0, 5.0, 100.0, 100.0, 1000.0, 800.0)
TOLERANCE = 1e-3


def facing(view, chosen):
    """The handles that face the selected points."""
    return handles_on(view, sides_facing(chosen, len(view.source.points), closed=view.source.is_closed))


places = st.tuples(st.integers(-20, 60), st.integers(-20, 40)).map(lambda p: (p[0] / 10, p[1] / 10))
modifiers = st.fixed_dictionaries({name: st.booleans() for name in ("shift", "ctrl", "alt")})
moves = st.lists(st.tuples(places, modifiers), min_size=1, max_size=3)
endings = st.sampled_from(("release", "release", "release", "cancel", "undo", "forget", "refused"))
aims = st.tuples(
    st.sampled_from(("point", "other point", "handle", "curve", "other", "grip", "anywhere")),
    st.integers(0, 40),
    places,
)
keys = st.lists(
    st.sampled_from(["1", "5", "0", ".", "-", "/", "m", "x", "y", "g", "s", "r", "R", "backspace"]),
    max_size=4,
)


def refused(_document):
    raise EditError("This is refused.")


class Answers(CanvasQueries):
    """A plot of which one thing is known: what is hit."""

    def __init__(self, hit):
        self.hit = hit

    def grid_spacing(self):
        return 0.5


class Gestures(RuleBasedStateMachine):
    """Keeps the list of documents that the history must hold, and where in it we are."""

    @initialize(family=st.sampled_from(FAMILIES))
    def begin(self, family):
        self.session = Session()
        curves = (
            make_curve([(0, 0), (1, 2), (3, 2), (4, 0)], family=family),
            make_curve([(0, -1), (2, -0.5), (4, -1)], name="Base", family=HERMITE),
        )
        self.session.files.replace(Document(curves), None)
        self.tool, self.rail = Toolbox(self.session, SELECT), Toolbox(self.session, RAIL)
        self.tool.canvas, self.rail.canvas = Answers(self.hit), Answers(lambda _pointer, _parts: self.tick)
        self.now = 0.0
        self.session.history.clock = lambda: self.now
        # As the window connects them.
        self.session.gesture_ended.connect(self.tool.abandon)
        self.session.gesture_ended.connect(self.rail.abandon)
        self.values, self.at = [self.session.document], 0
        self.saved = None

    # What must hold

    @invariant()
    def the_document_is_the_one_of_the_list(self):
        stack = self.session.undo_stack
        assert stack.index() == self.at
        assert stack.count() == len(self.values) - 1
        assert self.session.document == self.values[self.at]
        assert not self.tool.is_pressed
        selected, curves = self.session.selected, self.session.document.curves
        assert selected.group.curves <= selected.active_curves
        assert bool(selected.points) == bool(selected.group.parts)
        for curve, indices in selected.group.parts:
            assert 0 <= min(indices) <= max(indices) < len(curves[curve].points)
        assert {self.session.active_index} <= selected.curves <= {*range(len(curves))}
        if selected.is_editing:
            assert selected.whole_curves == (selected.curves if len(selected.curves) > 1 else set())
        else:
            # Whole curves are chosen, or none: no point of them.
            assert selected.whole_curves in (set(), selected.curves)
            assert not selected.points
            # Tools that edit points, begin no curve and find no other ones have a curve that is edited.
            tool, record = self.tool.tool, self.tool.record
            assert Part.OTHER_CURVE in tool.hits or record.empty_message or not tool.edits_points

    @invariant()
    def the_document_can_be_saved(self):
        document = self.session.document
        if document is self.saved:
            return  # asked when it was made, and it cannot change
        validate(document)
        assert decode(encode(document)) == document
        self.saved = document

    def note(self):
        """Take down what a gesture or an edit has committed: one step at most."""
        stack = self.session.undo_stack
        if stack.index() == self.at and self.session.document == self.values[self.at]:
            return
        assert stack.index() == self.at + 1
        assert stack.undoText()
        self.last_step = stack.undoText()
        self.values[self.at + 1 :] = [self.session.document]
        self.at += 1

    # History

    @precondition(lambda self: self.at > 0)
    @rule(steps=st.integers(1, 4))
    def undo(self, steps):
        for _ in range(min(steps, self.at)):
            self.session.undo_stack.undo()
            self.at -= 1
            assert self.session.document == self.values[self.at]

    @precondition(lambda self: self.at < len(self.values) - 1)
    @rule(steps=st.integers(1, 4))
    def redo(self, steps):
        for _ in range(min(steps, len(self.values) - 1 - self.at)):
            self.session.undo_stack.redo()
            self.at += 1
            assert self.session.document == self.values[self.at]

    # Gestures

    def pointer(self, position, held=None):
        return Pointer(position, SHOWN.point(*position), scale=SHOWN.sx, **(held or {}))

    def hit(self, pointer, parts):
        view, chosen = self.session.active_view, self.session.selection
        if not self.session.selected.is_editing:
            return self.hit_whole(pointer)
        handles = handles_at(view, chosen), facing(view, chosen)
        polyline = view.flattened(TOLERANCE, SHOWN.box) if view.curve is not None else None
        hit = hit_test(pointer.pixel, SHOWN, view, polyline, chosen, *handles)
        if Part.OTHER_POINT in parts and self.other in self.session.selected.active_curves:
            places = PixelPoints([(self.other, self.session.views[self.other])], SHOWN)
            found = places.nearest(pointer.pixel, self.session.selected.group)
            hit = nearer(found, hit, pointer.pixel, SHOWN)
        if hit is None and Part.OTHER_CURVE in parts and self.on_curve(self.other, pointer.pixel):
            hit = Hit(Part.OTHER_CURVE, self.other, pointer.position)
        return hit

    def hit_whole(self, pointer):
        """What lies there while no curve is edited."""
        places = (self.other, self.session.active_index)
        found = [place for place in places if self.on_curve(place, pointer.pixel)]
        return Hit(Part.OTHER_CURVE, found[0], pointer.position) if found else None

    @property
    def other(self):
        return 1 - self.session.active_index

    def on_curve(self, place, pixel):
        view = self.session.views[place]
        polyline = view.flattened(TOLERANCE, SHOWN.box) if view.curve is not None else None
        hit = hit_test(pixel, SHOWN, view, polyline, frozenset(), [])
        return hit is not None and hit.part is Part.CURVE

    def aimed(self, aim):
        """A place worth pressing at."""
        what, number, anywhere = aim
        view, chosen = self.session.active_view, self.session.selection
        others = self.session.views[self.other].source.points
        if what == "other point" and others:
            return others[number % len(others)].position
        if what == "point" and view.source.points:
            return view.source.points[number % len(view.source.points)].position
        if what == "handle" and (handles := [*handles_at(view, chosen), *facing(view, chosen)]):
            return handles[number % len(handles)].position
        if what == "curve" and view.is_current:
            start, end = view.curve.domain
            return tuple(view.curve.evaluate(start + (end - start) * number / 40).tolist())
        if what == "other" and (other := self.session.views[self.other]).is_current:
            start, end = other.curve.domain
            return tuple(other.curve.evaluate(start + (end - start) * (number + 0.3) / 41).tolist())
        if what == "grip" and (box := self.tool.marks().box) is not None:
            grips = box.grips(SHOWN.sx)
            return grips[number % len(grips)][1]
        return anywhere

    def end(self, tool, ending, pointer, selection):
        """End a gesture; cancelled, it restores the selection of before its press."""
        # Equal to the value of the list; nudges there and back may have made another object of it.
        before = self.session.committed
        if ending == "release":
            tool.release(pointer)
        elif ending == "forget" and self.at > 0:
            # Undo from elsewhere, in the middle of the gesture.
            self.session.undo_stack.undo()
            self.at -= 1
            tool.release(pointer)
        elif ending == "refused":
            # An edit from elsewhere, in the middle of the gesture, that cannot be made.
            assert self.session.change("Refused", refused).refusal == "This is refused."
            assert not tool.is_pressed
            assert self.session.document is before
            tool.release(pointer)
            assert self.session.document is before
        else:
            assert not tool.cancel() or self.session.selected.state == selection
            assert not tool.is_pressed
            assert self.session.document is before
            tool.release(pointer)
            assert self.session.document is before
        self.note()

    @rule(record=st.sampled_from((*TOOLS, EXPLAIN)), snapping=st.booleans())
    def choose_tool(self, record, snapping):
        self.tool.choose(record)
        self.tool.snapping.settings = Snapping(snapping)

    @rule(aim=aims, held=modifiers, moves=moves, ending=endings)
    def drag(self, aim, held, moves, ending):
        at = self.aimed(aim)
        self.tool.hover(self.pointer(at, held))
        selection = self.session.selected.state
        self.tool.press(self.pointer(at, held))
        for position, modified in moves:
            self.tool.move(self.pointer(position, modified))
            self.tool.status()
            self.tool.marks()
        self.end(self.tool, ending, self.pointer(*moves[-1]), selection)

    @rule(aim=aims, held=modifiers, is_double=st.booleans())
    def click(self, aim, held, is_double):
        pointer = self.pointer(self.aimed(aim), held)
        self.tool.press(pointer)
        self.tool.release(pointer)
        self.note()
        if is_double:
            self.tool.press(replace(pointer, is_double=True))
            self.tool.release(pointer)
            self.note()

    @rule(chosen=st.sets(st.integers(0, 1)))
    def leave_the_curve(self, chosen):
        if self.tool.record is SELECT:
            self.session.selected.select_whole(chosen)

    @rule(step=st.sampled_from([-1, 1]))
    def walk(self, step):
        self.tool.key("next" if step > 0 else "previous")

    @rule()
    def press_enter(self):
        self.tool.key("enter")

    @rule(kind=st.sampled_from(list(TransformKind)), at=places, moves=moves, keys=keys, ending=endings)
    def transform(self, kind, at, moves, keys, ending):
        selection = self.session.selected.state
        if not self.tool.begin(
            lambda event: transform_by_key(event, kind), self.pointer(at), buttonless=True
        ):
            return
        for position, modified in moves:
            self.tool.move(self.pointer(position, modified))
        for key in keys:
            self.tool.key(key)
            self.tool.status()
        if ending == "release":
            self.tool.key("enter")
            if self.tool.is_pressed:
                # What was typed is no number yet.
                self.tool.cancel()
            self.note()
        else:
            self.end(self.tool, ending, self.pointer(at), selection)

    @rule(knot=st.integers(0, 20), to=st.integers(-10, 110), ending=endings)
    def drag_tick(self, knot, to, ending):
        view = self.session.active_view
        if not view.is_current:
            return
        knot %= len(view.parameters)
        t = float(view.parameters[knot])
        self.tick = Hit(Part.TICK, view.owner(knot), (t, 0.0), knot=knot)
        selection = self.session.selected.state
        self.rail.press(Pointer((t, 0.0), (100 * t, 0.0)))
        pointer = Pointer((to / 100, 0.0), (float(to), 0.0))
        self.rail.move(pointer)
        self.end(self.rail, ending, pointer, selection)

    @rule(
        direction=st.sampled_from(["right", "left", "down"]),
        held=st.sampled_from([{"ctrl": True}, {}, {"shift": True}]),
        pause=st.sampled_from([0.0, 2.0]),
    )
    def nudge(self, direction, held, pause):
        self.now += pause
        self.tool.key(direction, Pointer((0.0, 0.0), (0.0, 0.0), scale=100.0, **held))
        # A quick one belongs to the step before, or takes it back.
        if pause == 0.0 and self.session.document != self.values[self.at]:
            index = self.session.undo_stack.index()
            if index <= self.at:
                assert "Nudge" in self.last_step
                self.values[self.at :] = [self.session.document] * (index == self.at)
                self.at = index
        self.note()

    # Edits from panels and menus

    def edit(self, make, *arguments):
        session, before = self.session, self.session.document
        change = session.change(
            make.__name__, lambda document: make(document, session.active_index, *arguments)
        )
        assert change.is_done == (session.document is not before)
        assert not (change.is_done and change.refusal)
        self.note()

    @rule(data=st.data())
    def select(self, data):
        count = len(self.session.active_curve.points)
        self.session.selected.set_points(
            data.draw(st.sets(st.integers(0, max(count - 1, 0)), max_size=count))
        )

    @rule()
    def select_all(self):
        self.session.selected.set_group(
            all_points(self.session.document, self.session.selected.active_curves)
        )

    @rule(curve=st.integers(0, 1))
    def activate(self, curve):
        self.session.selected.activate(curve)

    @rule(curves=st.sets(st.integers(0, 1)))
    def select_curves(self, curves):
        self.session.selected.set_curves(curves)

    @rule(edge=st.sampled_from(list(Edge)))
    def align(self, edge):
        group = self.session.selected.group
        self.edit(lambda document, _active: align_points(document, group, edge))

    @rule(axis=st.integers(0, 1))
    def distribute(self, axis):
        group = self.session.selected.group
        self.edit(lambda document, _active: distribute_points(document, group, axis))

    @rule(family=st.sampled_from(FAMILIES))
    def use_family(self, family):
        self.edit(rule_edits.set_family, family)

    @rule(kind=st.sampled_from(list(ParametrizationKind)))
    def use_parametrization(self, kind):
        view = self.session.active_view
        if view.is_current:
            self.edit(rule_edits.set_parametrization, kind, view.parameters.tolist())

    @rule(closed=st.booleans())
    def close(self, closed):
        self.edit(curve_edits.set_closed, closed)

    @rule(corner=st.booleans())
    def corner(self, corner):
        selected = self.session.selected.group.only_point
        if selected is None:
            return
        index = selected[1]
        if corner:
            self.edit(point_edits.make_corner, index, (1.0, 2.0), None)
        else:
            self.edit(point_edits.clear_derivatives, [index])

    @rule()
    def delete(self):
        session, chosen = self.session, self.session.selection
        document = point_edits.delete_points(session.document, session.active_index, chosen)
        session.selected.set_points([])
        session.commit(document, "Delete")
        self.note()


Gestures.TestCase.settings = settings(
    max_examples=60,
    stateful_step_count=40,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.filter_too_much],
)
TestGestures = Gestures.TestCase


def test_a_closed_curve_that_was_a_lagrange_curve_for_a_while_can_be_saved():
    # Frozen while it was open, its interval ended at the last point: no room to return to the first.
    document = rule_edits.set_family(Document((make_curve([(0, 0), (1, 2), (3, 2)]),)), 0, HERMITE)
    document = rule_edits.set_family(curve_edits.set_closed(document, 0, True), 0, LAGRANGE)
    document = rule_edits.freeze_parameters(document, 0, [0.0, 0.5, 1.0])
    assert document.curves[0].parametrization.end == 1.5
    validate(document)
    validate(point_edits.insert_points(document, 0, 3, [Point(4, 0, t=2.0)]))
