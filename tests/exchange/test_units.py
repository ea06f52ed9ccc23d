"""True size: a unit that is set is the file's, in SVG, PDF and DXF, from the window and the command line."""

from __future__ import annotations

import math
import re
import zlib
from xml.etree import ElementTree

import pytest
from msgspec.structs import replace
from PySide6.QtGui import QImage

from app.cli import main
from app.document.lengths import MILLIMETRES, known_unit
from app.document.model import Document, make_curve
from app.document.style import Style
from app.exchange.drawing.drawing import drawing_of, trimmed_to_curves
from app.exchange.drawing.image import png_preview
from app.exchange.errors import ExchangeError
from app.exchange.export_choice import ExportChoice
from app.exchange.files import export, import_file
from app.exchange.formats import FORMATS, format_of
from app.exchange.options import Options
from app.exchange.svg.reader import read_svg
from app.exchange.svg.writer import svg_of
from app.families import FAMILIES, HERMITE
from app.storage.files import save
from app.view_model.extents import extent_of
from tests.rows import each_row

pytestmark = pytest.mark.usefixtures("qapp")

SEVENTY = Document((make_curve(((10.0, 5.0), (80.0, 5.0), (80.0, 45.0)), family=HERMITE),))
BAR = Document((make_curve(((0.0, 0.0), (70.0, 0.0))),))
CSS = {"mm": 1.0, "cm": 10.0, "in": 25.4, "pt": 25.4 / 72, "pc": 25.4 / 6, "px": 25.4 / 96, "": 25.4 / 96}


def millimetres_of_one(text):
    """How long a length of one is in an SVG, both ways."""
    root = ElementTree.fromstring(text.encode())
    *_, width, height = map(float, root.get("viewBox").split())
    lengths = [re.fullmatch(r"([-+.e0-9]+)([a-z]*)", root.get(name)) for name in ("width", "height")]
    return [float(m[1]) * CSS[m[2]] / side for m, side in zip(lengths, (width, height), strict=True)]


@each_row("unit", MILLIMETRES)
def test_an_svg_has_true_size(unit):
    # Rounding of a quotient; 70 mm were 77.9 mm.
    assert millimetres_of_one(svg_of(SEVENTY, Options(unit=unit)).text) == pytest.approx(
        [MILLIMETRES[unit]] * 2, rel=1e-12
    )


def test_millimetres_have_their_name():
    frame = trimmed_to_curves(drawing_of(SEVENTY)).frame
    assert f' width="{frame.width!r}mm" ' in svg_of(SEVENTY, Options(unit="mm")).text


def test_a_requested_width_applies_and_seconds_are_no_length():
    for options in ({"unit": "mm", "width": 500}, {"unit": "s"}, {}):
        root = ElementTree.fromstring(svg_of(SEVENTY, Options(**options)).data)
        assert root.get("width").replace(".", "").isdigit()


@each_row(("name", "unit"), [("MM", "mm"), (" inch ", "in"), ('"', "in"), ("um", "µm"), ("s", "")])
def test_units_by_other_names(name, unit):
    assert known_unit(name) == unit


def page_of(data):
    """Width and height in points."""
    (box,) = re.findall(rb"/MediaBox \[(.*?)\]", data)
    left, bottom, right, top = map(float, box.split())
    return right - left, top - bottom


def length_of_the_stroke(data):
    """How far the one stroke of a page reaches to the right, in points: its matrix times its coordinates."""
    streams = re.findall(rb"stream\r?\n(.*?)\r?\nendstream", data, re.DOTALL)
    texts = [zlib.decompress(each) for each in streams if each[:1] == b"x"]
    (page,) = (
        text.decode("latin-1") for text in texts if (b" cm" in text and b" l\n" in text) or b" c\n" in text
    )
    scale = 1.0
    for factor in re.findall(r"^([-.0-9e]+) 0 0 [-.0-9e]+ [-.0-9e]+ [-.0-9e]+ cm", page, re.MULTILINE):
        scale *= float(factor)
    (start,) = re.findall(r"([-.0-9e]+) [-.0-9e]+ m\n", page)[-1:]
    (end,) = re.findall(r"([-.0-9e]+) [-.0-9e]+ (?:l|c)\n", page)[-1:]
    return abs(scale) * (float(end) - float(start))


@pytest.mark.parametrize("unit", ["mm", "cm", "in"])
def test_a_pdf_has_true_size(unit, tmp_path):
    document = BAR if unit == "mm" else Document((make_curve(((0.0, 0.0), (9.0, 0.0))),))
    export(document, tmp_path / "a.pdf", Options(unit=unit))
    data = (tmp_path / "a.pdf").read_bytes()
    frame, scale = trimmed_to_curves(drawing_of(document)).frame, MILLIMETRES[unit] * 72 / 25.4
    wide, high = page_of(data)
    # It was 720 wide, and later a whole number of points.
    assert (wide, high) == pytest.approx((frame.width * scale, frame.height * scale), abs=1e-6)
    length = document.curves[0].points[-1].x * scale
    # Qt writes coordinates with some six digits.
    assert length_of_the_stroke(data) == pytest.approx(length, rel=1e-4)


def test_pages_that_no_pdf_has_are_refused(tmp_path):
    for unit in ("m", "µm"):
        with pytest.raises(ExchangeError, match="At true size the page would be"):
            export(BAR, tmp_path / "a.pdf", Options(unit=unit))
        export(BAR, tmp_path / "a.pdf", Options(unit=unit, width=300))


def test_a_dxf_names_the_unit(tmp_path):
    ezdxf = pytest.importorskip("ezdxf")
    for unit, code in (("mm", 4), ("inch", 1), ("", 0), ("s", 0)):
        export(BAR, tmp_path / "a.dxf", Options(unit=unit))
        assert ezdxf.readfile(tmp_path / "a.dxf").units == code


@pytest.mark.usefixtures("drawings_read_here")
def test_a_picture_of_true_size_is_read_with_the_same_coordinates(tmp_path):
    export(SEVENTY, tmp_path / "a.svg", Options(unit="mm"))
    (back,) = import_file(tmp_path / "a.svg").document.curves
    assert [point.x for point in back.points] == pytest.approx([10.0, 80.0, 80.0])


@each_row(
    ("ending", "unit", "said"),
    [
        (".svg", "mm", "70.21 × 40.21 mm, 1 : 1 (1 is 1 mm)"),
        (".pdf", "mm", "Page of 70.21 × 40.21 mm, 1 : 1 (1 is 1 mm)"),
        (".png", "mm", "829 × 475 pixels, 70.21 × 40.21 mm at 300 dpi"),
        (".png", "", "1600 × 988 pixels"),
        (".pdf", "", "Page of 254 × 156.8 mm, not to scale"),
        (".svg", "s", "78.4 × 48.4 px, not to scale"),
    ],
)
def test_the_preview_states_size_scale_and_page(ending, unit, said):
    bent = Document((make_curve(((10.0, 5.0), (80.0, 45.0))),), unit=unit)
    look = format_of(f"a{ending}", FORMATS.pictures).preview
    assert look(*ExportChoice(ending).request(bent, 0), (100, 100)).size == said
    whole = ExportChoice(ending, {"true_size": False, "by_dpi": False}).request(bent, 0)
    # A PNG is by its width then, and its resolution follows.
    assert whole.options.unit == (unit if ending == ".png" else "")
    by_width = "1600 × 916 pixels, 70.21 × 40.21 mm at 578.8 dpi"
    assert look(*whole, (100, 100)).size.endswith(("not to scale", "pixels", by_width))


def test_the_command_line_accepts_a_unit(tmp_path, capsys):
    path = tmp_path / "a.curve.json"
    save(path, SEVENTY)
    assert main(["render", str(path), "-o", str(tmp_path / "a.svg"), "--unit", "mm"]) == 0
    assert millimetres_of_one((tmp_path / "a.svg").read_text()) == pytest.approx([1.0, 1.0])
    with pytest.raises(SystemExit):
        main(["render", str(path), "-o", str(tmp_path / "a.svg"), "--unit", "yard"])
    assert "“yard” is not one of" in capsys.readouterr().err
    assert Options().unit == ""


def test_a_png_states_its_pixels_per_inch_and_tikz_has_true_size(tmp_path):
    """Both took no notice of the unit: 70 mm were 96 pixels per inch, and 12 cm."""
    png, tikz = tmp_path / "a.png", tmp_path / "a.tikz"
    export(SEVENTY, png, Options(width=800, unit="mm"))
    image = QImage(str(png))
    wide = picture_box(SEVENTY)[2]
    assert image.dotsPerMeterX() == image.dotsPerMeterY() == round(800 / wide * 1000)
    seen = png_preview(SEVENTY, Options(width=800, unit="mm"), (100, 100))
    assert seen.size.endswith(f" mm at {image.dotsPerMeterX() * 0.0254:.4g} dpi")
    export(SEVENTY, png, Options(width=800))
    assert QImage(str(png)).dotsPerMeterX() == round(96 / 0.0254)
    export(SEVENTY, tikz, Options(unit="mm"))
    ends = [tuple(map(float, each)) for each in re.findall(r"\(([-.0-9]+),([-.0-9]+)\)", tikz.read_text())]
    across = ends[-1][0] - ends[0][0], ends[-1][1] - ends[0][1]
    assert across == pytest.approx((7.0, 4.0), abs=1e-4)
    assert "One centimetre is 10 mm." in tikz.read_text()
    with pytest.raises(ExchangeError, match="a TikZ picture can be"):
        export(SEVENTY, tikz, Options(unit="km"))


def test_the_basis_functions_in_a_picture_are_those_of_the_panel():
    """Always the family's were drawn, also where the panel showed what each point does."""
    curve = make_curve(((0.0, 0.0), (1.0, 2.0), (3.0, 1.0), (4.0, 3.0)), family=HERMITE)
    document = Document((curve,))
    drawn = [
        svg_of(*ExportChoice(".svg", {"basis": True}).request(document, 0, with_estimates=shown)).text
        for shown in (False, True)
    ]
    lines = [ElementTree.fromstring(each.encode()).findall(".//*[@id='basis']//*[@d]") for each in drawn]
    # Two kinds of functions of four points each; and one function of each point.
    assert [len(each) for each in lines] == [3 + 8, 3 + 4]
    # Of a closed curve the first point has one function, as all others have: there were two of it.
    for family, estimates in ((FAMILIES.named("cubic_spline"), False), (HERMITE, True)):
        closed = Document((replace(curve, family=family, closed=True),))
        text = svg_of(
            *ExportChoice(".svg", {"basis": True}).request(closed, 0, with_estimates=estimates)
        ).text
        assert len(ElementTree.fromstring(text.encode()).findall(".//*[@id='basis']//*[@d]")) == 3 + 4


# The picture is as large as what it shows


def picture_box(document, **options):
    """Left, top, width and height of what an SVG shows."""
    root = ElementTree.fromstring(svg_of(document, Options(unit="mm", **options)).data)
    return [float(text) for text in root.get("viewBox").split()]


def test_at_true_size_a_picture_has_the_size_of_the_curves_with_their_strokes():
    """A logo of 70 mm became a picture of 78.4 mm."""
    style = Style(width=2.0)
    curves = tuple(replace(curve, style=style) for curve in SEVENTY.curves)
    left, _top, width, _height = picture_box(Document(curves))
    low, high = extent_of(drawing_of(SEVENTY).outlines[0].control_points)
    assert (left, left + width) == pytest.approx((low[0] - 1.0, high[0] + 1.0))
    filled = tuple(replace(curve, style=Style(stroke="none", fill="#000000")) for curve in SEVENTY.curves)
    left, _top, width, _height = picture_box(Document(filled))
    assert (left, left + width) == pytest.approx((low[0], high[0]))


def test_at_true_size_the_tips_of_miters_are_in_the_picture():
    """The page of a star was as large as its line and half its stroke: its tips were cut off."""
    wedge = (
        b'<svg xmlns="http://www.w3.org/2000/svg" width="90mm" height="90mm" viewBox="0 0 90 90">'
        b'<path d="M10 50L13 10L16 50Z" fill="none" stroke="#000" stroke-width="1" '
        b'stroke-miterlimit="99"/></svg>'
    )
    _left, _top, width, height = picture_box(read_svg(wedge).document)
    # Half the width over the sine of half the angle; below, the corners are less sharp than right ones.
    side = math.hypot(3.0, 40.0)
    assert height == pytest.approx(40.0 + 0.5 * side / 3.0 + 0.5)
    assert width == pytest.approx(6.0 + 2 * 0.5 * (side + 3.0) / 40.0)


def test_a_line_of_the_usual_width_lies_inside():
    left, _top, width, _height = picture_box(SEVENTY)
    low, high = extent_of(drawing_of(SEVENTY).outlines[0].control_points)
    root = ElementTree.fromstring(svg_of(SEVENTY, Options(unit="mm")).data)
    (stroke,) = {float(each.get("stroke-width")) for each in root.iter() if each.get("stroke-width")}
    assert (left, left + width) == pytest.approx((low[0] - stroke / 2, high[0] + stroke / 2))


def test_the_picture_of_a_level_line_has_a_minimum_height():
    _left, _top, width, height = picture_box(BAR)
    assert (width, height) == pytest.approx((70.21, 1.404), rel=1e-3)


@pytest.mark.parametrize("shown", ["points", "handles", "grid"])
def test_annotations_have_a_margin(shown):
    assert picture_box(SEVENTY, **{shown: True})[2] > 75.0


@pytest.mark.parametrize("dpi", [72, 96, 300, 1200])
def test_a_png_has_the_pixels_that_its_inches_take(dpi, tmp_path):
    export(SEVENTY, tmp_path / "a.png", Options(unit="mm", dpi=dpi))
    image = QImage(str(tmp_path / "a.png"))
    assert image.width() == round(picture_box(SEVENTY)[2] / 25.4 * dpi)
    assert image.dotsPerMeterX() == pytest.approx(dpi / 0.0254, rel=2e-3)


def test_pixels_for_each_inch_need_a_unit(tmp_path):
    with pytest.raises(ExchangeError, match="needs a unit of length"):
        export(SEVENTY, tmp_path / "a.png", Options(dpi=300))


def test_the_command_line_counts_pixels_by_inches(tmp_path, capsys):
    path, picture = tmp_path / "a.curve.json", tmp_path / "a.png"
    save(path, replace(SEVENTY, unit="cm"))
    assert main(["render", str(path), "-o", str(picture), "--dpi", "30"]) == 0
    assert QImage(str(picture)).width() == round(picture_box(SEVENTY)[2] * 10 / 25.4 * 30)
    assert main(["convert", str(path), str(picture), "--dpi", "60"]) == 0
    assert QImage(str(picture)).width() == round(picture_box(SEVENTY)[2] * 10 / 25.4 * 60)
    save(path, SEVENTY)
    assert main(["render", str(path), "-o", str(picture), "--dpi", "300"]) != 0
    assert "needs a unit of length" in capsys.readouterr().err


def test_the_command_line_accepts_either_the_width_or_the_resolution(tmp_path, capsys):
    """The width won, and nothing was said."""
    path = tmp_path / "a.curve.json"
    save(path, replace(SEVENTY, unit="mm"))
    with pytest.raises(SystemExit):
        main(["render", str(path), "-o", str(tmp_path / "a.png"), "--dpi", "30", "--width", "90"])
    assert "not allowed with" in capsys.readouterr().err
