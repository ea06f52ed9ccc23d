"""Curves of Godot's resources and scenes, against de Casteljau's scheme on the numbers of the file."""

from __future__ import annotations

import numpy as np
import pytest

from app.exchange.errors import ExchangeError
from app.exchange.files import import_file
from app.exchange.formats.godot import read_curves
from app.view_model.curve.curve_view import view_of
from tests.rows import each_row

SCENE = """[gd_scene load_steps=4 format=3 uid="uid://cyfwty2q3rdse"]

[ext_resource type="Script" path="res://Main.gd" id="1_a"]

[sub_resource type="Curve2D" id="Curve2D_ab12"]
bake_interval = 20.0
_data = {
"points": PackedVector2Array(0, 0, 10, 20, 1, 2, -30, 5, 30, -5, 100, 2, 0, 0, 0, 0, 200, 50)
}
point_count = 3

[sub_resource type="Curve2D" id="Empty"]
_data = {
"points": PackedVector2Array()
}
point_count = 0

[sub_resource type="Curve2D" id="2"]
_data = {
"points": PackedVector2Array(0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 480, 0, 0, 0, 0, 0, 480, 720, 0, 0, 0, 0, 0, 0)
}

[node name="Main" type="Node2D"]
script = ExtResource("1_a")
position = Vector2(5, 5)

[node name="Track" type="Path2D" parent="."]
position = Vector2(3, 4)
curve = SubResource("Curve2D_ab12")

[node name="Round" type="Path2D" parent="."]
curve = SubResource( 2 )
"""


def curves_in(text):
    return read_curves(text.encode()).document.curves


def test_a_scene_has_curves_named_after_their_nodes():
    found = read_curves(SCENE.encode())
    track, closed = found.document.curves
    assert (track.name, track.closed, len(track.points)) == ("Track", False, 3)
    assert (closed.name, closed.closed, len(closed.points)) == ("Round", True, 3)
    assert [(point.x, point.y) for point in track.points] == [(1, -2), (100, -2), (200, -50)]
    assert found.remarks == (
        "1 node with a position, rotation or scale of its own imported without it: Track.",
    )


def test_pieces_are_the_beziers_of_the_file_with_y_up():
    numbers = np.array([0, 0, 10, 20, 1, 2, -30, 5, 30, -5, 100, 2, 0, 0, 0, 0, 200, 50], dtype=float)
    (_, out, at), (into, out_1, at_1), (into_2, _, at_2) = numbers.reshape(3, 3, 2)
    pieces = [(at, at + out, at_1 + into, at_1), (at_1, at_1 + out_1, at_2 + into_2, at_2)]
    core = view_of(curves_in(SCENE)[0]).curve
    for k, piece in enumerate(pieces):
        start, end = core.breaks[k : k + 2]
        for s in np.linspace(0, 1, 9):
            level = np.array(piece)
            while len(level) > 1:
                level = (1 - s) * level[:-1] + s * level[1:]
            assert core.evaluate(start + (end - start) * s) == pytest.approx(
                level[0] * (1, -1), abs=1e-12 * 200
            )


def test_a_piece_without_handles_is_a_straight_line_at_one_speed():
    """Its Bézier piece stands still at both ends: velocities of zero would be no help to anybody."""
    core = view_of(curves_in(SCENE)[1]).curve
    start, end = core.breaks[:2]
    for s in (0.25, 0.5, 0.75):
        assert core.evaluate(start + (end - start) * s) == pytest.approx((480 * s, 0))


@pytest.mark.usefixtures("drawings_read_here")
@each_row(
    "text",
    [
        '[gd_resource type="Curve2D" format=3]\n\n[resource]\n_data = {\n"points": PackedVector2Array'
        "(0, 0, 0, 0, 1, 2, 0, 0, 0, 0, 3, 4.5e1)\n}\n",
        '[gd_resource type="Curve2D" format=2]\n\n[resource]\n_data = {\n"points": PoolVector2Array'
        "( 0, 0, 0, 0, 1, 2, 0, 0, 0, 0, 3, 45 )\n}\n",
        '[gd_scene format=2]\r\n\r\n[sub_resource type="Curve2D" id=1]\r\n_data = { "points": '
        "PoolVector2Array( 0, 0, 0, 0, 1, 2, 0, 0, 0, 0, 3, 45 ) }\r\n",
    ],
)
def test_resources_of_both_versions_are_read(text, tmp_path):
    path = tmp_path / "a.tres"
    path.write_bytes(text.encode())
    (curve,) = import_file(path).document.curves
    assert curve.name == "Curve 1"
    assert [(point.x, point.y) for point in curve.points] == [(1, -2), (3, -45)]


@each_row(
    ("old", "new", "sentence"),
    [
        (
            SCENE,
            "RSRC\x00\x00",
            "The file contains no Curve2D. Save it or its scene as text (.tres, .tscn).",
        ),
        ("10, 20, 1", "10, 20", "Line 8: a curve needs six numbers per point."),
        ("10, 20, 1", "10, 20, one", "Line 8: a curve needs six numbers per point."),
        ("10, 20, 1", "10, 20, nan", "Line 8: a curve needs six numbers per point."),
        ("10, 20, 1", "10, 20, 1e999", "Line 8: a curve needs six numbers per point."),
        ('"Curve2D"', '"Curve3D"', "The file contains no Curve2D."),
        (
            SCENE,
            '[gd_resource type="Curve2D"]\n[resource]\n_data = {"points": PackedVector2Array(0,0,0,0,1,2)}\n',
            "The file contains no curves. 1 single point left out: Curve 1.",
        ),
        ("(0, 0, 10, ", "(10, ", "Line 8: a curve needs six numbers per point."),
    ],
)
def test_invalid_godot_curves_are_refused_with_their_position(old, new, sentence):
    with pytest.raises(ExchangeError) as refusal:
        curves_in(SCENE.replace(old, new))
    assert str(refusal.value).startswith(sentence)


def test_a_curve_out_of_range_gives_a_remark_and_the_others_are_imported():
    found = read_curves(SCENE.replace("10, 20, 1", "10, 20, 1e13").encode())
    assert [each.name for each in found.document.curves] == ["Round"]
    assert found.remarks[1] == "1 curve with coordinates or velocities outside −1e12 to 1e12 left out: Track."
