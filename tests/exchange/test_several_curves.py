"""Documents of several curves, hidden, coloured, closed and with corners, on their way out."""

from __future__ import annotations

import json
from xml.etree import ElementTree

import numpy as np
import pytest
from msgspec.structs import replace

from app.cli import main
from app.document import point_edits
from app.document.model import Document, make_curve
from app.document.style import Style
from app.exchange.drawing.drawing import drawing_of
from app.exchange.drawing.styles import INK
from app.exchange.errors import ExchangeError
from app.exchange.facts import facts_of
from app.exchange.files import export
from app.exchange.options import Options
from app.exchange.svg.reader import read_svg
from app.exchange.svg.writer import svg_of
from app.exchange.unique_names import UniqueNames
from app.families import FAMILIES
from app.storage.files import save
from app.view_model.curve.curve_view import view_of

SQUARE = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)]
SVG = "{http://www.w3.org/2000/svg}"


@pytest.fixture(params=[family for family in FAMILIES if family.derivatives])
def document(request):
    """A closed blue curve with a corner, a hidden one, and one in ink."""
    closed = replace(
        make_curve(SQUARE, name="Pond", family=request.param), closed=True, style=Style(stroke="#0072b2")
    )
    hidden = replace(make_curve([(50.0, 50.0), (90.0, 0.0)], name="Secret"), visible=False)
    ink = make_curve([(0.0, 3.0), (2.0, 4.0)], name="Line")
    return point_edits.make_corner(Document((closed, hidden, ink)), 0, 2, None, None)


def paths(document, **options):
    root = ElementTree.fromstring(svg_of(document, Options(**options)).text)
    return {path.get("id"): path for path in root.iter(f"{SVG}path")}


def test_hidden_curves_are_not_drawn_and_not_in_the_frame(document):
    drawing = drawing_of(document)
    assert [outline.name for outline in drawing.outlines] == ["Pond", "Line"]
    assert drawing.frame.width < 10
    assert drawing.left_out == ()


def test_svg_stores_hidden_curves_in_order_without_display(document):
    found = paths(document)
    assert [(name, path.get("display")) for name, path in found.items()] == [
        ("Pond", None),
        ("Secret", "none"),
        ("Line", None),
    ]
    seen = Document(tuple(curve for curve in document.curves if curve.visible))
    assert drawing_of(document, with_hidden=True).frame == drawing_of(seen).frame
    back = read_svg(svg_of(document).data).document
    assert [(curve.name, curve.visible) for curve in back.curves] == [
        ("Pond", True),
        ("Secret", False),
        ("Line", True),
    ]
    ends = back.curves[1].points[0], back.curves[1].points[-1]
    assert [point.position for point in ends] == [(50.0, 50.0), (90.0, 0.0)]


def test_each_curve_has_its_own_colour(document):
    found = paths(document)
    assert found["Pond"].get("stroke") == "#0072b2"
    assert found["Line"].get("stroke") == INK.ink
    root = ElementTree.fromstring(svg_of(document, Options(points=True)).text)
    fills = [circle.get("fill") for circle in root.iter(f"{SVG}circle")]
    assert fills == ["#0072b2"] * 4 + [None] * 2


def test_a_closed_path_is_closed_and_ends_at_its_start(document):
    data = paths(document)["Pond"].get("d")
    assert data.endswith("Z")
    assert not paths(document)["Line"].get("d").endswith("Z")
    (pond, _) = drawing_of(document).outlines
    assert pond.control_points[-1, 3].tolist() == pond.control_points[0, 0].tolist()
    assert len(pond.points) == 4


def test_a_corner_stays_sharp(document):
    (pond, _) = drawing_of(document).outlines
    view = view_of(document.curves[0])
    at_corner = [i for i, piece in enumerate(pond.control_points) if piece[0].tolist() == [2.0, 2.0]]
    (piece,) = at_corner
    ahead = pond.control_points[piece, 1] - pond.control_points[piece, 0]
    behind = pond.control_points[piece - 1, 3] - pond.control_points[piece - 1, 2]
    for arrow, is_ahead in ((ahead, True), (behind, False)):
        velocity = np.array(view.velocity_of(2, ahead=is_ahead))
        assert arrow[0] * velocity[1] == pytest.approx(arrow[1] * velocity[0], abs=1e-6)
        assert arrow @ velocity > 0
    assert abs(ahead[0] * behind[1] - ahead[1] * behind[0]) > 1e-6


@pytest.mark.parametrize("ending", ["png", "pdf", "svg"])
def test_every_format_writes_several_curves(document, ending, tmp_path):
    target = tmp_path / f"out.{ending}"
    export(document, target, Options(width=200, points=True))
    assert target.stat().st_size > 300


def test_a_png_shows_the_colour(document, tmp_path):
    images = pytest.importorskip("PySide6.QtGui")
    export(document, tmp_path / "out.png", Options(width=1200))
    image = images.QImage(str(tmp_path / "out.png")).convertToFormat(images.QImage.Format.Format_RGB32)
    assert 0xFF0072B2 in np.frombuffer(image.constBits(), np.uint32)


def test_a_document_of_hidden_curves_draws_nothing(document):
    hidden = Document(tuple(replace(curve, visible=False) for curve in document.curves))
    with pytest.raises(ExchangeError, match="all curves are hidden"):
        drawing_of(hidden)


def test_facts_know_closed_corners_and_hidden(document):
    pond, secret, line = facts_of(document)
    assert (pond.closed, pond.corners, pond.visible) == (True, 1, True)
    assert (secret.closed, secret.corners, secret.visible) == (False, 0, False)
    assert secret.box is not None
    assert secret.warnings == ()
    assert pond.length.value > 6
    assert line.length.value == pytest.approx(5**0.5)


def test_info_prints_the_facts_of_several_curves(document, tmp_path, capsys):
    save(tmp_path / "a.curve.json", document)
    assert main(["info", str(tmp_path / "a.curve.json")]) == 0
    text = capsys.readouterr().out
    assert "4, closed, 1 of them a corner" in text
    assert "not drawn in pictures" in text
    assert main(["info", "--json", str(tmp_path / "a.curve.json")]) == 0
    first, second, _ = json.loads(capsys.readouterr().out)["curves"]
    assert (first["closed"], first["corners"], second["visible"]) == (True, 1, False)


def test_names_of_many_curves_are_looked_up_as_often_as_there_are_curves():
    """Of n curves of one name the last tried n numbers in a list of n: n**3 comparisons in all."""

    class Counting(set):
        looked_up = 0

        def __contains__(self, name):
            self.looked_up += 1
            return super().__contains__(name)

    taken = Counting({"a 3"})
    names = UniqueNames(taken)
    given = [names.unique("a") for _ in range(1000)]
    assert given[:4] == ["a", "a 2", "a 4", "a 5"]
    assert len(set(given)) == 1000
    assert taken.looked_up <= 2100
    assert names.unique("a 2") == "a 2 2"
