"""Groups that are seen through as a whole: read from SVG, written, written in place, and printed."""

import shutil
import subprocess

import pytest
from PySide6.QtGui import QImage, QPainter

from app.document.group_opacity import opacities_of, with_overall_opacity
from app.document.shapes import tidy_shapes
from app.exchange.formats.latex import tikz_picture
from app.exchange.formats.pictures import read
from app.exchange.options import Options
from app.exchange.svg.reader import read_svg
from app.exchange.svg.writer import svg_of
from app.exchange.writing import export
from tests.exchange.test_svg_round_trip import beyond_a_pixel, pixels

pytestmark = pytest.mark.usefixtures("qapp")

SQUARES = (
    '<path id="a{0}" fill="#c03030" d="M{1} 5h25v25h-25z"/>'
    '<path id="b{0}" fill="#3030c0" d="M{2} 15h25v25h-25z"/>'
)
HEAD = 'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"'
WIDTH = 300


def squares(number, x):
    """Two filled squares that overlap."""
    return SQUARES.format(number, x, x + 10)


def svg(body):
    return f'<svg {HEAD} width="100px" height="50px">{body}</svg>'.encode()


NESTED = svg(
    f'<g id="outer" opacity="0.5">{squares(1, 5)}'
    f'<g id="inner" style="opacity:.4"><circle id="c" cx="60" cy="25" r="15"/>{squares(2, 62)}</g></g>'
    '<path id="line" stroke="#208020" stroke-width="4" d="M0 25H100"/>'
)
USED = svg(
    f'<defs><g id="leaf" opacity="0.8">{squares(1, 5)}</g></defs>'
    '<use id="one" xlink:href="#leaf" opacity="0.5"/><use id="two" xlink:href="#leaf" x="50"/>'
)


def chains(document):
    return [tuple((look.name, look.opacity) for look in each.group_looks) for each in document.curves]


def test_groups_come_in_with_their_opacities_and_nothing_is_told():
    found = read_svg(NESTED)
    outer, both = (("outer", 0.5),), (("outer", 0.5), ("inner", 0.4))
    assert chains(found.document) == [outer, outer, both, both, both, ()]
    assert {each.style.opacity for each in found.document.curves} == {1.0}
    assert found.sentences == ()


def test_what_uses_a_group_is_one_that_is_seen_as_little_as_both():
    document = read_svg(USED).document
    assert chains(document) == [(("one", 0.4),)] * 2 + [(("two", 0.8),)] * 2


@pytest.mark.parametrize(
    "around",
    ['<g opacity="0.5">{}</g>', '<g><a opacity="0.5">{}</a></g>', '<switch opacity="0.5">{}</switch>'],
)
def test_the_opacity_of_what_no_document_has_as_a_group_is_that_of_the_shape(around):
    (curve,) = read_svg(svg(around.format('<path id="a" opacity="0.5" d="M0 0H9V9Z"/>'))).document.curves
    assert (curve.style.opacity, curve.group_looks) == (0.25, ())


def test_all_that_is_in_a_file_which_is_seen_through_is_told():
    data = NESTED.replace(b"<svg ", b'<svg opacity="0.5" ')
    assert read_svg(data).sentences == (
        "<svg> (element 1): it is transparent as a whole; each of its shapes is.",
    )


@pytest.mark.parametrize("data", [NESTED, USED], ids=["nested", "used"])
def test_written_out_and_read_again_they_are_seen_as_much(data):
    document = read_svg(data).document
    written = svg_of(document, Options(unit=document.unit))
    assert chains(read_svg(written.data).document) == chains(document)


@pytest.mark.skipif(shutil.which("rsvg-convert") is None, reason="librsvg is not installed")
@pytest.mark.parametrize("data", [NESTED, USED], ids=["nested", "used"])
@pytest.mark.parametrize("ending", ["png", "pdf", "svg"])
def test_librsvg_draws_the_file_as_we_do(data, ending, tmp_path):
    """By eight levels: where what overlaps showed it would be sixty."""
    (tmp_path / "theirs.svg").write_bytes(data)
    theirs = by_librsvg(tmp_path / "theirs.svg")
    document, ours = read_svg(data).document, tmp_path / f"ours.{ending}"
    export(document, ours, Options(width=WIDTH, transparent=ending == "png"))
    if ending == "pdf":
        if shutil.which("gs") is None:
            pytest.skip("Ghostscript is not installed")
        seen = by_ghostscript(ours)
    elif ending == "svg":
        seen = by_librsvg(ours)
    else:
        seen = pixels(on_white(QImage(str(ours))))
    assert (theirs != 255).any(axis=-1).sum() > 2000
    away = beyond_a_pixel(seen, theirs[: len(seen)])
    assert away <= (24 if ending == "pdf" else 8), away


def by_ghostscript(path):
    out = path.with_suffix(".page")
    size = ["-dPDFFitPage", f"-g{WIDTH}x{WIDTH // 2}", "-dTextAlphaBits=4", "-dGraphicsAlphaBits=4"]
    command = ["gs", "-q", "-dBATCH", "-dNOPAUSE", "-sDEVICE=png16m", *size, f"-sOutputFile={out}", str(path)]
    subprocess.run(command, check=True)
    return pixels(QImage(str(out), "png"))


def by_librsvg(path):
    out = path.with_suffix(".theirs.png")
    command = ["rsvg-convert", "-w", str(WIDTH), "-b", "white", str(path), "-o", str(out)]
    subprocess.run(command, check=True)
    return pixels(QImage(str(out)))


def on_white(image):
    white = QImage(image.size(), QImage.Format.Format_RGB32)
    white.fill("white")
    with QPainter(white) as painter:
        painter.drawImage(0, 0, image)
    return white


def changed(document, places, opacity):
    return tidy_shapes(with_overall_opacity(document, places, opacity))


def test_tikz_has_no_groups_and_says_so():
    document = read(NESTED, None).document
    written = tikz_picture(document)
    assert "fill opacity=0.2" in written.text
    assert any("seen through as a whole" in each for each in written.remarks)
    assert opacities_of(document, range(5)) == [0.5]
