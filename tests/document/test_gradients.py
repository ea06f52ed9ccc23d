"""Gradients lie in the plane: they go with their shapes through every transform, and with nothing less."""

import pytest
from msgspec.structs import replace

from app.document.curve_edits import fresh_curve
from app.document.gradient import Gradient, GradientKind, Stop
from app.document.model import Document, Parametrization, make_curve
from app.document.point_group import points_of
from app.document.several_curves import mapped, moved, stepped, whole_curves
from app.document.style import NO_PAINT, Style
from app.document.style_edits import with_style
from app.document.transforms import flipping, rotation, scaling, skewing
from app.storage.format import decode, encode
from app.storage.format_error import FormatError

STOPS = (Stop(0.0, "#ff0000"), Stop(1.0, "#0000ff", 0.5))
GRADIENT = Gradient(STOPS, GradientKind.RADIAL, (1.0, 1.0), (3.0, 1.5), (0.5, 2.0), focus=(1.5, 1.25))
PLACES = ((0.0, 0.0), (1.0, 2.0), (-3.0, 0.25))
STYLE = Style().with_gradient("fill", GRADIENT).with_gradient("stroke", replace(GRADIENT, focus=None))


def drawn(**fields):
    curve = make_curve(((0.0, 0.0), (4.0, 1.0), (2.0, 3.0)))
    return replace(curve, style=STYLE, **fields)


AFFINE = {
    "rotation": rotation(30.0, (1.0, 2.0)),
    "scaling": scaling(2.0, 0.5, (3.0, 0.0)),
    "flip": flipping(0, (1.0, 1.0)),
    "skew": skewing(1, 20.0, (0.0, 1.0)),
}
WAYS = {
    "move": (moved, (0.5, -2.0), lambda place: (place[0] + 0.5, place[1] - 2.0)),
    "step": (stepped, (0.1, 0.2), lambda place: (place[0] + 0.1, place[1] + 0.2)),
    **{name: (mapped, by, by.point) for name, by in AFFINE.items()},
}


@pytest.mark.parametrize("way", WAYS)
def test_every_place_keeps_its_colour(way):
    edit, by, place = WAYS[way]
    document = Document((drawn(),))
    (curve,) = edit(document, whole_curves(document, [0]), by).curves
    for name, old in STYLE.gradients.items():
        new = curve.style.gradients[name]
        for each in PLACES:
            assert new.coordinates(place(each)) == pytest.approx(old.coordinates(each), abs=1e-12)
        if old.focus is not None:
            assert new.coordinates(new.focus) == pytest.approx(old.coordinates(old.focus), abs=1e-12)


def test_points_of_a_shape_that_are_not_all_of_it_leave_it_where_it_is():
    document = Document((drawn(),))
    assert moved(document, points_of(0, [0, 1]), (1.0, 1.0)).curves[0].style == STYLE
    two = Document((drawn(name="a", shape="O"), drawn(name="b", shape="O")))
    assert moved(two, whole_curves(two, [0]), (1.0, 1.0)).curves[1].style == STYLE
    assert moved(two, whole_curves(two, [0, 1]), (1.0, 1.0)).curves[1].style.fill_gradient.start == (2.0, 2.0)


def test_a_colour_takes_the_place_of_a_gradient_and_stands_for_it():
    assert STYLE.fill == "#aa0055"  # two parts of red that is seen whole, one of blue that is half seen
    document = Document((drawn(),))
    (flat,) = with_style(document, [0], fill="#00ff00").curves
    assert (flat.style.fill, flat.style.fill_gradient) == ("#00ff00", None)
    assert flat.style.stroke_gradient == STYLE.stroke_gradient
    assert not with_style(document, [0], fill=NO_PAINT).curves[0].style.has_fill
    assert flat.style.in_colour("#123456").gradients == {}
    # What is drawn next lies elsewhere.
    assert fresh_curve(document, drawn(), Parametrization()).style == Style(fill="#ff0000", stroke="#ff0000")


@pytest.mark.parametrize(
    ("stops", "sentence"),
    [
        (STOPS[:1], "must hold at least 2 stops, not 1"),
        (STOPS[::-1], "must hold stops in the order of their offsets, not [1.0, 0.0]"),
        ((replace(STOPS[0], colour="red"), STOPS[1]), '[0].colour must be written as "#rrggbb"'),
    ],
)
def test_files_hold_gradients_and_refuse_others_with_the_place(stops, sentence):
    document = Document((drawn(),))
    assert decode(encode(document)) == document
    assert b"fill_gradient" in encode(document)
    assert b"gradient" not in encode(Document((replace(drawn(), style=Style()),)))
    wrong = replace(drawn(), style=Style(fill="#ff0000", fill_gradient=replace(GRADIENT, stops=stops)))
    with pytest.raises(FormatError, match=r"^curves\[0\]\.style\.fill_gradient\.stops") as refusal:
        encode(Document((wrong,)))
    assert sentence in str(refusal.value)
