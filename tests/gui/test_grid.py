"""The grid: one unit along x and y, so one step, at every zoom."""

from __future__ import annotations

import math
from itertools import pairwise, product

import pytest
from PySide6.QtCore import QRect, QSize
from PySide6.QtGui import QFontMetricsF

from app.canvas.grid_layer import adaptive_steps
from app.document.model import Document, make_curve
from app.plotting import ticks
from app.plotting.ticks import LEAST_LABELS, LabelRoom, Stretch, choose_ticks, nice_step, tick_labels
from tests.effort import noted_calls


@pytest.mark.parametrize("exponent", [-11, -3, -1, 0, 2, 9])
def test_steps_are_round_and_never_dense(exponent):
    for share in range(100):
        scale = 10 ** (exponent + share / 100)
        coarse, fine = adaptive_steps(scale)
        assert 79.9 < coarse * scale < 201
        assert fine * scale > 15.9
        assert round(coarse / fine) in (2, 5)
        for step in (coarse, fine):
            digits = step / 10.0 ** math.floor(math.log10(step) + 1e-9)
            assert min(abs(digits - good) for good in (1, 2, 5)) < 1e-9


def labels(editor, side):
    """The distance of the numbers of an axis of the canvas, and where they stand with their texts."""
    canvas = editor.window.canvas
    found = canvas.getAxis(side).ticks_in(canvas.pixel_map)
    return found.step, found.labels


def test_both_axes_have_the_same_steps_and_labels_at_every_zoom(editor):
    canvas = editor.window.canvas
    for notches in (-9, -4, -1, 0, 1, 2, 3, 5, 12):
        canvas.camera.zoom(1.2**notches, canvas.camera.centre())
        editor.settle()
        coarse, fine = canvas.drawing.grid.steps
        assert (coarse, fine) == adaptive_steps(canvas.pixel_map.sx), notches
        assert canvas.tools.canvas.grid_spacing() == fine, notches
        assert labels(editor, "bottom")[0] == labels(editor, "left")[0] == coarse, notches
        for side in ("bottom", "left"):
            marks = canvas.getAxis(side).ticks_in(canvas.pixel_map).marks
            assert {round(place / fine) for place, _ in marks} >= {
                round(at / fine) for at, _ in labels(editor, side)[1]
            }, notches
        canvas.camera.zoom(1.2**-notches, canvas.camera.centre())


@pytest.mark.parametrize("size", [(960, 540), (1024, 640), (1500, 950)])
def test_every_axis_has_two_different_numbers(editor, size):
    """Zoomed in far from the origin, "1.7e+09" stood at the left five times; between zooms, nothing."""
    editor.window.resize(*size)
    canvas = editor.window.canvas
    halves = [digit * 10.0**exponent for exponent in range(-6, 10) for digit in (1.0, 1.7, 2.9, 4.4, 7.3)]
    for middle, half in product((0.0, -3.7, 1234567.0, -1.7e9), halves):
        if half < 1e-12 * abs(middle):
            continue
        canvas.camera.show_box((middle - half, middle + half), (middle - half, middle + half))
        for side in ("bottom", "left"):
            found = canvas.getAxis(side).ticks_in(canvas.pixel_map)
            assert len({text for _, text in found.labels}) >= LEAST_LABELS, (middle, half)
            assert boxes_are_apart(canvas, side, found.labels), (middle, half)


def boxes_are_apart(canvas, side, found):
    """Whether the numbers of an axis do not overlap."""
    axis, shown = canvas.getAxis(side), canvas.pixel_map
    metrics = QFontMetricsF(axis.font)
    if side == "left":
        gap, half = shown.sy, dict.fromkeys([text for _, text in found], metrics.height() / 2)
    else:
        gap, half = shown.sx, {text: metrics.horizontalAdvance(text) / 2 for _, text in found}
    return all(
        (after - before) * gap >= half[text] + half[other]
        for (before, text), (after, other) in pairwise(found)
    )


def test_numbers_far_from_the_origin_share_an_offset(editor):
    canvas = editor.window.canvas
    canvas.camera.show_box((0.0, 1.0), (1234567.25, 1234567.75))
    offset = canvas.getAxis("left").ticks_in(canvas.pixel_map)
    assert offset.offset.endswith(" +")
    common = float(offset.offset.removesuffix(" +"))
    for place, text in offset.labels:
        assert common + float(text.replace("−", "-")) == pytest.approx(place, abs=1e-9)
    assert canvas.drawing.units.text(canvas.pixel_map) == offset.offset
    blank = canvas.grab().toImage()
    canvas.camera.show_box((0.0, 1.0), (0.25, 0.75))
    assert not canvas.getAxis("left").ticks_in(canvas.pixel_map).offset
    corner = QRect(canvas.camera.origin.toPoint(), QSize(90, 20))
    assert blank.copy(corner) != canvas.grab().toImage().copy(corner)


def test_the_axis_of_t_has_two_numbers_at_every_zoom(editor):
    panel = editor.window.basis_panel
    for start in (0.0, 0.3141592, 1700000000.0):
        for exponent in range(-6, 8):
            for digit in (1.0, 2.9, 7.3):
                span = digit * 10.0**exponent
                if span < 1e-14 * start:
                    continue
                panel.camera.show_t(start, start + span)
                found = panel.getAxis("bottom").ticks_in(panel.pixel_map)
                assert len({text for _, text in found.labels}) >= LEAST_LABELS
                assert boxes_are_apart(panel, "bottom", found.labels)
    editor.fit()


def test_a_narrow_axis_has_the_offset_of_its_numbers_at_its_end(qapp):
    wide = QFontMetricsF(qapp.font()).horizontalAdvance
    room = LabelRoom(wide, lambda _text: 10.0, 10.0, 20.0, 20.0, 0.0)
    seen = Stretch(1.7e9, 1.7e9 + 0.05, 150.0)
    found = choose_ticks(seen, 0.01, 0.02, room)
    assert found.offset == "1700000000 +"
    assert [text for _, text in found.labels] == ["0", "0.02", "0.04"]


@pytest.mark.parametrize("middle", [0.0, -3.7, 1234567.0, -1.7e9])
def test_numbers_without_room_are_not_laid_out(middle, monkeypatch):
    """An axis of 540 pixels wrote up to 10,000 numbers to choose its ticks, at every step of a zoom."""
    written = noted_calls(monkeypatch, ticks, "number")
    for exponent, digit in product(range(-6, 10), (1.0, 1.7, 2.9, 4.4, 7.3)):
        half = digit * 10.0**exponent
        if half < 1e-12 * abs(middle):
            continue
        seen = Stretch(middle - half, middle + half, 540.0)
        own = nice_step(80.0 / seen.scale)
        for room in (
            LabelRoom(lambda text: 7.0 * len(text), lambda _text: 13.0, 14.0, 13.0, 25.0, 10.0),
            LabelRoom(lambda _text: 13.0, lambda text: 7.0 * len(text), 8.0, 40.0, 3.0, 3.0),
        ):
            written.clear()
            assert len(choose_ticks(seen, own / 5, own, room).labels) >= LEAST_LABELS
            assert len(written) < seen.size / 2


def test_a_snapped_point_lies_on_fine_lines_in_both_directions(editor):
    editor.session.commit(Document((make_curve(((0.0, 0.0), (4.0, 3.0))),)), "Begin")
    editor.window.canvas.camera.show_box((-3, 7), (-3, 5))
    editor.settle()
    fine = editor.window.canvas.tools.canvas.grid_spacing()
    near = editor.pixel
    editor.trigger("toggleSnap")
    editor.drag_point(1, to=(4 + 3 * fine + near, 3 - 2 * fine - near))
    assert editor.point(1) == pytest.approx((4 + 3 * fine, 3 - 2 * fine), abs=1e-12)


def test_labels_are_decimal_numbers_and_differ_far_from_the_origin():
    assert tick_labels([-0.2, 0.0, 0.2, 0.6000000000000001], 1.0, 0.2) == ["−0.2", "0", "0.2", "0.6"]
    far = tick_labels([1e6, 1e6 + 0.02, 1e6 + 0.04], 1.0, 0.02)
    assert far == ["1000000", "1000000.02", "1000000.04"]
    assert tick_labels([], 1.0, 0.2) == []
