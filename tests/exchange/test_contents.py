"""Texts and pictures of SVG files are shown where other programs show them, though nobody edits them here."""

from __future__ import annotations

import base64
import shutil
import subprocess

import numpy as np
import pytest
from PySide6.QtCore import QBuffer, QIODevice
from PySide6.QtGui import QColor, QImage

from app.document.content import MOST_LETTERS, WHOLE, Anchor
from app.document.contents import corners_of, is_content, plane_of, repainted, why_no_frame
from app.document.edits import delete_points, move_points
from app.document.several_curves import mapped, whole_curves
from app.document.style_edits import with_style
from app.document.transforms import Affine
from app.exchange.drawing.image import pdf_file, png_file
from app.exchange.drawing.styles import LIGHT
from app.exchange.options import Options
from app.exchange.reading import import_file
from app.exchange.rescaled import in_unit
from app.exchange.svg.reader import read_svg
from app.exchange.svg.writer import svg_of
from app.qt.glyphs import has_fonts
from app.storage.format import decode, encode
from app.storage.format_error import FormatError

HEAD = (
    '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" '
    'xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" width="200mm" '
    'height="100mm" viewBox="0 0 200 100">'
)
LINE = '<path id="p" d="M5 95H195" stroke="#000" fill="none"/>'


def file_of(body):
    return f"{HEAD}{body}</svg>".encode()


def kept(body, line=LINE):
    return read_svg(file_of(line + body)).document


def png(width, height, colour):
    image = QImage(width, height, QImage.Format.Format_RGB32)
    image.fill(QColor(colour))
    buffer = QBuffer()
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    image.save(buffer, "PNG")
    return base64.b64encode(buffer.data().data()).decode()


def frames(body, line=LINE):
    """The texts and pictures that are read, and the map of each."""
    found = [each for each in kept(body, line).curves if is_content(each)]
    return [(each, each.form, plane_of(each.form, corners_of(each))) for each in found]


def test_lines_and_parts_of_a_text_are_one_object_with_places_and_fonts():
    ((curve, form, plane),) = frames(
        '<g font-size="10" font-family="A, \'B C\'" fill="#ff0000"><text y="20" transform="translate(3 4)">'
        '<tspan x="10">one <tspan style="font-weight:bold;font-size:2em;fill:#00f">two</tspan></tspan>'
        '<tspan x="10" dy="12" text-anchor="end">three</tspan></text></g>'
    )
    first, second = form.lines
    assert [(*plane.place(each.x, each.y), each.anchor) for each in (first, second)] == [
        (13.0, -24.0, Anchor.START),
        (13.0, -36.0, Anchor.END),
    ]
    assert [(run.words, run.size, run.weight) for run in first.runs] == [
        ("one ", 10.0, 400.0),
        ("two", 20.0, 700.0),
    ]
    assert curve.style.fill == "#ff0000"
    assert [run.paint and run.paint.fill for run in first.runs] == [None, "#0000ff"]
    assert (second.words, second.runs[0].font) == ("three", ("A", "B C"))
    assert curve.name == "one two three"


def test_blanks_are_those_that_are_drawn_and_letters_may_have_places():
    ((_, form, _),) = frames('<text x="1" y="2">\n  a \n b\t</text>')
    assert form.lines[0].words == "a b"
    ((_, form, _),) = frames('<text x="1" y="2" xml:space="preserve"> a  b</text>')
    assert form.lines[0].words == " a  b"
    ((_, form, _),) = frames('<text x="1 5 9" y="2">abcd</text>')
    assert [(line.words, line.x) for line in form.lines] == [("a", 1.0), ("b", 5.0), ("cd", 9.0)]
    ((_, form, _),) = frames('<text x="1" y="2" dx="0 3">ab</text>')
    assert [(run.words, run.right) for run in form.lines[0].runs] == [("a", 0.0), ("b", 3.0)]


def test_what_is_hidden_is_a_hidden_object_and_what_is_too_much_is_none():
    assert [each.visible for each, *_ in frames('<text x="1" y="2" display="none">a</text>')] == [False]
    assert [each.visible for each, *_ in frames('<g visibility="hidden"><text>a</text></g>')] == [False]
    assert frames(f'<text x="1" y="2">{"a" * (MOST_LETTERS + 1)}</text>') == []
    assert frames('<text x="1" y="2" transform="scale(0)">a</text>') == []
    assert frames('<text x="1e300" y="2">a</text>') == []
    assert frames('<text x="1" y="2" transform="matrix(1 2 1 2.0000000000001 0 0)">a</text>') == []
    assert frames('<image width="9" height="1e-300" href="a.png"/>') == []


def test_a_text_and_a_picture_lie_between_the_curves_as_in_the_file():
    """They lay in front of all curves or behind all."""
    document = kept(f'<text x="1" y="2">a</text>{LINE}<image width="9" height="9" href="a.png"/>{LINE}')
    assert [each.form and each.form.noun for each in document.curves] == [None, "text", None, "picture", None]


def test_a_file_of_texts_alone_is_a_document():
    document = kept('<text x="1" y="2" inkscape:label="Greeting">Dear Sir</text>', "")
    assert [each.name for each in document.curves] == ["Greeting"]


@pytest.mark.usefixtures("qapp")
def test_a_picture_is_as_large_as_it_is_shown():
    ((curve, form, _),) = frames(
        f'<image x="10" y="10" width="40" height="40" opacity="0.5" '
        f'xlink:href="data:image/png;base64,{png(4, 2, "red")}"/>'
    )
    # As wide as its place and half as high, in the middle of that.
    assert corners_of(curve) == [(10.0, -20.0), (50.0, -20.0), (50.0, -40.0), (10.0, -40.0)]
    assert (form.part, curve.style.opacity) == (WHOLE, 0.5)


def test_files_and_other_units_keep_them(tmp_path):
    (tmp_path / "a.svg").write_bytes(
        file_of(f'{LINE}<text x="1" y="2">a</text><image width="9" height="9"/>')
    )
    document = import_file(tmp_path / "a.svg").document
    assert [is_content(each) for each in document.curves] == [False, True, True]
    assert decode(encode(document)) == document
    text = in_unit(document, "cm").curves[1]
    plane = plane_of(text.form, corners_of(text))
    assert plane.place(1.0, 2.0) == pytest.approx((0.1, 9.8))
    assert (plane.across, text.form.lines[0].runs[0].size) == ((pytest.approx(0.1), 0.0), 16.0)


def test_a_frame_that_is_none_is_refused_in_a_file():
    data = encode(kept('<text x="1" y="2">a</text>'))
    assert decode(data)
    with pytest.raises(FormatError, match="must run around a box that is mapped, for it frames a text"):
        decode(data.replace(b'"closed": true', b'"closed": false'))


# As others show them


def grey(path):
    image = QImage(str(path)).convertToFormat(QImage.Format.Format_Grayscale8)
    rows = np.frombuffer(bytes(image.constBits()), np.uint8).reshape(image.height(), image.bytesPerLine())
    return rows[:, : image.width()]


def ink_box(picture):
    rows, columns = np.nonzero(picture < 128)
    return np.array([columns.min(), rows.min(), columns.max(), rows.max()])


TEXTS = [
    '<text x="20" y="40" font-size="14">Letters, gypq</text>',
    '<text x="100" y="50" font-size="12" text-anchor="middle" transform="rotate(-20 100 50)">Middle</text>',
    '<text x="180" y="40" style="font:italic bold 10px \'DejaVu Serif\',serif;text-anchor:end">End</text>',
    '<text y="30" font-size="9"><tspan x="20">H<tspan font-size="6" dy="2">2</tspan></tspan>'
    '<tspan x="20" y="60" letter-spacing="2" font-weight="700">Wide line</tspan></text>',
    '<text x="20" y="50" font-size="20" fill="none" stroke="black" stroke-width="1.5">Outline</text>',
]


@pytest.mark.usefixtures("qapp")
@pytest.mark.skipif(shutil.which("rsvg-convert") is None, reason="librsvg is not installed")
@pytest.mark.parametrize("text", TEXTS)
def test_a_text_takes_the_same_room_as_in_librsvg(text, tmp_path):
    if not has_fonts():
        pytest.skip("there is no font")
    data = file_of(
        '<path d="M-9 -9H-8" stroke="#000"/>' + text.replace("<text", '<text font-family="DejaVu Sans"')
    )
    (tmp_path / "a.svg").write_bytes(data)
    command = ["rsvg-convert", "--width=800", "--background-color=white", "-o", str(tmp_path / "b.png")]
    subprocess.run([*command, str(tmp_path / "a.svg")], check=True, timeout=60)
    ours = png_file(read_svg(data).document, Options(width=800, style=LIGHT.on_page()))
    (tmp_path / "c.png").write_bytes(ours.data)
    theirs, mine = grey(tmp_path / "b.png"), grey(tmp_path / "c.png")
    assert mine.shape == theirs.shape
    assert np.abs(ink_box(mine) - ink_box(theirs)).max() <= 1.0
    # The same letters: as much ink, whatever the edges.
    assert (255.0 - mine).sum() == pytest.approx((255.0 - theirs).sum(), rel=0.05)


@pytest.mark.usefixtures("qapp")
def test_pictures_are_in_what_is_exported_and_those_that_are_not_there_are_told():
    data = png(4, 4, "#00ff00")
    document = kept(
        f'<image x="10" y="10" width="40" height="40" xlink:href="data:image/png;base64,{data}"/>'
        '<image x="100" y="10" width="40" height="40" xlink:href="photo.png"/>'
    )
    written = png_file(document, Options(width=200, style=LIGHT.on_page()))
    image = QImage.fromData(written.data)
    assert image.pixelColor(30, 30) == QColor("#00ff00")
    assert image.pixelColor(8, 30) == image.pixelColor(120, 30) == QColor("white")
    assert written.remarks == ("1 picture is not drawn; its file lies elsewhere.",)
    assert b"/Image" in pdf_file(document, Options(unit="mm")).data


# Edits

GROUPED = (
    '<g id="logo"><path id="a" d="M0 0H10V10Z" fill="#00f"/><path id="b" d="M20 0H30V10Z"/>'
    '<text x="5" y="20" font-size="10">in it</text></g><text x="50" y="60">beside</text>'
)


def places(document):
    """Where the units of all texts and pictures lie."""
    planes = [plane_of(each.form, corners_of(each)) for each in document.curves if is_content(each)]
    return [[each.x, each.y, *each.across, *each.down] for each in planes]


def test_what_would_tear_a_frame_is_told():
    begun = read_svg(file_of(GROUPED)).document
    for text, picture in (
        (move_points(begun, 2, [0], (1.0, 0.0)), None),
        (delete_points(begun, 2, [0]), None),
    ):
        assert picture is None
        assert why_no_frame(begun, text) == "“in it” is a text: Object to Path makes outlines of it."
    flat = mapped(begun, whole_curves(begun, {2}), Affine(0.0, 0.0, 0.0, -1.0, (0.0, 0.0)))
    assert why_no_frame(begun, flat)
    image = read_svg(file_of('<image width="9" height="9" href="a.png"/>')).document
    torn = move_points(image, 0, [0], (1.0, 0.0))
    assert why_no_frame(image, torn) == "“Picture” is a picture: it is moved, scaled and turned as a whole."


def test_another_style_is_that_of_all_letters():
    """Those with a colour of their own keep what the style does not change."""
    body = '<text x="5" y="20" font-size="10">a<tspan fill="#00f" stroke="#0f0">b</tspan></text>'
    begun = kept(body)
    paint = begun.curves[1].form.lines[0].runs[1].paint
    assert (paint.fill, paint.stroke) == ("#0000ff", "#00ff00")
    red = repainted(with_style(begun, {1}, fill="#ff0000"), begun)
    paint = red.curves[1].form.lines[0].runs[1].paint
    assert (paint.fill, paint.stroke) == ("#ff0000", "#00ff00")
    plain = repainted(with_style(red, {1}, stroke="#123456"), red)
    assert [run.paint for run in plain.curves[1].form.lines[0].runs] == [None, None]
    assert repainted(with_style(begun, {0}, fill="#ff0000"), begun).curves[1] is begun.curves[1]


def test_an_exported_drawing_has_them_and_reads_back_the_same():
    data = png(4, 4, "red")
    document = kept(
        f'<image x="10" y="10" width="40" height="40" opacity="0.5" href="data:image/png;base64,{data}"/>'
        '<text transform="matrix(0 2 -2 0 50 50)" font-size="9" stroke="#00f"><tspan fill="red">a &lt;b '
        '</tspan><tspan dy="3" dx="1" letter-spacing="2" word-spacing="-1.5" '
        "font-family=\"'A B', serif\">c</tspan></text>"
    )
    again = read_svg(svg_of(document, Options(unit="mm")).data).document
    assert len(again.curves[2].form.lines[0].runs) == 2
    for mine, read in zip(document.curves[1:], again.curves[1:], strict=True):
        assert (mine.style, mine.name) == (read.style, read.name)
        assert mine.form.inner == pytest.approx(read.form.inner)
    assert document.curves[2].form.lines == again.curves[2].form.lines
    assert document.curves[1].form.data == again.curves[1].form.data
    for mine, read in zip(places(document), places(again), strict=True):
        assert mine == pytest.approx(read)


@pytest.mark.usefixtures("qapp")
@pytest.mark.parametrize(
    ("around", "is_clip"),
    [
        (
            '<clipPath id="c"><rect x="20" width="100" height="30"/></clipPath><g clip-path="url(#c)">%s</g>',
            True,
        ),
        ('<svg x="20" y="0" width="100" height="30" viewBox="20 0 100 30">%s</svg>', False),
    ],
)
def test_a_picture_is_cut_by_an_upright_box_and_stays_so(around, is_clip):
    """A clip stays one, which Release Clip takes away; of what a view box cuts off nothing is there."""
    image = f'<image x="10" y="10" width="40" height="40" href="data:image/png;base64,{png(4, 4, "red")}"%s/>'
    document = kept(around % (image % ""))
    picture = document.curves[1]
    left, top, right, bottom = (10.0, -10.0, 50.0, -50.0) if is_clip else (20.0, -10.0, 50.0, -30.0)
    assert corners_of(picture) == [(left, top), (right, top), (right, bottom), (left, bottom)]
    assert (picture.form.part, len(picture.style.clips)) == (
        (WHOLE, 1) if is_clip else ((0.25, 0.0, 1.0, 0.5), 0)
    )
    written = QImage.fromData(png_file(document, Options(width=200, style=LIGHT.on_page())).data)
    red = [place for place in range(200) if written.pixelColor(place, 20) == QColor("red")]
    assert (red[0], red[-1]) == (20, 49)
    assert written.pixelColor(30, 31) == QColor("white")
    # Anew, it is a clip in any case.
    again = read_svg(svg_of(document, Options(unit="mm")).data).document
    assert (again.curves[1].form.part, len(again.curves[1].style.clips)) == (WHOLE, 1)
    assert again.curves[1].groups == picture.groups
    assert QImage.fromData(png_file(again, Options(width=200, style=LIGHT.on_page())).data) == written
    assert places(again) == [pytest.approx(each) for each in places(document)]
    # What a box hides as a whole is not there; what a clip leaves whole has none.
    hidden = frames(around % (image % ' transform="translate(0 50)"'))
    assert bool(hidden) == is_clip
    ((whole, *_),) = frames(around % (image % ' transform="translate(21 0) scale(.5)"'))
    assert (whole.form.part, whole.style.clips) == (WHOLE, ())


def test_what_else_would_change_its_look_is_told():
    found = read_svg(file_of(f'{LINE}<text x="1" y="2" filter="url(#f)">a</text>'))
    assert [each.why for each in found.missed] == ["a filter changes it"]


# In its file

LETTER = (
    '<g id="head" transform="matrix(0 2 -2 0 150 10)"><path id="a" d="M0 0H10V10Z"/>'
    '<text transform="scale(.5)"><tspan x="5" y="20">Dear <tspan font-size="9">Sir</tspan></tspan>\n'
    '<tspan x="5" y="30">or Madam</tspan></text></g><!-- same -->'
    '<text x="50" y="60">same</text><text x="60" y="70" font-size="8">same</text>'
    '<g><text x="50" y="60">same</text></g>'
)
