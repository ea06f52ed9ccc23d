"""Shapes and groups made, taken apart, named and moved."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from msgspec.structs import replace

from app.document.group_edits import (
    break_apart,
    combine,
    group_curves,
    groups_to_ungroup,
    move_into,
    order_after_step,
    order_at_end,
    pressed_curves,
    rename_node,
    ungroup,
)
from app.document.groups import Container, NodeKind, curve_tree, shape_problem, tidy_shapes, whole_nodes
from app.document.limits import EditError
from app.document.model import Document, make_curve
from app.document.selection import SelectionState
from app.document.several_curves import (
    add_curves,
    add_imported,
    duplicate_curves,
    name_or_count,
    reorder_curves,
)
from app.document.style import FillRule, Style
from tests.rows import each_row


def document(text):
    """Curves a, b, c …; round brackets are shapes, square ones are groups, named by their order."""
    curves, groups, shape, shapes, count = [], [], "", 0, 0
    for letter in text:
        if letter == "[":
            count += 1
            groups.append(f"G{count}")
        elif letter == "]":
            groups.pop()
        elif letter == "(":
            shapes += 1
            shape = f"S{shapes}"
        elif letter == ")":
            shape = ""
        else:
            curve = make_curve([(0, 0), (1, 1)], name=letter)
            curves.append(replace(curve, shape=shape, groups=tuple(groups)))
    made = Document(tuple(curves))
    assert shape_problem(made) == ""
    return made


def text(document):
    """The same the other way round, without the names of shapes and groups."""

    def of(node):
        inside = "".join(of(part) for part in node.children)
        return {NodeKind.CURVE: node.name, NodeKind.SHAPE: f"({inside})", NodeKind.GROUP: f"[{inside}]"}[
            node.kind
        ]

    tidy = tidy_shapes(document)
    assert shape_problem(tidy) == ""
    return "".join(map(of, curve_tree(tidy.curves)))


def indices_of(document, letters):
    return {place for place, curve in enumerate(document.curves) if curve.name in letters}


def selected_names(made):
    return "".join(made.document.curves[place].name for place in made.indices)


@each_row("drawn", ["abc", "a(bc)d", "[ab]c", "[a(bc)[de]]f(gh)", "[[ab]]"])
def test_the_tree_has_the_nodes_of_the_brackets(drawn):
    assert text(document(drawn)) == drawn


@each_row(
    ("drawn", "chosen", "made"),
    [
        ("abc", "ab", "(ab)c"),
        ("abc", "ac", "b(ac)"),
        ("a(bc)d", "ab", "(abc)d"),
        ("a[bc]d", "ab", "[(ab)c]d"),
        ("[ab]c", "bc", "[a](bc)"),
        ("(ab)(cd)", "ad", "(abcd)"),
    ],
)
def test_combined_curves_are_neighbours_at_the_topmost_index(drawn, chosen, made):
    some = document(drawn)
    assert text(combine(some, indices_of(some, chosen)).document) == made


def test_a_combined_shape_has_the_style_of_its_hindmost_filled_curve():
    some = document("abc")
    some = some.with_curve(1, replace(some.curves[1], style=Style(stroke="none", fill="#aa0000")))
    made = combine(some, {0, 1, 2}, alternate=True)
    assert {curve.style for curve in made.document.curves} == {
        Style(stroke="none", fill="#aa0000", fill_rule=FillRule.EVENODD)
    }
    assert made.indices == range(3)
    with pytest.raises(EditError, match="two or more curves"):
        combine(some, {1})


def test_breaking_a_shape_apart_keeps_curves_and_order():
    some = document("a(bc)[(de)f]")
    assert text(break_apart(some, indices_of(some, "bd"))) == "abc[def]"
    with pytest.raises(EditError, match="break it apart"):
        break_apart(some, indices_of(some, "a"))


@each_row(
    ("drawn", "chosen", "made"),
    [
        ("abc", "ac", "b[ac]"),
        ("a(bc)d", "ab", "[a(bc)]d"),
        ("[abc]d", "ab", "[[ab]c]d"),
        ("[ab]c[de]", "abd", "c[e][[ab]d]"),
        ("a[bc]", "ab", "[c][ab]"),
        ("[ab]", "ab", "[[ab]]"),
        ("[[ab]c]", "ab", "[[[ab]]c]"),
    ],
)
def test_grouped_curves_are_moved_into_their_common_group(drawn, chosen, made):
    some = document(drawn)
    result = group_curves(some, indices_of(some, chosen))
    assert text(result.document) == made
    assert set(selected_names(result)) == {
        curve.name for place, curve in enumerate(result.document.curves) if place in result.indices
    }


@each_row(
    ("drawn", "chosen", "made"),
    [
        ("[ab]c", "ab", "abc"),
        ("[ab]c", "a", "abc"),
        ("[[ab]c]d", "abc", "[ab]cd"),
        ("[[ab]c]d", "a", "[abc]d"),
        ("[ab][c(de)]", "abcde", "abc(de)"),
    ],
)
def test_ungrouping_removes_one_level(drawn, chosen, made):
    some = document(drawn)
    assert text(ungroup(some, indices_of(some, chosen))) == made


def test_ungrouping_without_a_group_is_refused():
    some = document("a(bc)")
    assert groups_to_ungroup(some, {0, 1}) == []
    with pytest.raises(EditError, match="Select a group"):
        ungroup(some, {0, 1})


@each_row(
    ("drawn", "chosen", "step", "made"),
    [
        ("a(bc)d", "a", 1, "(bc)ad"),
        ("a(bc)d", "b", 1, "ad(bc)"),
        ("a(bc)d", "d", -1, "ad(bc)"),
        ("a[bc]d", "a", 1, "[bc]ad"),
        ("a[bc]d", "b", 1, "a[cb]d"),
        ("a[bc]d", "c", 1, "a[bc]d"),
        ("a[bc]d", "bc", -1, "[bc]ad"),
        ("a[b(cd)]", "c", -1, "a[(cd)b]"),
    ],
)
def test_a_step_passes_the_next_node_of_the_same_group(drawn, chosen, step, made):
    some = document(drawn)
    assert text(reorder_curves(some, order_after_step(some, indices_of(some, chosen), step))) == made


@each_row(
    ("drawn", "chosen", "end", "made"),
    [
        ("abcde", "bd", 1, "acebd"),
        ("abcde", "bd", -1, "bdace"),
        ("a(bc)de", "b", 1, "ade(bc)"),
        ("a[bcd]e", "b", 1, "a[cdb]e"),
        ("a[b(cd)]e", "ec", -1, "ea[(cd)b]"),
    ],
)
def test_moving_to_an_end_stays_in_the_same_group(drawn, chosen, end, made):
    some = document(drawn)
    assert text(reorder_curves(some, order_at_end(some, indices_of(some, chosen), end))) == made


@each_row(
    ("drawn", "chosen", "at", "container", "made"),
    [
        ("a(bc)", "a", 3, Container((), "S1"), "(bca)"),
        ("a(bcd)", "c", 0, Container(), "ca(bd)"),
        ("a(bc)", "c", 0, Container(), "cab"),
        ("a[bc]", "a", 2, Container(("G1",)), "[bac]"),
        ("a[b(cd)]", "cd", 0, Container(), "(cd)a[b]"),
        ("[ab][cd]", "ab", 3, Container(("G2",)), "[c[ab]d]"),
        ("[ab](cd)", "ab", 3, Container((), "S1"), "(cabd)"),
    ],
)
def test_moved_curves_are_in_their_new_container(drawn, chosen, at, container, made):
    some = document(drawn)
    assert text(move_into(some, indices_of(some, chosen), at, container).document) == made


def test_a_curve_moved_into_a_shape_gets_its_style():
    some = document("a(bc)")
    red = tuple(replace(curve, style=Style(fill="#ff0000"), visible=False) for curve in some.curves[1:])
    made = move_into(Document((some.curves[0], *red)), {0}, 1, Container((), "S1")).document
    assert {(curve.style.fill, curve.visible) for curve in made.curves} == {("#ff0000", False)}


def test_moving_a_node_into_itself_is_refused():
    some = document("a[bc]")
    with pytest.raises(EditError, match="into itself"):
        move_into(some, {1, 2}, 2, Container(("G1",)))


@each_row(
    ("drawn", "pressed_at", "active", "chosen", "meant"),
    [
        ("a(bc)", "b", "a", "a", "bc"),
        ("a[b(cd)]", "c", "a", "a", "bcd"),
        ("a[b(cd)]", "c", "b", "b", "cd"),
        ("a[b(cd)]", "c", "b", "bcd", "bcd"),
        ("a[b[cd]]", "c", "b", "b", "cd"),
        ("a[b[cd]]", "c", "d", "d", "c"),
        ("a[b[cd]]", "b", "d", "d", "b"),
    ],
)
def test_a_press_selects_the_outermost_group_that_is_not_entered(drawn, pressed_at, active, chosen, meant):
    some = document(drawn)
    (curve,), (edited,) = indices_of(some, pressed_at), indices_of(some, active)
    whole = frozenset(indices_of(some, chosen))
    choice = SelectionState(
        edited, frozenset(), whole, whole if len(whole) > 1 else frozenset(), is_editing=True
    )
    assert pressed_curves(some, curve, choice) == indices_of(some, meant)
    # While nothing is edited, it is what is chosen that tells which groups are entered.
    choosing = SelectionState(edited, frozenset(), whole, whole, is_editing=False)
    assert pressed_curves(some, curve, choosing) == indices_of(some, meant)
    none = SelectionState(edited, frozenset(), frozenset({edited}), frozenset(), is_editing=False)
    assert pressed_curves(some, curve, none) in [set(node.indices) for node in curve_tree(some.curves)]


def test_copies_of_shapes_and_groups_get_new_names():
    some = document("(ab)[cd]")
    copied = duplicate_curves(some, {0, 1}).document
    assert text(copied).replace("a copy", "A").replace("b copy", "B") == "(ab)(AB)[cd]"
    assert [curve.shape for curve in copied.curves[2:4]] == ["S1 copy", "S1 copy"]
    inside = duplicate_curves(some, {2}).document
    assert [curve.groups for curve in inside.curves[2:]] == [("G1",)] * 3
    whole = duplicate_curves(some, {2, 3}).document
    assert [curve.groups for curve in whole.curves[2:]] == [("G1",), ("G1",), ("G1 copy",), ("G1 copy",)]
    # Each stays in the group of its original, whatever else is copied with it.
    some = document("a[bc][d(ef)]g")
    each = duplicate_curves(some, {0, 1, 3, 4})
    assert text(each.document).replace(" copy", "'") == "aa'[bb'c][d(ef)d'e']g"
    assert [each.document.curves[place].name for place in each.indices] == [f"{name} copy" for name in "abde"]
    some = document("(ab)[cd]")
    pasted = add_curves(some, some.curves, 4)
    assert [curve.shape for curve in pasted.curves] == ["S1", "S1", "", "", "S1 copy", "S1 copy", "", ""]


def test_imported_shapes_get_unused_names():
    some = document("(ab)")
    both, first = add_imported(some, some)
    assert (first, [curve.shape for curve in both.curves]) == (2, ["S1", "S1", "S1 copy", "S1 copy"])


def test_shapes_and_groups_are_renamed():
    some = document("(ab)[c[de]]")
    shape, group = curve_tree(some.curves)
    assert {curve.shape for curve in rename_node(some, shape, " R ").curves} == {"R", ""}
    inner = group.children[1]
    assert rename_node(some, inner, "Leaves").curves[3].groups == ("G1", "Leaves")
    assert rename_node(some, inner, "G2") is some
    with pytest.raises(EditError, match="needs a name"):
        rename_node(some, shape, "  ")
    with pytest.raises(EditError, match="Another shape or group"):
        rename_node(some, shape, "G2")


def test_whole_shapes_and_groups_are_named():
    some = document("a(bc)[de]")
    assert [name_or_count(some, indices_of(some, each)) for each in ("a", "bc", "de", "ab", "bcde")] == [
        "a",
        "S1",
        "G1",
        "2 curves",
        "1 group and 1 shape",
    ]


def test_torn_groups_become_two_and_deep_groups_are_limited():
    some = document("[ab]")
    torn = Document((some.curves[0], make_curve(()), some.curves[1]))
    assert [curve.groups for curve in tidy_shapes(torn).curves] == [("G1",), (), ("G1 2",)]
    assert shape_problem(torn).startswith("curves[2].groups must name 50 groups at most, each of curves")
    deep = Document((replace(some.curves[0], groups=("x",) * 99),))
    assert len(tidy_shapes(deep).curves[0].groups) == 50


@given(st.lists(st.tuples(st.sampled_from("abc"), st.lists(st.sampled_from("gh"), max_size=3)), min_size=1))
def test_a_tidy_document_is_returned_unchanged(given_curves):
    curves = [
        replace(make_curve(()), shape=shape.replace("c", ""), groups=tuple(groups))
        for shape, groups in given_curves
    ]
    tidy = tidy_shapes(Document(tuple(curves)))
    assert tidy_shapes(tidy) is tidy
    assert tidy_shapes(tidy, tidy) is tidy
    for kind in (NodeKind.SHAPE, NodeKind.GROUP):
        names = [node.name for top in curve_tree(tidy.curves) for node in top.walk() if node.kind is kind]
        assert len(set(names)) == len(names)
    assert [node.indices for node in whole_nodes(tidy.curves, range(len(tidy.curves)))] == [
        node.indices for node in curve_tree(tidy.curves)
    ]
