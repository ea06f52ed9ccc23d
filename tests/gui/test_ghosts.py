"""Ghosts, the same points under other rules: drawn, applied and hidden."""

from __future__ import annotations

import math
from itertools import combinations

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QCheckBox, QLabel, QToolButton, QWidget

from app.appearance.theme import DARK, LIGHT, theme_of
from app.document.model import Curve, Document, Parametrization, ParametrizationKind, Point, make_curve
from app.document.point_edits import set_position
from app.families import FAMILIES, HERMITE, LAGRANGE, QUINTIC_HERMITE, FamilySettingValues
from app.plotting.pens import colour_of, dashed
from app.view_model.analysis.ghost import Ghost, all_ghosts
from tests.waiting import until


def visible_ghosts(editor):
    return {
        ghost.ghost: ghost.view
        for ghost in editor.window.canvas.drawing.annotations.figure_layer.ghosts
        if not ghost.is_real
    }


def rows(editor):
    return [row.text for row in editor.window.canvas.drawing.annotations.legend.rows]


def press(editor, qtbot, name):
    qtbot.mouseClick(editor.window.findChild(QToolButton, name), Qt.MouseButton.LeftButton)
    editor.settle()


def test_ghosts_follow_a_drag_and_its_cancelling(editor):
    editor.trigger("ghostUniform")
    editor.trigger("ghostHermite")
    assert set(visible_ghosts(editor)) == {Ghost(kind=ParametrizationKind.UNIFORM), Ghost(family=HERMITE)}
    before = visible_ghosts(editor)[Ghost(kind=ParametrizationKind.UNIFORM)].curve.points.copy()
    x, y = editor.point(3)
    editor.press((x, y))
    editor.move((x + 0.5, y))
    moved = {ghost: view.curve.points[3] for ghost, view in visible_ghosts(editor).items()}
    assert all(place == pytest.approx(editor.point(3)) for place in moved.values())
    assert moved[Ghost(kind=ParametrizationKind.UNIFORM)][0] > x + 0.3
    editor.escape()
    assert np.array_equal(
        visible_ghosts(editor)[Ghost(kind=ParametrizationKind.UNIFORM)].curve.points, before
    )


def test_the_legend_applies_a_ghost_in_one_step(editor, qtbot):
    editor.trigger("ghostUniform")
    editor.trigger("ghostQuinticHermite")
    assert rows(editor) == ["Lagrange · Chord length", "Quintic Hermite", "Uniform"]
    steps = editor.session.undo_stack.count()
    press(editor, qtbot, "legendChoose_uniform")
    assert editor.curve.parametrization.kind is ParametrizationKind.UNIFORM
    assert rows(editor) == ["Lagrange · Uniform", "Quintic Hermite"]
    press(editor, qtbot, "legendChoose_quintic_hermite")
    assert editor.curve.family is QUINTIC_HERMITE
    assert editor.session.undo_stack.count() == steps + 2
    assert editor.session.undo_stack.undoText() == "Switch to Quintic Hermite"
    editor.trigger("undo")
    editor.trigger("undo")
    assert rows(editor) == ["Lagrange · Chord length", "Quintic Hermite", "Uniform"]


RUNGE = [(x, 1 / (1 + 25 * x * x)) for x in np.linspace(-1, 1, 11).tolist()]


def test_runges_function_shows_all_families_side_by_side(editor):
    uniform = Parametrization(ParametrizationKind.UNIFORM)
    curve = replace(make_curve(RUNGE, name="Runge"), parametrization=uniform)
    editor.session.commit(Document((curve,)), "Runge")
    editor.fit()
    editor.trigger("ghostAllFamilies")
    others = [family for family in FAMILIES if family != LAGRANGE]
    assert set(visible_ghosts(editor)) == {Ghost(family=family) for family in others}
    assert editor.action("ghostAllFamilies").isChecked()
    legend = editor.window.canvas.drawing.annotations.legend
    # By the rules of the natural spline these are one curve: cubic pieces are quintic ones, too.
    twins = {"quintic_hermite": " = Hermite", "cubic_spline": " = Hermite"}
    assert rows(editor) == [
        "Lagrange · Uniform",
        *(f"{family.label}{twins.get(family.name, '')}" for family in others),
    ]
    for name in twins:
        ghost = visible_ghosts(editor)[Ghost(family=FAMILIES.named(name))]
        t = np.linspace(0.0, 1.0, 1001)
        away = ghost.curve.evaluate(t) - visible_ghosts(editor)[Ghost(family=HERMITE)].curve.evaluate(t)
        assert np.abs(away).max() < 1e-13
    figures = {row.text: row.figure for row in legend.rows}
    # Measured, and as in the paper on Lebesgue constants at most 4 (2 + log 10) = 17 for d = 3.
    assert figures["Lagrange · Uniform"] == "Λ 30"
    assert figures["Barycentric rational"] == "Λ 3.7"
    assert all(figure.startswith("Λ ") for figure in figures.values())
    assert editor.window.canvas.viewport().rect().contains(legend.geometry())
    assert legend.height() < 0.5 * editor.window.canvas.height()
    editor.trigger("ghostAllFamilies")
    assert not visible_ghosts(editor)


def test_during_a_drag_the_legend_has_no_figures(editor):
    editor.trigger("ghostHermite")
    legend = editor.window.canvas.drawing.annotations.legend
    row, widgets = legend.rows, legend.findChildren(QWidget)
    written = [each.text() for each in legend.findChildren(QLabel)]
    choose = legend.findChild(QToolButton, "legendChoose_hermite")
    name = choose.accessibleName()
    assert [each.figure for each in row] != ["Λ …", "Λ …"]
    assert row[-1].figure in name
    x, y = editor.point(3)
    editor.press((x, y))
    editor.move((x + 0.5, y))
    assert [each.figure for each in legend.rows] == ["Λ …", "Λ …"]
    assert [each.text() for each in legend.findChildren(QLabel)].count("Λ …") == 2
    assert "(Λ …)" in choose.accessibleName()
    editor.escape()
    assert legend.rows == row
    # The figures alone were written anew.
    assert legend.findChildren(QWidget) == widgets
    assert [each.text() for each in legend.findChildren(QLabel)] == written
    assert choose.accessibleName() == name


def test_a_ghost_has_the_settings_that_the_curve_has_or_had_of_its_family(editor):
    family = FAMILIES.named("floater_hormann")
    curve = replace(make_curve(RUNGE, family=family), settings=FamilySettingValues({"degree": 1}))
    editor.session.commit(Document((curve,)), "Runge")
    editor.trigger("ghostUniform")
    editor.trigger("ghostFloaterHormann")
    (uniform,) = visible_ghosts(editor).values()
    assert uniform.curve.chosen == {"degree": 1}
    editor.choose_family(LAGRANGE)
    assert visible_ghosts(editor)[Ghost(family=family)].curve.chosen == {"degree": 1}
    editor.session.commit(Document((make_curve(RUNGE),)), "Another")
    assert visible_ghosts(editor)[Ghost(family=family)].curve.chosen == {"degree": 3}


def test_one_legend_explains_ghosts_and_the_laboratory(editor):
    editor.trigger("toggleLaboratory")
    until(lambda: editor.window.canvas.drawing.annotations.trace_layer.groups.get("laboratory"))
    editor.trigger("ghostUniform")
    ghosts, computed = ["Lagrange · Chord length", "Uniform"], ["Monomials", "Lagrange"]
    # Whatever came first: the curve itself never stands under the heading of another group.
    assert rows(editor) == [*ghosts, "Computed with 4 digits", *computed]
    legend = editor.window.canvas.drawing.annotations.legend
    assert editor.window.canvas.viewport().rect().contains(legend.geometry())
    editor.trigger("toggleLaboratory")
    assert rows(editor) == ghosts
    editor.trigger("ghostUniform")
    assert legend.isHidden()


def test_the_legend_hides_a_ghost(editor, qtbot):
    editor.trigger("ghostUniform")
    editor.trigger("ghostHermite")
    press(editor, qtbot, "legendHide_uniform")
    assert set(visible_ghosts(editor)) == {Ghost(family=HERMITE)}
    assert not editor.action("ghostUniform").isChecked()
    press(editor, qtbot, "legendHide_hermite")
    assert not editor.window.canvas.drawing.annotations.figure_layer.ghosts
    assert editor.window.canvas.drawing.annotations.legend.isHidden()


def test_the_dock_displays_ghosts_and_applies_a_ghost(editor, qtbot):
    editor.show_dock("analysisDock")
    switch = editor.window.findChild(QCheckBox, "ghostCentripetalSwitch")
    qtbot.keyClick(switch, Qt.Key.Key_Space)
    assert set(visible_ghosts(editor)) == {Ghost(kind=ParametrizationKind.CENTRIPETAL)}
    qtbot.keyClick(editor.window.findChild(QToolButton, "use_centripetal"), Qt.Key.Key_Space)
    assert editor.curve.parametrization.kind is ParametrizationKind.CENTRIPETAL
    assert not visible_ghosts(editor)


def test_a_locked_curve_is_not_changed_by_a_ghost(editor, qtbot):
    editor.trigger("ghostUniform")
    editor.trigger("curveLocked")
    press(editor, qtbot, "legendChoose_uniform")
    assert editor.curve.parametrization.kind is ParametrizationKind.CHORD_LENGTH
    assert "locked" in editor.status


def test_a_ghost_without_a_curve_gives_the_reason(editor):
    editor.choose_parametrization(ParametrizationKind.UNIFORM)
    editor.trigger("ghostChordLength")
    moved = set_position(editor.session.document, 0, 1, editor.point(0))
    editor.session.commit(moved, "Move")
    row = editor.window.canvas.drawing.annotations.legend.rows[1]
    assert (row.text, row.is_muted) == ("Chord length: none", True)
    assert row.tip


def test_a_long_polynomial_appears_when_the_drag_is_over(editor):
    x = np.linspace(0, 4, 240)
    points = tuple(Point(float(a), float(np.sin(3 * a))) for a in x)
    rules = Parametrization(ParametrizationKind.CHEBYSHEV)
    editor.session.commit(Document((Curve("Wave", HERMITE, rules, points),)), "Open")
    editor.fit()
    editor.trigger("ghostLagrange")
    assert set(visible_ghosts(editor)) == {Ghost(family=LAGRANGE)}
    editor.press(editor.point(120))
    editor.move((2.0, 1.0))
    (ghost,) = editor.window.canvas.drawing.annotations.figure_layer.ghosts
    assert not ghost.is_drawn
    assert editor.window.canvas.drawing.annotations.legend.rows[1].text == "Lagrange …"
    editor.release((2.0, 1.0))
    (ghost,) = editor.window.canvas.drawing.annotations.figure_layer.ghosts
    assert ghost.is_drawn
    line = ghost.line(1e-3, (0, 0, 4, 4))
    assert np.linalg.norm(line - editor.point(120), axis=1).min() < 1e-9


def test_a_ghost_is_painted_in_its_colour(editor):
    editor.trigger("ghostUniform")
    editor.window.canvas.drawing.annotations.legend.hide()
    canvas = editor.window.canvas
    image, theme = canvas.grab().toImage(), theme_of(canvas.palette())
    wanted = colour_of(Ghost(kind=ParametrizationKind.UNIFORM).style, theme)
    near = sum(
        abs(image.pixelColor(x, y).red() - wanted.red()) < 12
        and abs(image.pixelColor(x, y).green() - wanted.green()) < 12
        for x in range(0, image.width(), 2)
        for y in range(0, image.height(), 2)
    )
    assert near > 50


def test_every_ghost_has_a_unique_style():
    styles = [(style.colour, style.dashes) for style in (ghost.style for ghost in all_ghosts())]
    assert len({dashes for _, dashes in styles}) == len(styles) >= 7
    # There are no more colours that everybody tells apart; dashes go on.
    assert len({colour for colour, _ in styles}) == 8


@pytest.mark.parametrize("theme", [LIGHT, DARK], ids=["light", "dark"])
def test_families_differ_in_colours_and_in_dashes(theme):
    """Lagrange and B-spline had one blue; distances in OKLab, where 0.02 is just seen side by side."""
    styles = [Ghost(family=family).style for family in FAMILIES if family.is_built_in]
    colours = [oklab(colour_of(style, theme)) for style in styles]
    assert min(math.dist(one, other) for one, other in combinations(colours, 2)) > 0.1
    assert len({style.dashes for style in styles}) == len(styles) == 8


def oklab(colour):
    """B. Ottosson, "A perceptual color space for image processing" (2020)."""
    encoded = np.array([colour.redF(), colour.greenF(), colour.blueF()])
    linear = np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)
    cones = np.cbrt(
        np.array(
            [
                [0.4122214708, 0.5363325363, 0.0514459929],
                [0.2119034982, 0.6806995451, 0.1073969566],
                [0.0883024619, 0.2817188376, 0.6299787005],
            ]
        )
        @ linear
    )
    return (
        np.array(
            [
                [0.2104542553, 0.7936177850, -0.0040720468],
                [1.9779984951, -2.4285922050, 0.4505937099],
                [0.0259040371, 0.7827717662, -0.8086757660],
            ]
        )
        @ cones
    )


# The place of the legend


def covered(editor):
    """Return how many points of the curve, and of its ghosts, lie under the legend."""
    canvas = editor.window.canvas
    box = canvas.drawing.annotations.legend.geometry()
    curves = [editor.session.active_view.curve, *(ghost.curve for ghost in visible_ghosts(editor).values())]
    places = [each.evaluate(np.linspace(0.0, 1.0, 2001)) for each in curves]
    places.append(editor.session.active_view.points)
    return sum(box.contains(canvas.to_pixel(x, y)) for x, y in np.concatenate(places).tolist())


@pytest.mark.parametrize("size", [(1024, 640), (1280, 800), (1440, 900)])
def test_the_legend_of_all_families_covers_no_curve(editor, size):
    """It lay over the end of the curve at 1280."""
    editor.window.resize(*size)
    uniform = Parametrization(ParametrizationKind.UNIFORM)
    curve = replace(make_curve(RUNGE, name="Runge"), parametrization=uniform)
    editor.session.commit(Document((curve,)), "Runge")
    editor.trigger("ghostAllFamilies")
    legend = editor.window.canvas.drawing.annotations.legend
    editor.fit()
    until(lambda: covered(editor) == 0)
    tip = editor.window.findChild(QToolButton, "legendChoose_floater_hormann").toolTip()
    assert tip == "Apply to the curve: Barycentric rational (Λ 3.7)"
    assert editor.window.canvas.viewport().rect().contains(legend.geometry())


def in_corner(editor):
    legend = editor.window.canvas.drawing.annotations.legend.geometry()
    room = editor.window.canvas.viewport().rect()
    return legend.center().x() > room.center().x(), legend.center().y() > room.center().y()


def test_the_legend_moves_away_from_the_curve_but_not_during_a_drag(editor):
    editor.session.commit(Document((make_curve([(0, 0), (2, 0), (4, 0.0), (6, 0)]),)), "Line")
    editor.fit()
    editor.trigger("ghostHermite")
    assert in_corner(editor) == (True, True)
    canvas = editor.window.canvas
    end = canvas.to_plane(canvas.drawing.annotations.legend.geometry().center())
    editor.press(editor.point(3))
    editor.move(end)
    # What the timer would do, now.
    canvas.drawing.annotations.legend._move_timer.timeout.emit()
    assert in_corner(editor) == (True, True)
    assert covered(editor)
    editor.release(end)
    until(lambda: not covered(editor))
    assert in_corner(editor) == (True, False)
    # And it stays there, as long as it is not in the way.
    editor.trigger("undo")
    canvas.drawing.annotations.legend._move_timer.timeout.emit()
    assert in_corner(editor) == (True, False)


def test_dashes_run_on_over_corners():
    """Three segments of 4 pixels, dashes of 3 and gaps of 2: 0–3, 5–8, 10–12 along the line."""
    segments = np.array([[0.0, 0, 4, 0], [4, 0, 4, 4], [4, 4, 8, 4]])
    expected = [[0, 0, 3, 0], [4, 1, 4, 4], [6, 4, 8, 4]]
    assert dashed(segments, (3.0, 2.0)) == pytest.approx(np.array(expected))
    assert dashed(segments, ()) is segments
    assert len(dashed(np.empty((0, 4)), (3.0, 2.0))) == 0


@pytest.mark.parametrize("pattern", [(5.0, 3.0), (9.0, 4.0, 2.0, 4.0)])
def test_dashes_have_their_share_of_the_length(pattern):
    t = np.linspace(0, 20, 400)
    points = np.column_stack([40 * t, 100 * np.sin(t)])
    segments = np.hstack([points[:-1], points[1:]])
    drawn = dashed(segments, pattern)

    def length(parts):
        return np.hypot(*(parts[:, 2:] - parts[:, :2]).T).sum()

    share = sum(pattern[::2]) / sum(pattern)
    assert length(drawn) == pytest.approx(share * length(segments), abs=sum(pattern))
