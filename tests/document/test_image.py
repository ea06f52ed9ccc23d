"""The picture to trace in the document, its file and its edits."""

from __future__ import annotations

import math

import pytest
from msgspec.structs import replace

from app.document import curve_edits, point_edits, rule_edits
from app.document.group_edits import move_into
from app.document.limits import EditError
from app.document.model import Document, ReferenceImage, empty_document, make_curve
from app.document.plane_edits import (
    move_image,
    place_image,
    scale_image,
    set_image,
    set_image_file,
    set_image_opacity,
)
from app.families import HERMITE
from app.storage.files import load, save
from app.storage.format import decode, encode
from app.storage.format_error import FormatError
from tests.rows import each_row

IMAGE = ReferenceImage("letters/s.png", 0.1, -1 / 3, 3.0, 4.0, 0.25, True)


def with_image(**changed):
    return Document((make_curve([(0, 0), (1, 2)]),), replace(IMAGE, **changed))


@pytest.mark.parametrize(
    "document",
    [with_image(), with_image(path="Größe ‖c′‖.jpg"), with_image(opacity=0.0, locked=False, x=-1e12)],
)
def test_a_reference_image_survives_saving(document):
    assert decode(encode(document)) == document


def test_a_document_without_an_image_has_no_image_key():
    assert b"image" not in encode(empty_document())


def test_the_image_is_on_one_line_of_the_file():
    line = (
        '  "image": {"path": "letters/s.png", "x": 0.1, "y": -0.3333333333333333, '
        '"width": 3.0, "height": 4.0, "opacity": 0.25, "locked": true},\n'
    )
    assert line in encode(with_image()).decode()


@each_row(
    ("changed", "message"),
    [
        ({"x": math.nan}, "image.x must lie between"),
        ({"y": 2e12}, "image.y must lie between"),
        ({"width": 0.0}, "image.width must be greater than 0, not 0.0"),
        ({"height": -1.0}, "image.height must be greater than 0"),
        ({"opacity": 1.5}, "image.opacity must lie between 0 and 1, not 1.5"),
        ({"opacity": math.nan}, "image.opacity must lie between"),
        ({"path": ""}, "image.path must be the name of a file"),
        ({"path": "a\0b.png"}, "image.path must be the name of a file"),
        ({"path": "\ud800.png"}, "image.path must be the name of a file"),
        ({"path": "//elsewhere/share/a.png"}, "image.path must be the path of a file on this computer"),
        ({"path": "\\\\elsewhere\\share\\a.png"}, "image.path must be the path of a file on this computer"),
    ],
)
def test_invalid_images_are_refused(changed, message):
    with pytest.raises(FormatError) as refusal:
        encode(with_image(**changed))
    assert str(refusal.value).startswith(message)


@each_row(
    ("old", "new", "message"),
    [
        (b'"width": 3.0', b'"width": "3"', "image.width must be a number, not text"),
        (b'"locked": true', b'"locked": 1', "image.locked must be true or false"),
        (b'"opacity": 0.25', b'"opacty": 0.25', "image has a key that this version does not know"),
        (b'"path": "letters/s.png", ', b"", "image.path is missing"),
        (b'"x": 0.1', b'"x": 1e999', "image.x must lie between"),
    ],
)
def test_an_invalid_image_in_a_file_is_refused_with_its_field(old, new, message):
    data = encode(with_image())
    assert old in data
    with pytest.raises(FormatError) as refusal:
        decode(data.replace(old, new))
    assert str(refusal.value).startswith(message)


def test_the_path_is_relative_to_the_document(tmp_path):
    picture = tmp_path / "pictures" / "s.png"
    here, there = tmp_path / "a.curve.json", tmp_path / "deep" / "er" / "b.curve.json"
    there.parent.mkdir(parents=True)
    document = with_image(path=str(picture))
    save(here, document)
    assert b'"path": "pictures/s.png"' in here.read_bytes()
    save(there, document)
    assert b'"path": "../../pictures/s.png"' in there.read_bytes()
    assert load(here) == load(there) == document


def test_edits_of_curves_keep_the_image():
    document = with_image()
    changed = [
        curve_edits.add_curve(document, 0, make_curve([(5, 5)])),
        curve_edits.remove_curve(document, 0),
        point_edits.move_points(document, 0, {0}, (1, 1)),
        rule_edits.set_family(document, 0, HERMITE),
        move_into(curve_edits.add_curve(document, 0, make_curve(())), {0}, 2).document,
    ]
    assert all(each.image == document.image for each in changed)


def test_moving_and_scaling():
    document = set_image(empty_document(), ReferenceImage("a.png", 1.0, 2.0, 4.0, 3.0))
    assert move_image(document, (0.5, -1.0)).image == ReferenceImage("a.png", 1.5, 1.0, 4.0, 3.0)
    # The upper right corner, (5, 5), stays.
    assert scale_image(document, (1, 1), 0.5).image == ReferenceImage("a.png", 3.0, 3.5, 2.0, 1.5)
    assert scale_image(document, (0, 0), 2.0).image == ReferenceImage("a.png", 1.0, 2.0, 8.0, 6.0)


def test_another_image_file_keeps_the_width_and_has_its_own_aspect():
    document = set_image(empty_document(), ReferenceImage("a.png", 1.0, 2.0, 4.0, 3.0))
    assert set_image_file(document, "b.png", 2.0).image == ReferenceImage("b.png", 1.0, 2.0, 4.0, 2.0)


def test_edits_refuse_images_that_no_file_may_hold():
    document = set_image(empty_document(), ReferenceImage("a.png", 1.0, 2.0, 4.0, 3.0))
    for bad in (
        lambda: move_image(document, (2e12, 0)),
        lambda: place_image(document, (0, 0), 0.0),
        lambda: place_image(document, (0, 0), -1.0),
        lambda: place_image(document, (0, 0), math.nan),
        lambda: place_image(document, (0, 0), 1e13),
        lambda: set_image_file(document, "b.png", 1e-12),
        lambda: set_image_file(document, "b.png", 1e10),
        lambda: set_image_file(document, "b.png", 0.0),
        lambda: set_image_file(document, "b.png", math.nan),
        lambda: set_image_opacity(document, 1.01),
        lambda: set_image_opacity(document, math.nan),
        lambda: move_image(empty_document(), (1, 1)),
    ):
        with pytest.raises(EditError):
            bad()
