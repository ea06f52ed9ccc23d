"""Groups that are seen through as a whole: kept wherever their curves go, and with other names."""

import pytest
from msgspec.structs import replace

from app.document.curve_tree import tree_of
from app.document.edits import EditError
from app.document.group_look import GroupLook, opacity_of
from app.document.group_opacity import (
    opacities_of,
    with_overall_opacity,
    without_groups_seen_through,
)
from app.document.model import Document, make_curve
from app.document.several_curves import add_copies, add_curves, add_imported, remove_curves
from app.document.shape_edits import grouped, moved_into, named_anew, ungrouped
from app.document.shapes import shape_problem, tidy_shapes
from app.storage.format import FormatError, decode, encode


def curve(name, *groups, **values):
    model = make_curve([(0, 0), (1, 1)], name=name)
    return replace(model, groups=groups, **values)


def group(*opacities, names="ab", inner=()):
    """A document of curves in a group, of which a part is in another in it, then one in none."""
    curves = [curve(name, "G", *(("In",) if name in inner else ())) for name in names]
    document = tidy_shapes(Document((*curves, curve("z"))))
    for share, places in zip(
        opacities, (range(len(names)), [names.index(each) for each in inner]), strict=False
    ):
        document = tidy_shapes(with_overall_opacity(document, places, share))
    return document


def chains(document):
    return [tuple((look.name, look.opacity) for look in each.group_looks) for each in document.curves]


def test_the_opacity_of_what_is_chosen_is_that_of_whole_groups_and_of_shapes_beside_them():
    document = group(0.5)
    assert chains(document) == [(("G", 0.5),), (("G", 0.5),), ()]
    assert [each.style.opacity for each in document.curves] == [1, 1, 1]
    assert opacities_of(document, range(3)) == [0.5, 1.0]
    part = with_overall_opacity(document, [0], 0.25)
    assert (part.curves[0].style.opacity, chains(part)) == (0.25, chains(document))
    both = tidy_shapes(with_overall_opacity(document, range(3), 0.75))
    assert (chains(both)[0], both.curves[2].style.opacity) == ((("G", 0.75),), 0.75)
    assert chains(tidy_shapes(with_overall_opacity(document, range(3), 1.0))) == [(), (), ()]


def test_groups_within_each_other_have_opacities_of_their_own_from_the_outermost():
    document = group(0.5, 0.25, names="abc", inner="bc")
    both = (("G", 0.5), ("In", 0.25))
    assert chains(document) == [(("G", 0.5),), both, both, ()]
    flat = without_groups_seen_through(document)
    assert [each.style.opacity for each in flat.curves] == [0.5, 0.125, 0.125, 1.0]
    assert not any(chains(flat))


def test_files_keep_it_and_old_ones_have_none():
    document = group(0.5, 0.25, names="abc", inner="bc")
    assert decode(encode(document)) == document
    assert b"group_looks" not in encode(group())


@pytest.mark.parametrize(
    "looks",
    [(GroupLook("G", 0.4),), (GroupLook("Other", 0.5),), (GroupLook("G", 1.0),)],
    ids=["unlike the others", "of no group of its own", "as usual"],
)
def test_files_in_which_it_is_said_otherwise_are_refused_with_the_place(looks):
    document = group(0.5) if looks[0].opacity == 0.4 else group()
    wrong = document.with_curve(1, replace(document.curves[1], group_looks=looks))
    assert "curves[1].group_looks" in shape_problem(wrong)
    with pytest.raises(FormatError, match=r"curves\[1\]\.group_looks"):
        encode(wrong)


def test_copies_pastes_and_imports_of_a_group_are_seen_as_much_under_their_own_names():
    document = group(0.5)
    copied = tidy_shapes(add_copies(document, [0, 1]).document)
    assert chains(copied) == [(("G", 0.5),)] * 2 + [(("G copy", 0.5),)] * 2 + [()]
    pasted = tidy_shapes(add_curves(document, document.curves[:2], 3))
    assert chains(pasted)[3:] == [(("G copy", 0.5),)] * 2
    imported, _ = add_imported(group(), document)
    assert [share for chain in chains(tidy_shapes(imported)) for _, share in chain] == [0.5, 0.5]


def test_what_comes_into_a_group_and_what_leaves_it_is_seen_as_that_is():
    document = group(0.5)
    in_front = tidy_shapes(moved_into(document, [2], 0, tree_of(document.curves)[0].inside).document)
    assert chains(in_front) == [(("G", 0.5),)] * 3
    out = tidy_shapes(moved_into(in_front, [0], 3).document)
    assert chains(out) == chains(document)
    assert chains(tidy_shapes(remove_curves(document, [0]))) == [(("G", 0.5),), ()]


def test_a_group_that_is_torn_apart_is_seen_as_much_in_all_its_parts():
    document = group(0.5, names="abc")
    curves = document.curves
    torn = tidy_shapes(replace(document, curves=(curves[0], curves[3], *curves[1:3])))
    assert chains(torn) == [(("G", 0.5),), (), (("G 2", 0.5),), (("G 2", 0.5),)]


def test_taken_apart_each_part_is_seen_as_much_as_it_was_and_grouped_anew_the_group_has_none():
    document = group(0.5, 0.25, names="abc", inner="bc")
    apart = tidy_shapes(ungrouped(document, range(3)))
    assert chains(apart) == [(), (("In", 0.125),), (("In", 0.125),), ()]
    assert [each.style.opacity for each in apart.curves] == [0.5, 1, 1, 1]
    again = tidy_shapes(grouped(apart, range(3)).document)
    assert chains(again) == chains(apart)


def test_a_group_that_is_named_anew_is_seen_as_much():
    document = group(0.5)
    named = named_anew(document, tree_of(document.curves)[0], "Leaf")
    assert chains(tidy_shapes(named)) == [(("Leaf", 0.5),)] * 2 + [()]
    with pytest.raises(EditError):
        named_anew(document, tree_of(document.curves)[0], "")


def test_a_layer_keeps_it_while_it_is_empty():
    document = tidy_shapes(replace(group(0.5), layers=("G",)))
    assert opacities_of(document, range(2)) == [1.0, 1.0]
    emptied = tidy_shapes(remove_curves(document, [0, 1]), document)
    assert [(each.name, each.opacity) for each in emptied.empty_layers] == [("G", 0.5)]
    filled = replace(emptied, curves=(curve("new", "G"), *emptied.curves))
    assert opacity_of(tidy_shapes(filled, emptied).curves[0].group_looks, "G") == 0.5
