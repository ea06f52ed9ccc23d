"""What files of older versions hold besides: it is dropped, counted and told."""

from __future__ import annotations

import json
import re

import pytest

from app.cli import main
from app.document.model import Axis, Document, Guide, make_curve
from app.document.style import Style
from app.storage import migration
from app.storage.files import load
from app.storage.format import decode, decode_counting, encode
from app.storage.format_error import FormatError
from app.storage.migration import Dropped, Holder, LeftOut
from app.storage.open_file import OpenFile
from app.storage.recovery import SnapshotFile, SnapshotOrigin, list_snapshots
from tests.rows import each_row

KEPT = {"kept_texts": [{"x": 1.0}, {"x": 2.0, "follows": True}, {"x": 3.0}], "kept_pictures": [{}]}
"""Two texts, of which one has two lines, and a picture, as version 2 had them at first."""


def curve(name="a", **more):
    points = [{"x": 0.0, "y": 0.0}, {"x": 1.0, "y": 1.0}]
    return {
        "name": name,
        "family": "lagrange",
        "parametrization": {"kind": "uniform"},
        "points": points,
    } | more


def older(*curves, **more):
    """The content of a file of version 2."""
    values = {"format": "curvebench", "version": 2, "curves": list(curves) or [curve()]}
    return json.dumps(values | more).encode()


@pytest.fixture
def with_rows(monkeypatch):
    """Rows and kinds of forms added to those that there are."""

    def add(*rows, forms=()):
        monkeypatch.setattr(migration, "DROPPED", [*migration.DROPPED, *rows])
        monkeypatch.setattr(migration, "DROPPED_FORMS", migration.DROPPED_FORMS | dict(forms))

    return add


@pytest.fixture
def path(tmp_path):
    path = tmp_path / "logo.curve.json"
    path.write_bytes(older(**KEPT))
    return path


def test_fields_of_the_document_are_dropped_and_counted():
    found = decode_counting(older(**KEPT))
    assert found.left_out == LeftOut({"text": 2, "picture": 1}, ("2 texts", "1 picture"))
    assert decode(encode(found.document)) == found.document


def test_layers_are_groups_and_empty_ones_are_dropped_and_counted():
    empty = [{"name": "Sketch", "inside": "", "visible": False}]
    found = decode_counting(older(curve(groups=["Art"]), layers=["Art", "Sketch"], empty_layers=empty))
    assert found.document.curves[0].groups == ("Art",)
    assert found.left_out == LeftOut({"empty layer": 1}, ("1 empty layer",))


def test_leaning_guides_are_dropped_and_counted():
    upright = {"axis": "x", "position": 2.0, "lean": 0.0, "across": 0.0, "locked": True}
    leaning = {"axis": "y", "position": 1.0, "lean": 30.0, "across": 4.0}
    found = decode_counting(older(guides=[upright, leaning]))
    assert found.document.guides == (Guide(Axis.X, 2.0),)
    assert found.left_out == LeftOut({"leaning guide": 1}, ("1 leaning guide",))


def test_a_file_without_dropped_features_has_no_message():
    assert not decode_counting(older()).left_out
    assert not decode_counting(older(kept_texts=[], kept_pictures=[])).left_out
    assert not decode_counting(encode(decode(older()))).left_out


@pytest.mark.parametrize(
    ("count", "words"),
    [
        (1, "“a.json” was made with a version that had more features: 1 text was left out."),
        (3, "“a.json” was made with a version that had more features: 3 texts were left out."),
    ],
)
def test_the_message_counts_dropped_features(count, words):
    assert decode_counting(older(kept_texts=[{}] * count)).left_out.sentence("a.json") == words


def test_texts_and_pictures_are_dropped_and_letters_stay():
    box = {"x": 0.0, "y": 0.0, "width": 1.0, "height": 1.0}
    found = decode_counting(
        older(
            curve("Dear Sir", form={"kind": "lettering", "lines": [{"x": 0.0}], **box}),
            curve("photo", form={"kind": "picture", "data": "", **box}),
            curve("I", text={"words": "I", "font": "Sans", "x": 0.0, "y": 0.0, "size": 3.0}),
        )
    )
    assert found.left_out.words == ("1 text", "1 picture")
    assert [each.name for each in found.document.curves] == ["I"]


def test_a_rectangle_keeps_its_points():
    form = {"kind": "rectangle", "x": 0.0, "y": 0.0, "width": 1.0, "height": 1.0, "rx": 0.25}
    found = decode_counting(older(curve(form=form)))
    assert not found.left_out
    assert found.document == decode_counting(older(curve())).document


@each_row("version", [1, 2])
@each_row("number", ["1" * 5000, "-1e999"])
def test_a_number_beyond_the_limits_is_refused_with_its_field(version, number):
    """It was “[...][0][...][0][...]”: msgspec has no names where it reads without types."""
    data = older().replace(b'"version": 2', b'"version": %d' % version)
    data = re.sub(rb'"x": [^,}]+', b'"x": ' + number.encode(), data, count=1)
    with pytest.raises(FormatError, match=r"^curves\[0\]\.points\[0\]\.x must lie between -1e12 and 1e12"):
        decode(data)


def test_a_file_of_this_version_with_dropped_fields_is_refused():
    with pytest.raises(FormatError, match="kept_texts"):
        decode(older(**KEPT).replace(b'"version": 2', b'"version": 4'))


def test_fields_of_curves_styles_and_guides_are_dropped_and_counted(with_rows):
    with_rows(
        Dropped(Holder.CURVE, "glow", "glow"),
        Dropped(Holder.STYLE, "order", "paint order", is_loss=lambda value: value != "normal"),
        Dropped(Holder.STYLE, "veils", "veil", is_shared=True),
        Dropped(Holder.GUIDE, "colour"),
        Dropped(Holder.DOCUMENT, "boxes", "box", "boxes"),
    )
    found = decode_counting(
        older(
            curve("a", glow=2.0, style={"order": "normal", "veils": [{"x": 1}, {"x": 2}]}),
            curve("b", glow=0.0, style={"order": "stroke", "veils": [{"x": 1}], "width": 2.0}),
            guides=[{"axis": "x", "position": 1.0, "colour": "#ff0000"}],
            boxes=[1, 2],
        )
    )
    assert found.left_out.words == ("1 glow", "1 paint order", "2 veils", "2 boxes")
    assert [each.style.width for each in found.document.curves] == [None, 2.0]
    assert found.document.guides[0].position == 1.0


def test_a_field_can_be_counted_by_several_nouns_and_mended(with_rows):
    def fade(style, value):
        style["fill_opacity"] = style.get("fill_opacity", 1.0) * value["opacity"]

    with_rows(
        Dropped(Holder.STYLE, "paint", "mosaic", is_loss=lambda value: value["kind"] == "pattern", mend=fade),
        Dropped(Holder.STYLE, "paint", "wash", "washes", is_loss=lambda value: value["kind"] != "pattern"),
    )
    styles = [{"paint": {"kind": kind, "opacity": 0.5}} for kind in ("linear", "pattern", "radial")]
    found = decode_counting(older(*(curve(str(at), style=style) for at, style in enumerate(styles))))
    assert found.left_out.words == ("1 mosaic", "2 washes")
    assert [each.style.fill_opacity for each in found.document.curves] == [0.5] * 3


def test_curves_of_a_dropped_form_are_counted_by_kind(with_rows):
    with_rows(forms={"note": "note"})
    found = decode_counting(older(curve("a", form={"kind": "note"}), curve("b")))
    assert found.left_out.words == ("1 note",)
    assert [each.name for each in found.document.curves] == ["b"]
    found = decode_counting(older(curve("a", form={"kind": "note"}), curve("b", form={"kind": "note"})))
    assert found.left_out.words == ("2 notes",)
    assert found.document == Document((make_curve(()),))


@each_row(
    ("values", "complaint"),
    [
        ({"curves": 7}, "curves must be a list"),
        ({"curves": [7]}, r"curves\[0\] must be an object"),
        ({"curves": [curve(style=7)]}, r"curves\[0\]\.style must be an object"),
        ({"guides": 7}, "guides must be a list"),
        ({"guides": [7]}, r"guides\[0\] must be an object"),
    ],
)
def test_invalid_values_in_an_old_file_are_refused_with_their_field(values, complaint):
    with pytest.raises(FormatError, match=complaint):
        decode(older(**values))


def test_an_open_file_counts_dropped_features_until_saved(path):
    opened = OpenFile.open(path)
    assert opened.file.left_out.words == ("2 texts", "1 picture")
    OpenFile.saved(path, opened.document, opened.file)
    assert not opened.file.left_out
    assert path.with_name("logo.curve.json.v2.bak").read_bytes() == older(**KEPT)
    opened.file.close()


def test_a_reloaded_or_adopted_file_counts_dropped_features(path):
    content = path.read_bytes()
    path.write_bytes(encode(load(path)))
    file = OpenFile.open(path).file
    path.write_bytes(content)
    file.read_again()
    assert file.left_out
    assert file.is_older
    file.close()
    file = OpenFile.adopt(path)
    assert file.left_out
    assert file.is_older
    file.close()


def test_a_snapshot_of_an_older_version_counts_dropped_features(path, tmp_path, monkeypatch):
    """It is not taken for saved, although all that is left of it stands in the file."""
    snapshot = SnapshotFile(tmp_path / "state")
    monkeypatch.setattr("app.storage.recovery.encode", lambda _document: older(**KEPT))
    snapshot.write(load(path), SnapshotOrigin(path))
    snapshot.leave()
    (found,) = list_snapshots(tmp_path / "state").snapshots
    assert found.left_out.words == ("2 texts", "1 picture")
    found.discard()


SENTENCE = (
    "“logo.curve.json” was made with a version that had more features: 2 texts and 1 picture were left out."
)


def test_the_command_line_reports_dropped_features(path, tmp_path, capsys):
    for words in (
        ["info", str(path)],
        ["render", str(path), "-o", str(tmp_path / "a.svg")],
        ["convert", str(path), str(tmp_path / "b.svg")],
    ):
        assert main(words) == 0
        assert capsys.readouterr().err == f"curvebench: {SENTENCE}\n"
    assert main(["info", "--json", str(path)]) == 0
    assert json.loads(capsys.readouterr().out)["left_out"] == {"text": 2, "picture": 1}
    assert main(["convert", "--json", str(path), str(tmp_path / "c.svg")]) == 0
    assert json.loads(capsys.readouterr().out)["remarks"] == [SENTENCE]


def test_the_mean_colour_of_a_gradient_gets_its_mean_opacity():
    stops = [{"offset": 0.0, "colour": "#ff0000"}, {"offset": 1.0, "colour": "#ff0000", "opacity": 0.0}]
    fading = {"fill": "#ff0000", "fill_opacity": 0.5, "fill_gradient": {"stops": stops}}
    tile = {"body": "<path d='M0 0H4V8H0Z'></path>", "view": [0.0, 0.0, 8.0, 8.0]}
    tiled = {"stroke": "#0000ff", "stroke_gradient": {"stops": stops, "kind": "pattern", "tile": tile}}
    found = decode_counting(older(curve("a", style=fading), curve("b", style=tiled), curve("c")))
    assert found.left_out.words == ("1 gradient", "1 pattern")
    first, second, _ = (each.style for each in found.document.curves)
    assert (first.fill, first.fill_opacity) == ("#ff0000", 0.25)
    assert (second.stroke, second.stroke_opacity) == ("#0000ff", 1.0)


# Looks that curves do not have

MASK = {
    "tile": {"body": "<rect width='1' height='1'/>", "view": [0.0, 0.0, 1.0, 1.0]},
    "start": [0.0, 0.0],
    "end": [1.0, 0.0],
    "side": [0.0, 1.0],
}


def styled(*styles, **more):
    """The content of a file of version 2 whose curves have these styles, and all of them `more`."""
    return older(*(curve(str(at), style=style, **more) for at, style in enumerate(styles)))


@each_row(
    ("styles", "words"),
    [
        ([{"start_marker": "dot", "end_marker": "arrow"}, {"end_marker": "bar"}], "3 arrowheads"),
        ([{"blur": 0.5}, {"blur": 2.0}], "2 blurs"),
        ([{"masks": [MASK, MASK]}, {"masks": [MASK | {"is_alpha": True}]}], "2 masks"),
        ([{"clips": [{}]}, {"clips": [{}]}], "1 clip"),
        ([{"paint_order": "stroke"}], "1 order of fill and line"),
        ([{"paint_order": "stroke"}] * 2, "2 orders of fill and line"),
    ],
)
def test_visible_dropped_features_are_counted(styles, words):
    found = decode_counting(styled(*styles))
    assert found.left_out.words == (words,)
    assert {each.style for each in found.document.curves} == {Style()}


def test_invisible_dropped_features_are_not_counted():
    assert not decode_counting(
        styled({"start_marker": "none", "paint_order": "normal", "blur": 0.0, "masks": [], "clips": []})
    ).left_out


def test_opacities_of_curves_and_groups_become_opacities_of_stroke_and_fill():
    looks = [{"name": "Outer", "opacity": 0.5}, {"name": "Inner"}]
    styles = {"opacity": 0.5, "fill_opacity": 0.25}, {}
    found = decode_counting(styled(*styles, groups=["Outer", "Inner"], group_looks=looks))
    opacities = [(each.style.stroke_opacity, each.style.fill_opacity) for each in found.document.curves]
    assert opacities == [(0.25, 0.0625), (0.5, 0.5)]
    assert found.left_out.words == ("1 opacity of a group",)


def test_an_opacity_of_fill_and_stroke_together_is_counted_if_both_are_painted():
    styles = {"opacity": 0.5, "fill": "#ff0000"}, {"opacity": 0.5}, {"opacity": 1.0, "fill": "#ff0000"}
    assert decode_counting(styled(*styles)).left_out.words == ("1 opacity of fill and stroke together",)


@pytest.mark.parametrize("opacity", [1.5, -1, "half"])
def test_an_invalid_opacity_is_refused(opacity):
    with pytest.raises(FormatError, match=r"curves\[0\]\.style\.stroke_opacity must"):
        decode_counting(styled({"opacity": opacity}))
