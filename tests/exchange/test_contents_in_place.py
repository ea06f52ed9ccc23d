"""Texts and pictures of an overwritten SVG: what was changed is all that changes, and it looks as here."""

from __future__ import annotations

import shutil
import subprocess
from contextlib import nullcontext
from itertools import groupby
from operator import itemgetter
from pathlib import Path

import numpy as np
import pytest
from msgspec.structs import astuple, replace
from PySide6.QtGui import QImage

from app.document.clones import add_clones
from app.document.content import Lettering, Picture
from app.document.contents import corners_of
from app.document.form_edits import formed_anew
from app.document.forms import Rectangle
from app.document.layers import moved_to_layer
from app.document.model import make_curve
from app.document.several_curves import (
    add_copies,
    add_imported,
    in_order,
    mapped,
    remove_curves,
    stepped,
    whole_curves,
    with_appearance,
)
from app.document.shape_edits import grouped, ungrouped
from app.document.style import NO_PAINT, Style
from app.document.style_edits import with_style
from app.document.transforms import rotation, scaling
from app.document.value import Value
from app.exchange.corner import from_lower_left
from app.exchange.drawing.image import png_file
from app.exchange.drawing.styles import LIGHT
from app.exchange.linked import with_files
from app.exchange.options import Options
from app.exchange.svg.in_place.rewriting import rewritten
from app.exchange.svg.in_place.source import Source
from app.exchange.svg.reader import read_svg
from app.exchange.svg.writer import svg_of
from app.features.text import outlined, wording
from app.qt.contents import measured
from app.qt.glyphs import has_fonts
from app.session import Session
from app.view_model.shapes.clipping import with_clip_set

FOLDER = Path(__file__).parents[1] / "data" / "overwrite"
LETTER = (FOLDER / "letter.svg").read_bytes()
BAND, LINE_OF_TEXT, MANY_LINES, RULE, SLOPE, HELD, LINKED, USED, LINE = range(9)
TEXTS = {"a line": LINE_OF_TEXT, "several lines": MANY_LINES, "in a turned group": SLOPE, "a used one": USED}
PICTURES = {"a picture": HELD, "a linked picture": LINKED}
OTHER = (
    '<svg xmlns="http://www.w3.org/2000/svg" width="200mm" height="120mm" viewBox="0 0 200 120">'
    '<text x="90" y="50" transform="rotate(20)" font-family="No Such Font, DejaVu Sans" font-size="7" '
    'fill="#aa00aa">Foreign <tspan fill="#00aa00">green</tspan></text></svg>'
)


def opened(data):
    """The file as the window opens it."""
    return measured(from_lower_left(with_files(read_svg(data).document, FOLDER)))


@pytest.fixture(scope="module")
def letter(qapp):
    if not has_fonts():
        pytest.skip("there is no font")
    return opened(LETTER)


def edited(document, edit):
    """The document after an edit that passes the door, as a person makes it."""
    session = Session()
    session.change("Open", lambda _: document)
    assert session.change("Edit", edit).is_done
    return session.document


def about(document, place, by, *numbers):
    middle = tuple(np.mean(corners_of(document.curves[place]), axis=0).tolist())
    return mapped(document, whole_curves(document, {place}), by(*numbers, middle))


def reworded(document, place, change):
    """Type into a text: `change` gets its lines, of letters each with how it looks."""
    known = wording.worded_at(document, place)
    lines = [[(letter, part.look) for part in line for letter in part.words] for line in known.typed]
    typed = tuple(
        tuple(
            wording.Letters("".join(letter for letter, _ in part), look)
            for look, part in ((look, list(part)) for look, part in groupby(line, itemgetter(1)))
        )
        for line in change(lines)
    )
    words = "\n".join("".join(part.words for part in line) for line in typed)
    now = replace(known.text, words=words)
    return wording.reworded(document, known, known.text, now, typed, document.curves[place].style)[0]


def other_words(document, place):
    table = {"Sir": "Madam", "and ": "or <", "& co": "& Sons"}

    def change(lines):
        for line in lines:
            for old, new in table.items():
                at = "".join(letter for letter, _ in line).find(old)
                if at >= 0:
                    line[at : at + len(old)] = [(letter, line[at][1]) for letter in new]
        return lines

    return reworded(document, place, change)


def further_line(lines):
    return [*lines, [(letter, lines[-1][-1][1]) for letter in "and  more"]]


def larger_and_bold(lines):
    return [
        [
            (letter, look._replace(run=replace(look.run, size=look.run.size * 1.5, weight=700.0)))
            for letter, look in line
        ]
        for line in lines
    ]


def beside(document, added):
    return stepped(document, whole_curves(document, added), (11.0, -9.0))


def copied(document, place):
    added = add_copies(document, {place})
    return beside(added.document, added.places)


def cloned(document, place):
    added = add_clones(document, {place}, lambda: "original")
    return beside(added.document, added.places)


def clipped(document, place):
    x, y = np.mean(corners_of(document.curves[place]), axis=0).tolist()
    groups = document.curves[place].groups
    front = formed_anew(make_curve([(0, 0), (1, 1)], name="Cut"), Rectangle(x - 9, y - 3, 18, 6, 0, 0))
    curves = list(document.curves)
    curves.insert(place + 1, replace(front, groups=groups))
    session = Session()
    session.change("Open", lambda _: replace(document, curves=tuple(curves)))
    return with_clip_set(session.document, session.views, {place, place + 1}).document


def at_end(document, place, *, front):
    """The document with one in front of all, or behind those in its group."""
    rest = [each for each in range(len(document.curves)) if each != place]
    at = len(rest) if front else {LINE_OF_TEXT: BAND, SLOPE: RULE}.get(place, MANY_LINES)
    return in_order(document, [*rest[:at], place, *rest[at:]])


ANY = {
    "moved": (lambda d, p: stepped(d, whole_curves(d, {p}), (7.0, -4.0)), MANY_LINES, USED),
    "turned": (lambda d, p: about(d, p, rotation, 30), SLOPE, HELD),
    "stretched": (lambda d, p: about(d, p, scaling, 1.5, 0.7), MANY_LINES, USED),
    "flipped": (lambda d, p: about(d, p, scaling, -1.0, 1.0), LINE_OF_TEXT, LINKED),
    "seen through": (lambda d, p: with_style(d, {p}, opacity=0.4), MANY_LINES, USED),
    "deleted": (lambda d, p: remove_curves(d, {p}), LINE_OF_TEXT, LINKED),
    "duplicated": (copied, SLOPE, LINKED),
    "cloned": (cloned, MANY_LINES, HELD),
    "in front of all": (lambda d, p: at_end(d, p, front=True), SLOPE, LINKED),
    "behind all": (lambda d, p: at_end(d, p, front=False), LINE_OF_TEXT, USED),
    "in the layer below": (lambda d, p: moved_to_layer(d, {p}, -1)[0].document, MANY_LINES, HELD),
    "grouped": (lambda d, p: grouped(d, {p, LINE}).document, SLOPE, LINKED),
    "renamed": (lambda d, p: d.with_curve(p, replace(d.curves[p], name="Renamed")), LINE_OF_TEXT, HELD),
    "hidden": (lambda d, p: with_appearance(d, {p}, visible=False), LINE_OF_TEXT, USED),
    "locked": (lambda d, p: with_appearance(d, {p}, locked=True), LINE_OF_TEXT, LINKED),
    "clipped": (clipped, SLOPE, LINKED),
    "coloured": (lambda d, p: with_style(d, {p}, fill="#ff00ff"), MANY_LINES, USED),
    "outlined": (lambda d, p: with_style(d, {p}, stroke="#008888", width=0.4), MANY_LINES, LINE_OF_TEXT),
    "with other words": (other_words, *TEXTS.values()),
    "with other words elsewhere": (
        lambda d, p: other_words(stepped(d, whole_curves(d, {p}), (7.0, -4.0)), p), MANY_LINES, LINE_OF_TEXT
    ),
    "with a further line": (
        lambda d, p: reworded(d, p, further_line), MANY_LINES, USED
    ),
    "larger and bold": (lambda d, p: reworded(d, p, larger_and_bold), LINE_OF_TEXT, SLOPE),
    "as paths": (lambda d, p: outlined.with_outlines(d, {p})[0], MANY_LINES, SLOPE),
}  # fmt: skip
CASES = {
    **{
        f"{name} {how}": (edit, place)
        for how, (edit, *places) in ANY.items()
        for name, place in (TEXTS | PICTURES).items()
        if place in places
    },
    "a group dissolved": (lambda d, p: ungrouped(d, {RULE, p}), RULE),
    "a text of another file": (lambda d, _: add_imported(d, opened(OTHER.encode()))[0], LINE),
}
IDS = {LINE_OF_TEXT: {"one", "again"}, USED: {"again"}, MANY_LINES: {"many"}, SLOPE: {"slope"}}
IDS |= {HELD: {"held"}, LINKED: {"linked"}, LINE: set(), RULE: {"turned", "rule", "slope"}}
KNOWN = Source(LETTER).ids
ELSEWHERE = ("in front of", "behind", "layer below", "grouped", "dissolved")
"""What is said of edits that put elements among others."""


@pytest.fixture(scope="module")
def as_begun(letter, tmp_path_factory):
    """How much of the file looks otherwise in other programs before anything is changed."""
    return difference(LETTER, letter, tmp_path_factory.mktemp("begun"))


@pytest.mark.parametrize(("edit", "place"), CASES.values(), ids=CASES)
def test_what_is_changed_is_all_that_changes_and_it_looks_as_here(
    letter, as_begun, edit, place, request, tmp_path
):
    after = edited(letter, lambda document: edit(document, place))
    result = rewritten(LETTER, after, letter)
    assert result is not None
    again = opened(result.data)
    # A clone is another text where it looks otherwise, as is told.
    lost = {"again"} if result.changes else set()
    assert [told for told in result.changes if "“again” became a text, because" not in told] == []
    assert len(again.curves) == len(after.curves)
    for mine, read in zip(after.curves, again.curves, strict=True):
        assert is_near(summary(replace(mine, clone=None) if mine.name in lost else mine), summary(read))
    assert rewritten(result.data, after, after).data == result.data
    name = request.node.callspec.id
    alone = any(word in name for word in ELSEWHERE)
    compared = tags if alone else without
    assert compared(result.data, IDS[place]) == compared(LETTER, IDS[place])
    # That has other ways from letter to letter where they are stretched between spans.
    if name not in ("several lines stretched",):
        # A stroke that is stretched is as wide all along here.
        room = 25 if name.startswith("in a turned group str") else 6
        assert difference(result.data, after, tmp_path) <= as_begun + room


def test_a_new_file_has_the_same_texts_and_pictures_and_looks_as_here(letter, as_begun, tmp_path):
    """What a frame shows of a picture that fits its place otherwise is all of that; its file is in it."""
    document = add_imported(letter, opened(OTHER.encode()))[0]
    data = svg_of(document, Options(unit="mm")).data
    again = opened(data)
    for mine, read in zip(document.curves, again.curves, strict=True):
        if mine.form != document.curves[LINKED].form:
            assert is_near(summary(mine), summary(read))
    assert again.curves[LINKED].form.data == document.curves[LINKED].form.data
    assert difference(data, document, tmp_path) <= as_begun + 6
    # A font that nobody has is asked for wherever the text goes.
    assert b"font-family=\"'No Such Font', 'DejaVu Sans'\"" in data
    assert rewritten(data, again, again).data == data


def summary(curve):
    """What of a curve is to be in the file: of a picture what is seen of it."""
    content = curve.form if isinstance(curve.form, (Lettering, Picture)) else None
    shows = content.lines if isinstance(content, Lettering) else content and (content.data, content.link)
    style = curve.style
    if isinstance(content, Picture):
        style = Style(stroke=NO_PAINT, opacity=style.opacity, clips=style.clips)
    if not style.has_stroke:
        of_fill = ("fill", "fill_opacity", "opacity", "fill_gradient", "clips")
        style = Style(stroke=NO_PAINT, **{name: getattr(style, name) for name in of_fill})
    places = [coordinate for point in curve.points for coordinate in point.position]
    said = (curve.name, curve.groups, curve.shape, curve.visible, curve.locked, curve.clone is None)
    return (*said, shows, style, *places)


def is_near(one, other):
    """Whether values are the same, but for rounding."""
    if isinstance(one, Value):
        return type(one) is type(other) and is_near(astuple(one), astuple(other))
    if isinstance(one, tuple):
        return len(one) == len(other) and all(map(is_near, one, other))
    return one == pytest.approx(other, abs=1e-4) if isinstance(one, float) else one == other


def tags(data, ids):
    """The tags of all elements but some, wherever these are."""
    found = {each.get("id"): each for each in Source(data).root.walk()}
    return {
        name: [(each, node.get(each)) for each in node.names]
        for name, node in found.items()
        if name in KNOWN and not any(around.get("id") in ids for around in line_of(node))
    }


def line_of(node):
    while node is not None:
        yield node
        node = node.parent


def without(data, ids):
    """The file without some elements, and those that were not in it before."""
    source = Source(data)
    for node in list(source.root.walk()):
        if node.parent is not None and (node.get("id") in ids or node.get("id") not in KNOWN):
            node.take_out()
    return source.text


def difference(data, document, folder):
    """By how much a block of pixels of ours is another one in librsvg, at most; of 255."""
    (folder / "colours.png").write_bytes((FOLDER / "colours.png").read_bytes())
    (folder / "a.svg").write_bytes(data)
    program = shutil.which("rsvg-convert")
    command = [program, "--width=800", "--background-color=white", "-o", "theirs.png", "a.svg"]
    # It draws while we do.
    with subprocess.Popen(command, cwd=folder) if program else nullcontext() as drawing:
        (folder / "ours.png").write_bytes(png_file(document, Options(width=800, style=LIGHT.on_page())).data)
        if drawing is None:
            return 0.0
        assert drawing.wait() == 0
    one, other = (blocks(folder / name) for name in ("ours.png", "theirs.png"))
    return np.abs(one - other).max()


def blocks(path):
    """The mean colours of blocks of 8 by 8 pixels."""
    image = QImage(str(path)).convertToFormat(QImage.Format.Format_RGB32)
    rows = np.frombuffer(image.constBits(), np.uint8).reshape(image.height(), image.width(), 4)
    # Sums of whole numbers are exact, and quicker than means of both directions at once.
    sums = np.add.reduceat(rows[:480, :800], range(0, 480, 8), axis=0, dtype=np.uint32)
    return np.add.reduceat(sums, range(0, 800, 8), axis=1)[..., :3] / 64.0
