"""Texts whose words fill a frame: read as Inkscape writes them, and written so that it knows them."""

from __future__ import annotations

import re
import shutil
import subprocess
import xml.etree.ElementTree as ET

import numpy as np
import pytest
from msgspec.structs import replace

from app.document.content import Anchor
from app.document.contents import corners_of, shortened
from app.document.several_curves import add_copies
from app.document.wrapping import laid_out
from app.document.wrapping import lines_of as lines_of_text
from app.exchange.options import Options
from app.exchange.svg.in_place.rewriting import rewritten
from app.exchange.svg.reader import read_svg
from app.exchange.svg.writer import svg_of
from app.features.text import flowing
from app.qt.contents import measured, painted_letters
from app.view_model.shapes.formed import formed, with_form
from tests.exchange.test_contents_in_place import opened

FONT = "font-family:'DejaVu Sans';font-size:16px;line-height:1.25;white-space:pre"
WORDS = "The quick brown fox jumps over the lazy dog, and then it runs away."
FILE = f"""<svg xmlns="http://www.w3.org/2000/svg" width="400" height="400" viewBox="0 0 400 400">
<defs><rect id="r1" x="50" y="40" width="200" height="120"/></defs>
<text xml:space="preserve" id="framed" style="{FONT};shape-inside:url(#r1);text-align:end"><tspan
 x="83" y="54">The quick brown fox </tspan><tspan x="51" y="74">jumps over the lazy dog, </tspan><tspan
 x="70" y="94">and then it runs away.
</tspan><tspan x="80" y="114">A second paragraph.</tspan></text>
<text xml:space="preserve" id="wide" x="50" y="250" style="{FONT};inline-size:200">{WORDS}</text>
<flowRoot xml:space="preserve" id="old" style="{FONT}"><flowRegion><rect x="50" y="300" width="200"
 height="80"/></flowRegion><flowPara>{WORDS}</flowPara><flowPara>And <flowSpan
 style="font-weight:bold">more</flowSpan>.</flowPara></flowRoot></svg>"""
"""As Inkscape 1.2 and 0.92 write them."""
FRAMED, WIDE, OLD = range(3)
LINES = ["The quick brown fox ", "jumps over the lazy dog, ", "and then it runs away."]


@pytest.fixture
def drawing(qapp):
    """What is read of it, as it is in the fonts here."""
    return measured(read_svg(FILE.encode()).document)


def lines_of(curve):
    return [line.words for line in laid_out(curve.form).lines]


def test_all_three_come_in_as_words_that_wrap(drawing):
    framed, wide, old = drawing.curves
    assert [line.words for line in framed.form.lines] == [WORDS, "A second paragraph."]
    assert framed.form.lines[0].anchor is Anchor.END
    assert framed.form.box == (50, 40, 250, 160)
    assert lines_of(framed) == [*LINES, "A second paragraph."]
    # As Inkscape 1.2.2 has them.
    assert [line.y for line in laid_out(framed.form).lines[:3]] == pytest.approx(
        [54.15625, 74.15625, 94.15625]
    )
    assert laid_out(old.form).lines[0].y == pytest.approx(314.15625)
    assert lines_of(wide) == LINES
    assert [line.y for line in laid_out(wide.form).lines] == pytest.approx([250, 270, 290])
    assert wide.form.flow.grows
    # As high as what is in it.
    assert wide.form.box[3] - wide.form.box[1] == pytest.approx(60)
    assert lines_of(old) == [*LINES, "And more."]
    assert [run.weight for run in old.form.lines[1].runs] == [400, 700, 400]


def test_they_come_back_from_a_new_file_and_each_line_has_a_place(drawing):
    text = svg_of(drawing, Options(tells_exactness=False)).text
    back = measured(read_svg(text.encode()).document)
    for here, there in zip(back.curves, drawing.curves, strict=True):
        assert (here.form.flow, lines_of(here)) == (there.form.flow, lines_of(there))
        assert here.form.box == pytest.approx(there.form.box)
    texts = [each for each in ET.fromstring(text).iter() if each.tag.endswith("text")]
    places = [
        [(float(each.get("x")), float(each.get("y"))) for each in text if each.get("x")] for text in texts
    ]
    for curve, found in zip(drawing.curves, places, strict=True):
        laid = [(line.x, line.y) for line in laid_out(curve.form).lines]
        assert found == [pytest.approx(each) for each in laid]


@pytest.mark.skipif(shutil.which("inkscape") is None, reason="Inkscape is not installed")
def test_inkscape_wraps_what_is_written_at_the_same_words(drawing, tmp_path):
    path, out = tmp_path / "ours.svg", tmp_path / "theirs.svg"
    # What it lays out anew, and not what stands in the file.
    text = re.sub(r'<tspan x="[^"]*" y="[^"]*"', '<tspan x="1" y="1"', svg_of(drawing).text)
    path.write_text(text, encoding="utf-8")
    actions = f"select-all;transform-translate:1,0;export-filename:{out};export-do"
    subprocess.run(["inkscape", path, f"--actions={actions}"], check=True, capture_output=True, timeout=60)
    for element, curve in zip(
        [each for each in ET.parse(out).iter() if each.tag.endswith("text")], drawing.curves, strict=True
    ):
        rows = [row for row in element if row.get("x")]
        assert ["".join(row.itertext()).rstrip("\n") for row in rows] == lines_of(curve)
        for row, line in zip(rows, laid_out(curve.form).lines, strict=True):
            assert float(row.get("y")) == pytest.approx(line.y, abs=0.05)


def lines_seen(curve):
    return lines_of_text(curve.form)


def changed(document, place, make):
    return document.with_curve(place, make(document.curves[place]))


def reworded(curve):
    form = curve.form
    (run, *_), *rest = (line.runs for line in form.lines)
    lines = (replace(form.lines[0], runs=(replace(run, words=f"Some more. {run.words}"),)), *form.lines[1:])
    assert len(rest) == len(lines) - 1
    new = replace(form, lines=lines)
    return replace(curve, form=new, name=shortened(new.title))


@pytest.mark.parametrize("place", [FRAMED, WIDE])
@pytest.mark.parametrize("edit", ["words", "frame", "lines"])
def test_in_place_only_what_was_changed_changes(drawing, place, edit):
    begun = opened(FILE.encode())
    if edit == "words":
        document = changed(begun, place, reworded)
    elif edit == "frame":
        now = formed(begun.curves[place])
        document = with_form(begun, place, now.form.with_number("width", 150.0), now.by)
    else:
        document = changed(begun, place, flowing.in_lines)
    document = measured(document)
    result = rewritten(FILE.encode(), document, begun)
    assert result is not None
    text = result.data.decode()
    pieces = {
        name: re.search(f'<text [^>]*id="{name}".*?</text>', FILE, re.DOTALL)[0]
        for name in ("framed", "wide")
    }
    assert pieces["wide" if place == FRAMED else "framed"] in text
    assert FILE[FILE.index("<flowRoot") :] in text
    # The frame of words is not that of another text.
    assert text.count("<rect") == 2
    again = opened(result.data)
    for here, there in zip(again.curves, document.curves, strict=True):
        assert here.form.flow == there.form.flow
        assert [line.words.strip() for line in lines_seen(here)] == [
            line.words.strip() for line in lines_seen(there)
        ]
        assert np.ravel(corners_of(here)) == pytest.approx(np.ravel(corners_of(there)), abs=1e-6)
    assert rewritten(result.data, document, document).data == result.data


def test_a_new_text_in_a_frame_is_put_into_a_file(drawing):
    begun = opened(FILE.encode())
    copied = add_copies(begun, {FRAMED}).document
    result = rewritten(FILE.encode(), copied, begun)
    assert result is not None
    again = opened(result.data)
    frames = [each for each in again.curves if each.form.flow is not None and not each.form.flow.grows]
    assert len(frames) == 3
    text = result.data.decode()
    assert len(set(re.findall(r"shape-inside:url\(#(\w+)\)", text))) == 2


JUSTIFIED = FILE.replace("text-align:end", "text-align:justify").replace(
    "inline-size:200", "inline-size:200;text-align:justify"
)
STRETCHES = {FRAMED: [12.795, 0.438, 0.0, 0.0], WIDE: [12.795, 0.438, 0.0]}
"""What Inkscape 1.2.2 puts between their words, line by line, but for its rounding."""


def right_of(line):
    """Return where the ink of a line ends."""
    return max(path.boundingRect().right() for _, path in painted_letters((line,)))


def gaps(row):
    """Return what letters of a line are moved by in a file, each amount once."""
    ways = [way for each in row.iter() for way in each.get("dx", "").split()]
    return {round(float(way), 1) for way in ways} - {0.0}


def test_justified_lines_are_as_wide_as_their_frame_and_as_inkscape_has_them(qapp, tmp_path):
    document = measured(read_svg(JUSTIFIED.encode()).document)
    for place, expected in STRETCHES.items():
        form = document.curves[place].form
        assert form.flow.is_justified
        assert laid_out(form).stretches == pytest.approx(expected, abs=2e-3)
        rights = [right_of(line) for line in laid_out(form).lines]
        # But for the white of a comma, an eighth of an em at most.
        assert rights[:2] == pytest.approx([form.box[2]] * 2, abs=2.0)
        assert max(rights[2:]) < form.box[2] - 5
    assert not document.curves[OLD].form.flow.is_justified
    text = svg_of(document).text
    back = measured(read_svg(text.encode()).document)
    assert [each.form.flow for each in back.curves] == [each.form.flow for each in document.curves]
    assert [each.form.lines for each in back.curves] == [each.form.lines for each in document.curves]
    if shutil.which("inkscape") is None:
        return
    path, out = tmp_path / "ours.svg", tmp_path / "theirs.svg"
    path.write_text(text, encoding="utf-8")
    actions = f"select-all;transform-translate:1,0;export-filename:{out};export-do"
    subprocess.run(["inkscape", path, f"--actions={actions}"], check=True, capture_output=True, timeout=60)
    ours, theirs = (
        [[gaps(row) for row in each if row.get("x")] for each in root.iter() if each.tag.endswith("text")]
        for root in (ET.fromstring(text), ET.parse(out))
    )
    assert ours == theirs


def test_in_place_lines_are_justified_and_not_any_more(drawing):
    def standing(document, data, *, justified):
        form = document.curves[FRAMED].form
        lines = tuple(replace(line, anchor=Anchor.START) for line in form.lines)
        new = replace(form, lines=lines, flow=replace(form.flow, is_justified=justified))
        after = changed(document, FRAMED, lambda curve: replace(curve, form=new))
        data = rewritten(data, measured(after), document).data
        return opened(data), data

    first, data = standing(opened(FILE.encode()), FILE.encode(), justified=True)
    assert first.curves[FRAMED].form.flow.is_justified
    assert data.count(b"text-align:") == 1
    second, data = standing(first, data, justified=False)
    flow, lines = second.curves[FRAMED].form.flow, second.curves[FRAMED].form.lines
    assert not flow.is_justified
    # What stood at the right in the file at first does so no more.
    assert lines[0].anchor is Anchor.START
    assert b"dx=" not in data
