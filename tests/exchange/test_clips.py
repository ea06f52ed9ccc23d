"""What an SVG file cuts off is cut off here, and in what is written."""

import shutil
import subprocess

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtGui import QImage

from app.document.several_curves import mapped, stepped, whole_curves
from app.document.transforms import scaling
from app.exchange.drawing.image import png_file
from app.exchange.formats.latex import tikz_picture
from app.exchange.options import Options
from app.exchange.svg.reader import read_svg
from app.exchange.svg.writer import svg_of
from app.storage.format import decode, encode
from app.view_model.geometry.clips import leave

pytestmark = pytest.mark.usefixtures("qapp")

HEAD = '<svg xmlns="http://www.w3.org/2000/svg" width="400" height="300" viewBox="0 0 400 300">'
CLIPS = (
    '<clipPath id="c"><circle cx="100" cy="80" r="50"/></clipPath>'
    '<clipPath id="two"><circle cx="260" cy="60" r="40"/><path d="M240 60h100v30H240z"/></clipPath>'
    '<clipPath id="box" clipPathUnits="objectBoundingBox"><path d="M.5 0L1 1H0Z"/></clipPath>'
    '<clipPath id="hole"><path clip-rule="evenodd" d="M220 160H340V280H220Z'
    'M250 190H310V250H250Z"/></clipPath>'
    '<clipPath id="rect"><rect x="90" y="20" width="100" height="100"/></clipPath>'
)
BODY = (
    '<g clip-path="url(#c)" transform="rotate(5)"><rect x="40" y="20" width="100" height="100" fill="#f80"/>'
    '<path d="M20 20L160 160" stroke="#00f" stroke-width="12"/></g>'
    '<rect x="200" y="10" width="150" height="100" fill="#080" stroke="#000" stroke-width="8" opacity=".6" '
    'clip-path="url(#two)"/><ellipse cx="100" cy="220" rx="80" ry="50" fill="#a0a" clip-path="url(#box)"/>'
    '<path d="M200 220C240 120 320 320 360 200V290H200Z" fill="#333" clip-path="url(#hole)"/>'
    '<g clip-path="url(#c)"><g clip-path="url(#rect)"><path d="M0 0H400V150H0Z" fill="#f00" '
    'fill-opacity=".4"/></g></g>'
)
DRAWING = f"{HEAD}{CLIPS}{BODY}</svg>".encode()


def read(body):
    return read_svg(f"{HEAD}{CLIPS}{body}</svg>".encode())


def colours(data):
    image = QImage.fromData(data).convertToFormat(QImage.Format.Format_RGBA8888_Premultiplied)
    return np.frombuffer(image.constBits(), np.uint8).reshape(image.height(), -1, 4).astype(float)


@pytest.mark.skipif(shutil.which("rsvg-convert") is None, reason="librsvg is not installed")
def test_pictures_and_what_is_written_anew_are_clipped_as_librsvg_does(tmp_path):
    def by_librsvg(data):
        (tmp_path / "a.svg").write_bytes(data)
        command = [
            "rsvg-convert",
            "--width=800",
            "--background-color=white",
            "-o",
            str(tmp_path / "a.png"),
            str(tmp_path / "a.svg"),
        ]
        subprocess.run(command, check=True, timeout=60)
        return colours((tmp_path / "a.png").read_bytes())

    found = read_svg(DRAWING)
    assert found.sentences == ()
    theirs = by_librsvg(DRAWING)
    for ours in (
        colours(png_file(found.document, Options(width=800)).content),
        by_librsvg(svg_of(found.document).data),
    ):
        # Along edges a pixel may differ, and none within.
        off = np.abs(ours - theirs).max(axis=2) > 48
        within = off[1:-1, 1:-1] & off[:-2, 1:-1] & off[2:, 1:-1] & off[1:-1, :-2] & off[1:-1, 2:]
        assert off.mean() < 0.002
        assert not within.any()


def test_clips_are_kept_by_files_and_read_again_from_what_is_written():
    document = read_svg(DRAWING).document
    assert decode(encode(document)) == document
    again = read_svg(svg_of(document).content.encode()).document
    assert [len(curve.style.clips) for curve in again.curves] == [1, 1, 1, 1, 1, 2]
    for one, other in zip(document.curves, again.curves, strict=True):
        for x in range(5, 400, 30):
            for y in range(7, 300, 30):
                assert leave(one.style.clips, (x, y)) == leave(other.style.clips, (x, y))
    assert any("are clipped, and written whole" in each for each in tikz_picture(document).remarks)


def test_a_clip_goes_with_its_shape_and_not_with_some_of_its_points():
    document = read('<rect width="80" height="80" clip-path="url(#c)"/>').document
    (clip,) = document.curves[0].style.clips
    whole = whole_curves(document, [0])
    (moved,) = stepped(document, whole, (10.0, 5.0)).curves[0].style.clips
    expected = clip.mapped(lambda place: (place[0] + 10.0, place[1] + 5.0))
    assert moved.rings[0].numbers == pytest.approx(expected.rings[0].numbers)
    (grown,) = mapped(document, whole, scaling(2.0, 3.0, (0.0, 0.0))).curves[0].style.clips
    assert grown.rings[0].numbers == pytest.approx(
        [number * (2.0, 3.0)[at % 2] for at, number in enumerate(clip.rings[0].numbers)]
    )
    corner = replace(whole, parts=((0, frozenset({0})),))
    assert stepped(document, corner, (1.0, 1.0)).curves[0].style.clips == (clip,)


@pytest.mark.parametrize(
    ("clip", "count"),
    [
        ('<rect width="500" height="500"/>', 0),
        ('<rect width="50" height="50"/>', 1),
        ("", 1),
        ('<use href="#shape"/>', 1),
        ("<text>Hi</text>", None),
        ('<path d="M0 0H9V9ZM1 1H2V2Z" clip-rule="evenodd"/><circle r="9"/>', None),
    ],
)
def test_what_is_a_clip_and_what_is_told_instead(clip, count):
    found = read(
        f'<path id="shape" d="M5 5h3v3z"/><clipPath id="a">{clip}</clipPath>'
        '<rect width="80" height="80" clip-path="url(#a)"/>'
    )
    told = "a clip path cuts some of it off" in " ".join(found.sentences)
    assert (len(found.document.curves[-1].style.clips), told) == (count or 0, count is None)


@pytest.mark.parametrize("way", ["M90 60H190V90H90Z", "M90 60V90H190V60Z"])
def test_parts_of_a_clip_leave_what_any_of_them_does_whichever_way_they_run(way):
    # As SVG 2 has it; librsvg (2.54) takes parts that run against each other from each other.
    found = read(
        f'<clipPath id="a"><circle cx="100" cy="80" r="50"/><path d="{way}"/></clipPath>'
        '<path d="M0 0H400V300Z" clip-path="url(#a)"/>'
    )
    clips = found.document.curves[0].style.clips
    seen = [leave(clips, place) for place in [(100.0, -75.0), (180.0, -75.0), (100.0, -50.0), (180.0, -50.0)]]
    assert seen == [True, True, True, False]
