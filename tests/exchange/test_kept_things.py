"""Texts and pictures of SVG files are shown where other programs show them, though nobody edits them here."""

from __future__ import annotations

import base64
import re
import shutil
import subprocess

import numpy as np
import pytest
from PySide6.QtCore import QBuffer, QIODevice
from PySide6.QtGui import QColor, QImage

from app.document.kept import MOST_LETTERS, Anchor
from app.document.kept_edits import seen_kept
from app.document.kept_moves import KeptPlace, is_locked, move_kept, remove_kept
from app.document.several_curves import mapped, stepped, whole_curves, with_appearance
from app.document.transforms import Affine
from app.exchange.corner import from_lower_left
from app.exchange.drawing.image import pdf_file, png_file
from app.exchange.drawing.styles import LIGHT
from app.exchange.options import Options
from app.exchange.reading import import_file
from app.exchange.rescaled import in_unit
from app.exchange.svg.in_place.rewriting import rewritten
from app.exchange.svg.reader import read_svg
from app.exchange.svg.writer import svg_of
from app.qt.glyphs import has_fonts
from app.storage.format import decode, encode

HEAD = (
    '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" width="200mm" '
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


@pytest.mark.usefixtures("qapp")
def test_lines_and_parts_of_a_text_have_places_and_fonts():
    document = kept(
        '<g font-size="10" font-family="A, \'B C\'" fill="#ff0000"><text y="20" transform="translate(3 4)">'
        '<tspan x="10">one <tspan style="font-weight:bold;font-size:2em;fill:#00f">two</tspan></tspan>'
        '<tspan x="10" dy="12" text-anchor="end">three</tspan></text></g>'
    )
    first, second = document.kept_texts
    assert [(each.x, each.y, each.anchor) for each in (first, second)] == [
        (13.0, -24.0, Anchor.START),
        (13.0, -36.0, Anchor.END),
    ]
    assert [(run.words, run.size, run.weight, run.fill) for run in first.runs] == [
        ("one ", 10.0, 400.0, "#ff0000"),
        ("two", 20.0, 700.0, "#0000ff"),
    ]
    assert (second.words, second.runs[0].font) == ("three", ("A", "B C"))


def test_blanks_are_those_that_are_drawn_and_letters_may_have_places():
    (text,) = kept('<text x="1" y="2">\n  a \n b\t</text>').kept_texts
    assert text.words == "a b"
    (text,) = kept('<text x="1" y="2" xml:space="preserve"> a  b</text>').kept_texts
    assert text.words == " a  b"
    each = kept('<text x="1 5 9" y="2">abcd</text>').kept_texts
    assert [(text.words, text.x) for text in each] == [("a", 1.0), ("b", 5.0), ("cd", 9.0)]
    (text,) = kept('<text x="1" y="2" dx="0 3">ab</text>').kept_texts
    assert [(run.words, run.right) for run in text.runs] == [("a", 0.0), ("b", 3.0)]


def test_what_is_hidden_and_what_is_too_much_is_not_shown():
    assert kept('<text x="1" y="2" display="none">a</text>').kept_texts == ()
    assert kept('<g visibility="hidden"><text x="1" y="2">a</text></g>').kept_texts == ()
    assert kept(f'<text x="1" y="2">{"a" * (MOST_LETTERS + 1)}</text>').kept_texts == ()
    assert kept('<text x="1" y="2" transform="scale(0)">a</text>').kept_texts == ()
    assert kept('<text x="1e300" y="2">a</text>').kept_texts == ()


def test_a_text_lies_in_front_of_the_curves_or_behind_all():
    assert not kept('<text x="1" y="2">a</text>').kept_texts[0].behind
    assert kept(LINE, '<text x="1" y="2">a</text>').kept_texts[0].behind


@pytest.mark.usefixtures("qapp")
def test_a_picture_lies_behind_curves_unless_it_covers_an_area():
    image = (
        f'<image x="10" y="10" width="40" height="40" xlink:href="data:image/png;base64,{png(4, 2, "red")}"/>'
    )
    (picture,) = kept(image).kept_pictures
    # As wide as its place and half as high, in the middle of that.
    assert (picture.x, picture.y, picture.across, picture.down) == (10.0, -20.0, (40.0, 0.0), (0.0, -20.0))
    assert picture.behind
    assert not kept(image, '<rect width="200" height="100"/>').kept_pictures[0].behind


def test_nothing_beside_the_file_is_read(tmp_path):
    """Neither a file nor an address, nor a picture that is a drawing with such in it."""
    (tmp_path / "a.png").write_bytes(b"secret")
    for place in (
        tmp_path.as_uri() + "/a.png",
        "a.png",
        "http://localhost/a.png",
        "data:image/svg+xml,%3Csvg/%3E",
    ):
        found = read_svg(file_of(f'{LINE}<image width="9" height="9" xlink:href="{place}"/>'))
        assert [each.data for each in found.document.kept_pictures] == [""]
        assert found.missed[0].instead == "its file lies elsewhere: a frame shows where it is"


def test_files_and_other_units_keep_them(tmp_path):
    (tmp_path / "a.svg").write_bytes(
        file_of(f'{LINE}<text x="1" y="2">a</text><image width="9" height="9"/>')
    )
    document = import_file(tmp_path / "a.svg").document
    assert document.kept_texts
    assert document.kept_pictures
    assert decode(encode(document)) == document
    (text,) = in_unit(document, "cm").kept_texts
    assert (text.x, text.across, text.runs[0].size) == (pytest.approx(0.1), (pytest.approx(0.1), 0.0), 16.0)


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


# Groups

GROUPED = (
    '<g id="logo"><path id="a" d="M0 0H10V10Z" fill="#00f"/><path id="b" d="M20 0H30V10Z"/>'
    '<text x="5" y="20" font-size="10">in it</text></g><text x="50" y="60">beside</text>'
)


def test_a_text_goes_with_its_group_as_it_does_in_the_file():
    data = file_of(GROUPED)
    begun = from_lower_left(read_svg(data).document)
    assert [each.groups for each in begun.kept_texts] == [("logo",), ()]
    # A quarter turn to twice the size; a move.
    for by in (
        Affine(-1.0, -2.0, 2.0, -1.0, (7.0, -5.0)),
        Affine(0.0, 0.0, 0.0, 0.0, (0.0, 0.0), (3.0, 4.0)),
    ):
        moved = mapped(begun, whole_curves(begun, {0, 1}), by)
        written = rewritten(data, moved, begun)
        again = from_lower_left(read_svg(written.data).document)
        assert moved.kept_texts[0] != begun.kept_texts[0]
        assert moved.kept_texts[1] is begun.kept_texts[1]
        for mine, read in zip(moved.kept_texts, again.kept_texts, strict=True):
            assert [mine.x, mine.y, *mine.across, *mine.down] == pytest.approx(
                [read.x, read.y, *read.across, *read.down]
            )


def test_a_text_stays_where_but_a_part_of_its_group_is_moved():
    begun = read_svg(file_of(GROUPED)).document
    assert stepped(begun, whole_curves(begun, {0}), (3.0, 4.0)).kept_texts is begun.kept_texts


def test_a_text_is_hidden_with_its_group():
    begun = read_svg(file_of(GROUPED)).document
    hidden = with_appearance(begun, {0, 1}, visible=False)
    assert [each.words for each in seen_kept(hidden)[0]] == ["beside"]
    assert seen_kept(with_appearance(hidden, {1}, visible=True))[0] == begun.kept_texts


def test_an_exported_drawing_has_them_and_reads_back_the_same():
    data = png(4, 4, "red")
    document = kept(
        f'<image x="10" y="10" width="40" height="40" opacity="0.5" href="data:image/png;base64,{data}"/>'
        '<text transform="matrix(0 2 -2 0 50 50)" font-size="9" stroke="#00f"><tspan fill="red">a &lt;b '
        '</tspan><tspan dy="3" dx="1" letter-spacing="2" font-family="\'A B\', serif">c</tspan></text>'
    )
    again = read_svg(svg_of(document, Options(unit="mm")).data).document
    assert (again.kept_pictures, again.kept_texts) == (document.kept_pictures, document.kept_texts)
    assert len(again.kept_texts[0].runs) == 2


@pytest.mark.usefixtures("qapp")
def test_a_picture_is_cut_by_an_upright_box_and_stays_so():
    image = f'<image x="10" y="10" width="40" height="40" href="data:image/png;base64,{png(4, 4, "red")}"'
    clip = '<clipPath id="c"><rect x="20" y="0" width="100" height="30"/></clipPath>'
    document = kept(f'{clip}{image} clip-path="url(#c)"/>')
    (picture,) = document.kept_pictures
    assert picture.part == (0.25, 0.0, 1.0, 0.5)
    written = QImage.fromData(png_file(document, Options(width=200, style=LIGHT.on_page())).data)
    red = [place for place in range(200) if written.pixelColor(place, 20) == QColor("red")]
    assert (red[0], red[-1]) == (20, 49)
    assert written.pixelColor(30, 31) == QColor("white")
    again = read_svg(svg_of(document, Options(unit="mm")).data).document
    assert again.kept_pictures == (picture,)
    # What a box hides as a whole is not there.
    assert kept(f'{clip}{image} transform="translate(150 0)" clip-path="url(#c)"/>').kept_pictures != ()
    assert kept(f'{clip}<g clip-path="url(#c)">{image} transform="translate(0 50)"/></g>').kept_pictures == ()


def test_what_else_would_change_its_look_is_told():
    found = read_svg(file_of(f'{LINE}<text x="1" y="2" filter="url(#f)">a</text>'))
    assert [each.why for each in found.missed] == ["text is no curve", "a filter changes it"]


def test_texts_come_with_the_groups_that_are_taken():
    found = read_svg(file_of(f'{GROUPED}<g id="rest"><path id="c" d="M0 0H9"/>{LINE}</g>'))
    counts = [len(found.called([name]).document.kept_texts) for name in ("logo", "rest", "c", "*")]
    assert counts == [1, 0, 0, 2]
    assert [each.words for each in found.only([False, False, True, True]).document.kept_texts] == ["beside"]


# Moved alone

LETTER = (
    '<g id="head" transform="matrix(0 2 -2 0 150 10)"><path id="a" d="M0 0H10V10Z"/>'
    '<text transform="scale(.5)"><tspan x="5" y="20">Dear <tspan font-size="9">Sir</tspan></tspan>\n'
    '<tspan x="5" y="30">or Madam</tspan></text></g><!-- same -->'
    '<text x="50" y="60">same</text><text x="60" y="70" font-size="8">same</text>'
    '<g><text x="50" y="60">same</text></g>'
)


def places(document):
    return [
        [each.x, each.y, *each.across, *each.down] for each in (*document.kept_texts, *document.kept_pictures)
    ]


def test_a_text_moved_alone_or_removed_is_so_in_its_file():
    """With all of its lines, in what turns and stretches it; the rest stays, to the byte."""
    picture = (
        '<clipPath id="c"><circle cx="20" cy="30" r="9"/></clipPath>'
        f'<image clip-path="url(#c)" x="10" y="10" width="40" height="40" '
        f'href="data:image/png;base64,{png(4, 4, "red")}"/>'
    )
    data = file_of(LINE + LETTER + picture)
    begun = from_lower_left(read_svg(data).document)
    assert [each.follows for each in begun.kept_texts] == [False, True, False, False, False]
    moved = move_kept(begun, KeptPlace(True, 0), (3.0, -4.0))
    moved = remove_kept(moved, KeptPlace(True, 2))
    moved = move_kept(moved, KeptPlace(True, 3), (1.0, 1.0))
    moved = move_kept(moved, KeptPlace(False, 0), (-7.0, 2.0))
    for before, after in zip(begun.kept_texts[:2], moved.kept_texts[:2], strict=True):
        assert (after.x, after.y) == pytest.approx((before.x + 3, before.y - 4))
    written = rewritten(data, moved, begun).data
    again = from_lower_left(read_svg(written).document)
    for mine, read in zip(places(moved), places(again), strict=True):
        assert mine == pytest.approx(read, abs=1e-6)
    assert [each.words for each in again.kept_texts] == ["Dear Sir ", "or Madam", "same", "same"]
    assert again.kept_pictures[0].clips[0].rings[0].numbers == pytest.approx(
        moved.kept_pictures[0].clips[0].rings[0].numbers
    )
    assert again.curves == begun.curves
    # Without what was set, and with what went, it is the file of before.
    back = re.sub(rb' transform="translate\([^"]*"', b"", written)
    back = re.sub(rb"matrix\(0\.5,0,0,0\.5,[^)]*\)", b"scale(.5)", back)
    assert back == data.replace(b'<text x="50" y="60">same</text>', b"", 1)
    assert rewritten(written, moved, moved).data == written
    # What is not in the file any more is not lost in silence: it is written anew, as what was asked about is.
    assert rewritten(written, begun, moved) is None


def test_what_is_locked_or_in_a_clone_stays():
    inside = '<g id="g"><text x="1" y="2">a</text></g><use href="#g" x="50"/>'
    spaces = 'xmlns:sodipodi="http://sodipodi.sourceforge.net/DTD/sodipodi-0.dtd" sodipodi:insensitive="true"'
    document = kept(f'{inside}<text x="9" y="9" {spaces}>b</text>')
    locks = [is_locked(document, KeptPlace(True, at)) for at in range(3)]
    assert locks == [False, True, True]
    document = read_svg(file_of(GROUPED)).document
    assert not is_locked(document, KeptPlace(True, 0))
    assert is_locked(with_appearance(document, {0, 1}, locked=True), KeptPlace(True, 0))


@pytest.mark.skipif(shutil.which("rsvg-convert") is None, reason="librsvg is not installed")
def test_a_moved_text_has_its_ink_there(tmp_path):
    data = file_of('<path d="M-9 -9H-8" stroke="#000"/><text x="20" y="40" font-size="14">Letters</text>')
    begun = from_lower_left(read_svg(data).document)
    boxes = []
    for name, moved in (("a", begun), ("b", move_kept(begun, KeptPlace(True, 0), (50.0, 20.0)))):
        (tmp_path / f"{name}.svg").write_bytes(rewritten(data, moved, begun).data)
        command = [
            "rsvg-convert",
            "--width=800",
            "--background-color=white",
            "-o",
            str(tmp_path / f"{name}.png"),
        ]
        subprocess.run([*command, str(tmp_path / f"{name}.svg")], check=True, timeout=60)
        boxes.append(ink_box(grey(tmp_path / f"{name}.png")))
    assert np.abs(boxes[1] - boxes[0] - [200, -80, 200, -80]).max() <= 1
