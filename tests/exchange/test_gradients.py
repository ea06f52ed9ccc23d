"""Gradients and patterns of SVG come in as one colour each, and that is told."""

import pytest

from app.exchange.svg.reader import read_svg
from tests.rows import each_row

STOPS = '<stop stop-color="red"/><stop offset="1" stop-color="blue" stop-opacity=".5"/>'


def fill_of(body):
    """Colour and opacity of the fill of a drawing's only shape; what is told."""
    found = read_svg(f'<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9">{body}</svg>'.encode())
    (curve,) = found.document.curves
    return (curve.style.fill, curve.style.fill_opacity), found.remarks


def gradient(stops, kind="linearGradient", paint="url(#g)"):
    return fill_of(f'<{kind} id="g">{stops}</{kind}><rect width="9" height="9" fill="{paint}"/>')


@pytest.mark.parametrize("kind", ["linearGradient", "radialGradient"])
def test_a_gradient_becomes_its_mean_colour(kind):
    """Two parts of red that is seen whole, one of blue that is half seen."""
    (colour, opacity), (sentence,) = gradient(STOPS, kind)
    assert (colour, opacity) == ("#aa0055", 0.75)
    assert sentence == "1 gradient imported as one colour."


@each_row(
    ("stops", "paint"),
    [
        # A tenth of white into black, and nine tenths of black.
        ('<stop stop-color="#fff"/><stop offset=".1"/><stop offset="1"/>', ("#0d0d0d", 1.0)),
        # White up to the middle, and from there to black: three quarters.
        ('<stop offset="50%" stop-color="#fff"/><stop offset="1"/>', ("#bfbfbf", 1.0)),
        # An offset before that of an earlier stop counts as the same: half red, half blue.
        ('<stop offset=".5" stop-color="red"/><stop offset=".2" stop-color="blue"/>', ("#800080", 1.0)),
        # Of what is not seen at all it is the plain mean.
        ('<stop stop-color="red" stop-opacity="0"/><stop offset="1" stop-opacity="0"/>', ("#800000", 0.0)),
        # No stops paint nothing, and one is a colour; so are several of one colour.
        ("", ("none", 1.0)),
        ('<stop stop-color="red" stop-opacity=".5"/>', ("#ff0000", 0.5)),
        ('<stop stop-color="red"/><stop offset="1" stop-color="red"/>', ("#ff0000", 1.0)),
    ],
)
def test_stops_count_by_their_extent(stops, paint):
    if paint[0] == "none":
        body = f'<linearGradient id="g">{stops}</linearGradient>'
        shape = '<rect width="9" height="9" fill="url(#g)" stroke="red"/>'
        assert fill_of(body + shape)[0] == paint
    else:
        assert gradient(stops)[0] == paint


def test_a_gradient_of_one_colour_gives_no_remark():
    assert gradient('<stop stop-color="red"/><stop offset="1" stop-color="red"/>')[1] == ()


def test_a_gradient_inherits_stops_from_another():
    chain = '<linearGradient id="a" href="#b"/><radialGradient id="b" href="#a">{}</radialGradient>'
    rect = '<rect width="9" height="9" fill="url(#a)" fill-opacity=".5" color="red"/>'
    assert fill_of(chain.format(STOPS) + rect)[0] == ("#aa0055", 0.375)
    ink = '<stop stop-color="currentColor"/><stop offset="1" stop-color="currentColor"/>'
    assert fill_of(chain.format(ink) + rect)[0] == ("#ff0000", 0.5)
    # Two that refer to each other, and have no stops.
    assert fill_of(chain.format("") + rect.replace("<rect", '<rect stroke="red"'))[0][0] == "none"


@pytest.mark.parametrize(
    ("body", "paint", "colour"),
    [
        ('<rect fill="red"/><rect fill="#0000ff"/>', "url(#g)", "#800080"),
        ('<rect fill="red"/>', "url(#g) lime", "#ff0000"),
        ("<image/>", "url(#g) lime", "#00ff00"),
    ],
)
def test_a_pattern_becomes_the_mean_of_its_colours_or_the_fallback(body, paint, colour):
    (found, _), sentences = gradient(body, "pattern", paint)
    assert found == colour
    assert sentences == ("1 pattern imported as one colour.",)


def test_gradients_are_counted_and_their_shapes_named():
    rects = "".join(f'<rect id="{id}" width="9" height="9" fill="url(#g)"/>' for id in "ab")
    text = f'<linearGradient id="g">{STOPS}</linearGradient>{rects}'
    found = read_svg(f'<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9">{text}</svg>'.encode())
    assert found.remarks == ("2 gradients imported as one colour: a and b.",)
