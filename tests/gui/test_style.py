"""The Style panel, and the canvas: strokes and fills."""

from __future__ import annotations

import numpy as np
import pytest
from msgspec.structs import replace
from PySide6.QtCore import QMimeData, QPoint, QPointF, Qt
from PySide6.QtGui import QColor, QGuiApplication, QWheelEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QApplication,
    QComboBox,
    QLabel,
    QLineEdit,
    QSlider,
    QToolButton,
    QWidget,
)

from app.appearance.colours import CURVE_COLOURS
from app.appearance.theme import LIGHT, ThemeMode
from app.document.model import Document, make_curve
from app.document.style import NO_PAINT, FillRule, LineCap, LineJoin, Style
from app.families import HERMITE
from app.features.curve_list.rows import Spot
from app.plotting.drawing import Stroke
from app.plotting.wide_line import RoundLine, WideLine
from app.widgets.colour_popup import ColourPopup
from tests.effort import noted_calls

CTRL, SHIFT = Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier
BLUE, RED, GREEN = "#0072b2", "#d55e00", "#009e73"


def square(x, y, side, name, **values):
    """A closed curve with straight sides."""
    corners = [(x, y), (x + side, y), (x + side, y + side), (x, y + side)]
    curve = make_curve(corners, name=name, family=HERMITE)
    points = tuple(replace(point, corner=True, velocity=None) for point in curve.points)
    return replace(curve, points=points, closed=True, **values)


def begin(editor, *curves, active=0, unit=""):
    # Lines of the grid would be seen through, or beside, what is drawn.
    editor.window.context.store.change(grid=False)
    editor.session.commit(Document(curves, unit=unit), "Begin", active=active)
    editor.fit()
    editor.select([])


@pytest.fixture
def panel(editor):
    """The form, in front; three squares side by side, the second edited."""
    curves = (square(4 * k, 0, 3, name) for k, name in enumerate(("Leaf", "Stem", "Root")))
    begin(editor, *curves, active=1, unit="cm")
    editor.show_dock("styleDock")
    return editor.window.findChild(QWidget, "stylePanel")


def child(panel, kind, name):
    found = panel.findChild(kind, name)
    assert found is not None, name
    return found


def click(panel, name):
    QTest.mouseClick(child(panel, QToolButton, name), Qt.MouseButton.LeftButton)


def enter(editor, panel, name, text):
    field = child(panel, QLineEdit, name)
    field.setFocus()
    field.selectAll()
    editor.type_text(field, text)
    QTest.keyClick(field, Qt.Key.Key_Return)
    editor.settle()


def text_of(panel, name):
    return child(panel, QLineEdit, name).text()


def styles(editor):
    return [curve.style for curve in editor.session.document.curves]


def colour_at(editor, x, y):
    """Return the colour of the canvas at a point of the plane, with no pointer near."""
    canvas = editor.window.canvas
    # A view that has moved shows its picture of before, stretched, until it rests.
    editor.settle()
    editor.wait_for_rest()
    return QColor(canvas.viewport().grab().toImage().pixel(canvas.to_pixel(x, y))).name()


# One step, for all that are chosen


def test_one_click_on_a_swatch_paints(editor, panel):
    click(panel, "fillPaint_Blue")
    assert styles(editor)[1] == Style(fill=BLUE)
    assert editor.session.undo_stack.undoText() == "Fill of Stem"
    click(panel, "strokePaint_Vermillion")
    assert styles(editor)[1] == Style(stroke=RED, fill=BLUE)
    assert editor.session.undo_stack.undoText() == "Stroke colour of Stem"
    click(panel, "strokePaint_None")
    assert styles(editor)[1] == Style(stroke="none", fill=BLUE)
    click(panel, "fillPaint_Ink")
    assert styles(editor)[1] == Style(stroke="none", fill="")
    editor.session.undo_stack.setIndex(1)
    assert styles(editor) == [Style()] * 3


def test_all_selected_curves_change_in_one_step(editor, panel):
    editor.session.selected.set_curves([0, 1, 2])
    steps = editor.session.undo_stack.count()
    click(panel, "strokePaint_Blue")
    assert [each.stroke for each in styles(editor)] == [BLUE] * 3
    assert editor.session.undo_stack.undoText() == "Stroke colour of 3 curves"
    assert editor.session.undo_stack.count() == steps + 1
    assert child(panel, QLabel, "styleSubject").text() == "3 curves"


def test_different_values_are_displayed_as_mixed_and_stay(editor, panel):
    enter(editor, panel, "strokeWidth", "0.5")
    click(panel, "fillPaint_Blue")
    editor.session.selected.set_curves([1, 2])
    editor.settle()
    assert text_of(panel, "fillPaintHex") == text_of(panel, "strokeWidth") == "mixed"
    assert text_of(panel, "strokePaintHex") == "ink"
    click(panel, "lineCap_butt")
    assert [(each.cap, each.width, each.fill) for each in styles(editor)[1:]] == [
        (LineCap.BUTT, 0.5, BLUE),
        (LineCap.BUTT, None, "none"),
    ]
    assert child(panel, QToolButton, "lineCap_butt").isChecked()


def test_ends_corners_rules_and_dashes(editor, panel):
    click(panel, "lineJoin_miter")
    enter(editor, panel, "miterLimit", "10")
    click(panel, "fillPaint_Blue")
    click(panel, "fillRule_evenodd")
    assert editor.session.undo_stack.undoText() == "Fill rule of Stem"
    box = child(panel, QComboBox, "dashBox")
    box.setFocus()
    QTest.keyClick(box, Qt.Key.Key_Down)
    editor.settle()
    assert styles(editor)[1].dash == (0.0, 2.0)
    enter(editor, panel, "dashList", "3 1 1/2 1")
    enter(editor, panel, "dashOffset", "2")
    wanted = Style(
        join=LineJoin.MITER,
        miter_limit=10.0,
        fill=BLUE,
        fill_rule=FillRule.EVENODD,
        dash=(3.0, 1.0, 0.5, 1.0),
        dash_offset=2.0,
    )
    assert styles(editor)[1] == wanted
    assert box.currentText() == "Custom"
    assert editor.session.undo_stack.undoText() == "Start of the dashes of Stem"


def test_widths_are_typed_with_any_unit_of_length(editor, panel):
    widths = {"2": 2.0, "5 mm": 0.5, "1/2 in": 1.27, "0.5cm": 0.5, "72 pt": 2.54, "auto": None}
    for typed, width in widths.items():
        enter(editor, panel, "strokeWidth", "7")
        enter(editor, panel, "strokeWidth", typed)
        assert styles(editor)[1].width == (width and pytest.approx(width, rel=1e-15)), typed


def turn(field, notches):
    """Turn the wheel over a field."""
    place = QPointF(field.rect().center())
    event = QWheelEvent(
        place, field.mapToGlobal(place), QPoint(), QPoint(0, 120 * notches), Qt.MouseButton.NoButton,
        Qt.KeyboardModifier.NoModifier, Qt.ScrollPhase.NoScrollPhase, False,
    )  # fmt: skip
    QApplication.sendEvent(field, event)


def test_the_wheel_does_not_change_a_choice_without_the_focus(editor, panel):
    """Whoever scrolled the panel gave the line another dash when the pointer came over that."""
    box = panel.findChild(QComboBox, "dashBox")
    steps = editor.session.undo_stack.count()
    editor.window.canvas.setFocus()
    turn(box, -1)
    assert (box.currentIndex(), editor.session.undo_stack.count()) == (0, steps)
    # What scrolls there brings another field under it.
    for slider in panel.findChildren(QSlider):
        turn(slider, -1)
    assert editor.session.undo_stack.count() == steps
    box.setFocus()
    turn(box, -1)
    assert box.currentIndex() == 1


STEPPED = [
    ("width", "strokeWidth", "1.8", (1.9, 2.0, 2.2), None),
    ("width", "strokeWidth", "0.05", (0.055, 0.06, 0.065), None),
    ("width", "strokeWidth", "0", (0.1, 0.11, 0.12), None),
    ("stroke_opacity", "strokeOpacity", "87", (0.92, 0.97, 1.0), None),
    ("stroke_opacity", "strokeOpacity", "12", (0.17, 0.22, 0.27), 0.0),
]


def test_arrow_keys_and_the_wheel_step_a_number_and_a_held_key_is_one_step(editor, panel):
    editor.session.history.clock = lambda: 0.0  # however slow the machine is, the key is held
    for name, field, begin, ups, lowest in STEPPED:
        enter(editor, panel, field, begin)
        case = name, begin
        edit, first = child(panel, QLineEdit, field), getattr(styles(editor)[1], name)
        steps = editor.session.undo_stack.count()
        for value in ups:
            QTest.keyClick(edit, Qt.Key.Key_Up)
            assert getattr(styles(editor)[1], name) == value, case
        assert edit.text().startswith(f"{100 * value:g}" if name == "stroke_opacity" else f"{value:g}"), case
        assert editor.session.undo_stack.count() == steps + 1, case
        editor.trigger("undo")
        assert getattr(styles(editor)[1], name) == first, case
        edit.setFocus()
        turn(edit, 2)
        assert getattr(styles(editor)[1], name) == ups[1], case
        for _ in range(9 if lowest is not None else 0):
            QTest.keyClick(edit, Qt.Key.Key_Down)
        assert lowest is None or getattr(styles(editor)[1], name) == lowest, case
        # Without the focus the wheel scrolls what lies around.
        before = styles(editor)
        editor.window.canvas.setFocus()
        turn(edit, 1)
        assert styles(editor) == before, case


def test_a_width_is_displayed_with_the_unit_of_the_document(editor, panel):
    enter(editor, panel, "strokeWidth", "5 mm")
    assert text_of(panel, "strokeWidth") == "0.5 cm"
    enter(editor, panel, "strokeWidth", "auto")
    assert text_of(panel, "strokeWidth") == "auto"


def test_invalid_input_is_refused_in_the_form_and_stays(editor, panel):
    click(panel, "fillPaint_Blue")
    click(panel, "lineJoin_miter")
    before, problem = styles(editor), child(panel, QLabel, "styleProblem")
    for field, typed, said in (
        ("strokeWidth", "-1", "Type a width of at least 0"),
        ("strokePaintHex", "no colour", "Type a colour as #0072b2"),
        ("fillOpacity", "120", "from 0 % to 100 %"),
        ("miterLimit", "0.5", "Type a limit of at least 1"),
        ("dashList", "0 0", "not all 0"),
    ):
        enter(editor, panel, field, typed)
        assert not problem.isHidden(), field
        assert said in problem.text()
        assert text_of(panel, field) == typed
        assert styles(editor) == before, field
        QTest.keyClick(child(panel, QLineEdit, field), Qt.Key.Key_Escape)
        assert problem.isHidden(), field


def test_a_refusal_moves_no_row_and_a_swatch_clears_the_refusal(editor, panel):
    rows = [child(panel, QWidget, name) for name in ("fillPaint_Blue", "strokeWidth", "strokeOpacity")]
    before = [row.mapTo(panel, QPoint()) for row in rows]
    enter(editor, panel, "fillPaintHex", "no colour")
    editor.settle()
    assert not child(panel, QLabel, "styleProblem").isHidden()
    assert [row.mapTo(panel, QPoint()) for row in rows] == before
    click(panel, "fillPaint_Blue")
    editor.settle()
    assert styles(editor)[1].fill == BLUE
    assert text_of(panel, "fillPaintHex") == BLUE
    assert child(panel, QLabel, "styleProblem").isHidden()


def test_a_unit_needs_a_document_with_a_unit(editor, panel):
    begin(editor, square(0, 0, 1, "Leaf"))
    enter(editor, panel, "strokeWidth", "5 mm")
    assert "The document has no unit of length" in child(panel, QLabel, "styleProblem").text()


def test_colours_are_accepted_in_common_notations(editor, panel):
    paints = {"#0072B2": BLUE, "0072b2": BLUE, "f00": "#ff0000", "Teal": "#008080", "ink": ""}
    for typed, paint in paints.items():
        click(panel, "strokePaint_Yellow")
        enter(editor, panel, "strokePaintHex", typed)
        assert styles(editor)[1].stroke == paint, typed


def test_a_shape_has_one_style(editor, panel):
    outer, inner = (square(k, k, 5 - 2 * k, f"{k}", shape="o") for k in (0, 1))
    begin(editor, outer, inner, active=1)
    click(panel, "fillPaint_Blue")
    assert [each.fill for each in styles(editor)] == [BLUE, BLUE]


# Live


def drag_slider(slider, to, *, release=True):
    """Drag the handle of a slider from its right end to a share of its length."""
    y, right = slider.height() // 2, slider.width() - 6
    QTest.mousePress(slider, Qt.MouseButton.LeftButton, pos=QPoint(right, y))
    for share in (0.9, 0.7, to):
        QTest.mouseMove(slider, QPoint(round(right * share), y))
    if release:
        QTest.mouseRelease(slider, Qt.MouseButton.LeftButton, pos=QPoint(round(right * to), y))


def test_an_opacity_is_dragged_live_and_is_one_step(editor, panel):
    editor.session.selected.set_curves([0, 1])
    steps = editor.session.undo_stack.count()
    slider = child(panel, QSlider, "strokeOpacitySlider")
    drag_slider(slider, 0.5, release=False)
    assert editor.session.is_previewing
    assert 0.3 < styles(editor)[0].stroke_opacity == styles(editor)[1].stroke_opacity < 0.7
    QTest.keyClick(slider, Qt.Key.Key_Escape)
    assert styles(editor) == [Style()] * 3
    QTest.mouseRelease(slider, Qt.MouseButton.LeftButton)
    assert editor.session.undo_stack.count() == steps
    drag_slider(slider, 0.5)
    assert editor.session.undo_stack.count() == steps + 1
    assert editor.session.undo_stack.undoText() == "Stroke opacity of 2 curves"
    assert text_of(panel, "strokeOpacity") == f"{100 * styles(editor)[0].stroke_opacity:g} %"


def popup(panel, name="fillPaint"):
    click(panel, f"{name}Button")
    found = QApplication.activePopupWidget()
    assert isinstance(found, ColourPopup)
    return found


def pick(popup, colour):
    """Type a colour into the popup."""
    field = popup.findChild(QLineEdit, "qt_colorname_lineedit")
    field.selectAll()
    QTest.keyClicks(field, colour)


def test_a_colour_is_previewed_and_escape_cancels(editor, panel):
    before, steps = colour_at(editor, 5.5, 1.5), editor.session.undo_stack.count()
    choice = popup(panel)
    pick(choice, "#ff0000")
    assert colour_at(editor, 5.5, 1.5) == "#ff0000"
    QTest.keyClick(QApplication.focusWidget() or choice, Qt.Key.Key_Escape)
    editor.settle()
    assert QApplication.activePopupWidget() is None
    assert colour_at(editor, 5.5, 1.5) == before
    assert editor.session.undo_stack.count() == steps


def test_a_colour_of_any_kind_is_selected_in_one_step_and_remembered(editor, panel):
    steps = editor.session.undo_stack.count()
    choice = popup(panel, "strokePaint")
    for colour in ("#ff0000", "#123456"):
        pick(choice, colour)
    QTest.keyClick(choice, Qt.Key.Key_Return)
    editor.settle()
    assert styles(editor)[1].stroke == "#123456"
    assert editor.session.undo_stack.count() == steps + 1
    editor.session.selected.activate(0)
    click(panel, "fillPaint_#123456")
    assert styles(editor)[0].fill == "#123456"
    assert editor.window.preferences.recent_colours.startswith("#123456")
    panel.show_recent(["#00ff00"])
    assert panel.findChild(QToolButton, "fillPaint_#00ff00") is not None
    # At once: buttons that were deleted later stood beside the new ones for a moment.
    assert panel.findChild(QToolButton, "fillPaint_#123456") is None


def test_colours_of_the_document_are_offered_after_the_recent_ones(editor, panel):
    """Of an opened drawing its own colours had to be picked or typed."""
    editor.window.preferences.recent_colours = "#123456"
    document = editor.session.document
    one = document.curves[0].style
    one = replace(one, stroke="#bb1100", fill="#00bb22")
    other = replace(one, fill="#0000aa", stroke=NO_PAINT)
    curves = [replace(document.curves[0], style=one, name=f"C {at}") for at in range(2)]
    more = [f"#{at:06x}" for at in range(1, 12)]
    rest = [replace(document.curves[0], style=replace(one, stroke=each), name=each) for each in more]
    curves = (*curves, replace(curves[0], style=other, name="F"), *rest)

    def offered():
        names = [each.objectName() for each in panel.findChildren(QToolButton)]
        return [name.removeprefix("fillPaint_") for name in names if name.startswith("fillPaint_#")]

    editor.session.commit(replace(document, curves=curves), "Open")
    editor.settle()
    # Those of most curves first, as many as there is room for.
    expected = ["#123456", "#00bb22", "#bb1100", "#0000aa", *more]
    assert offered() == expected[: len(offered())]
    assert len(offered()) == len(CURVE_COLOURS) + 1
    width = panel.sizeHint().width()
    editor.session.selected.activate(0)
    click(panel, "fillPaint_#bb1100")
    assert styles(editor)[0].fill == "#bb1100"
    assert offered()[0] == "#bb1100"
    editor.trigger("undo")
    editor.trigger("undo")
    assert panel.sizeHint().width() == width
    assert "#0000aa" not in offered()


def test_an_undo_step_closes_the_colour_picker(editor, panel):
    choice = popup(panel)
    pick(choice, "#ff0000")
    editor.trigger("undo")
    assert QApplication.activePopupWidget() is None
    assert not editor.session.is_previewing


# Copied


def test_a_style_is_copied_and_pasted_to_all_selected_curves_curves(editor, panel):
    click(panel, "fillPaint_Blue")
    enter(editor, panel, "strokeWidth", "0.5")
    # As in Inkscape: what was copied as a curve gives its style; and the style alone has keys of its own.
    for copying in (CTRL, CTRL | SHIFT | Qt.KeyboardModifier.AltModifier):
        editor.session.selected.select_whole([1])
        QTest.keyClick(editor.window, Qt.Key.Key_C, copying)
        editor.session.selected.set_curves([0, 2])
        QTest.keyClick(editor.window, Qt.Key.Key_V, CTRL | SHIFT)
        editor.wait_for_work()
        assert styles(editor) == [Style(fill=BLUE, width=0.5)] * 3
        assert editor.session.undo_stack.undoText() == "Paste style to 2 curves"
        QTest.keyClick(editor.window, Qt.Key.Key_Z, CTRL)
        assert styles(editor) == [Style(), Style(fill=BLUE, width=0.5), Style()]
    editor.paste_text("words")
    QTest.keyClick(editor.window, Qt.Key.Key_V, CTRL | SHIFT)
    assert "no style on the clipboard" in editor.status


@pytest.mark.usefixtures("drawings_read_here")
def test_the_style_of_foreign_svg_is_pasted(editor, panel):
    """Inkscape's clipboard was "no style", for all that Inkscape itself pastes styles from it."""
    editor.session.change("Unit", lambda document: replace(document, unit="cm"))
    data = QMimeData()
    look = "fill:#0072b2;stroke:#d55e00;stroke-width:0.5;stroke-linejoin:round"
    size = 'width="40mm" height="40mm" viewBox="0 0 40 40"'
    data.setData(
        "image/svg+xml",
        f'<svg xmlns="http://www.w3.org/2000/svg" {size}><g style="{look}"><path d="M0 0H9"/></g>'
        '<path d="M0 0V9" fill="#123456"/></svg>'.encode(),
    )
    QGuiApplication.clipboard().setMimeData(data)
    editor.session.selected.set_curves([0, 2])
    QTest.keyClick(
        editor.window, Qt.Key.Key_V, Qt.KeyboardModifier.ControlModifier | Qt.KeyboardModifier.ShiftModifier
    )
    editor.wait_for_work()
    wanted = Style("#d55e00", 0.05, LineCap.BUTT, LineJoin.ROUND, fill="#0072b2")
    assert [styles(editor)[place] for place in (0, 2)] == [wanted] * 2
    assert editor.session.undo_stack.undoText() == "Paste style to 2 curves"
    editor.paste_text("M 0 0 L 4 4")
    editor.trigger("pasteStyle")
    assert "no style on the clipboard" in editor.status


# On the canvas


def test_fill_and_stroke_have_their_position_and_width(editor):
    style = Style(stroke=RED, width=0.4, fill=BLUE)
    begin(editor, square(0, 0, 4, "Leaf", style=style), make_curve([(8, 0), (9, 3)], name="Other"), active=1)
    for active in (1, 0):
        editor.session.selected.activate(active)
        editor.select([])
        assert colour_at(editor, 2, 2) == BLUE
        assert [colour_at(editor, x, 2.7) for x in (-0.15, 0.15)] == [RED, RED]
        assert colour_at(editor, 0.25, 2.7) == BLUE
        assert colour_at(editor, -0.25, 2.7) == LIGHT.paper.name()
    # It is a width of the plane.
    editor.wheel((0, 2.7), 2)
    assert [colour_at(editor, x, 2.7) for x in (-0.15, 0.15)] == [RED, RED]
    assert colour_at(editor, 0.25, 2.7) == BLUE


def test_an_open_curve_is_filled_to_the_straight_line_between_its_ends(editor):
    arc = replace(make_curve([(0, 0), (1, 2), (3, 2), (4, 0)], name="Arc"), style=Style(fill=BLUE))
    begin(editor, arc)
    assert (colour_at(editor, 2, 0.2), colour_at(editor, 2, -0.2)) == (BLUE, LIGHT.paper.name())


def test_the_edited_curve_keeps_its_order(editor):
    below, above = (square(k, k, 4, f"{k}", style=Style(fill=paint)) for k, paint in enumerate((BLUE, RED)))
    begin(editor, below, above)
    for active in (0, 1):
        editor.session.selected.activate(active)
        editor.select([])
        assert colour_at(editor, 2.5, 2.5) == RED
    # Where it runs below is seen all the same: a thin line.
    editor.session.selected.activate(0)
    editor.select([])
    assert colour_at(editor, 4, 2.5) != RED


def test_a_shape_is_painted_right_millions_of_pixels_from_its_end(editor):
    begin(editor, square(0, 0, 4, "Leaf", style=Style(fill=BLUE, stroke=RED, width=0.01)))
    for x, half, colours in (
        (4.0, 1e-8, {RED}),
        (3.99, 1e-6, {BLUE}),
        (4.01, 1e-6, {LIGHT.paper.name()}),
        (3.995, 1e-6, {BLUE, RED}),
    ):
        editor.window.canvas.camera.show_box((x - half, x + half), (2.1 - half, 2.1 + half))
        found = {colour_at(editor, x + share * half, 2.1) for share in (-0.9, -0.5, 0.5, 0.9)}
        assert found == colours, (x, half)


def test_fill_and_stroke_have_separate_opacities(editor):
    style = Style(stroke="#000000", width=1.0, fill="#000000", stroke_opacity=0.5, fill_opacity=0.5)
    begin(editor, square(0, 0, 4, "Leaf", style=style), make_curve([(8, 0), (9, 3)], name="Other"), active=1)
    # Half of the line lies over the fill.
    assert colour_at(editor, 2, 2) == colour_at(editor, -0.25, 2)
    assert 120 < QColor(colour_at(editor, 2, 2)).red() < 130
    assert 60 < QColor(colour_at(editor, 0.25, 2)).red() < 66


def test_dashes_begin_at_the_start_of_the_curve_at_any_zoom(editor):
    style = Style(stroke=RED, width=1.0, cap=LineCap.BUTT, dash=(2.0, 2.0))
    line = replace(make_curve([(0, 0), (400, 0)], name="Line", family=HERMITE), style=style)
    begin(editor, line, make_curve([(0, 5), (9, 8)], name="Other"), active=1)
    canvas = editor.window.canvas
    for start in (0.0, 200.0, 301.3):
        canvas.camera.show_box((start, start + 12.0), (-2.0, 2.0))
        places = np.arange(np.ceil(start) + 1.0, start + 11.0)
        found = [colour_at(editor, x, 0.0) == RED for x in places + 0.0 if x % 2 == 1]
        assert found == [x % 4 < 2 for x in places if x % 2 == 1]


def test_dashes_below_a_pixel_are_painted_in_the_mean_colour(editor):
    """Of an odd number of lengths, dashes and gaps change their roles: half of all is drawn."""
    lines = [
        replace(make_curve([(0, y), (9, y)], family=HERMITE), style=Style(stroke=RED, width=1.0, dash=dash))
        for y, dash in ((0, (1e-4, 1e-4)), (3, (1e-4, 2e-4, 3e-4)))
    ]
    begin(editor, *lines, make_curve([(0, 6), (9, 6)], name="Other"), active=2)
    assert colour_at(editor, 4, 0) == colour_at(editor, 4, 3) not in (RED, LIGHT.paper.name())


# Views


def test_a_colour_adjusted_to_the_dark_theme_has_a_note(editor, panel):
    dim = "#202020"
    begin(editor, square(0, 0, 4, "Leaf", style=Style(stroke=dim, width=0.5)))
    editor.window.context.store.change(theme_mode=ThemeMode.DARK)
    editor.settle()
    assert colour_at(editor, 0, 2.5) not in (dim, LIGHT.paper.name())
    assert f"drawn lighter than {dim}" in child(panel, QLabel, "styleNote").text()
    editor.window.context.store.change(theme_mode=ThemeMode.SYSTEM)


def test_pictures_of_the_other_curves_are_reused_while_a_curve_is_dragged(editor):
    curves = [square(2 * k, 0, 3, f"{k}", style=Style(fill=BLUE, width=0.1)) for k in range(5)]
    begin(editor, *curves, active=2)
    layers = editor.window.canvas.drawing.curves
    editor.settle()
    pictures = layers.others._picture, layers.above._picture
    assert None not in pictures
    editor.drag_point(0, to=(4.5, -1.0))
    assert (layers.others._picture, layers.above._picture) == pictures


# In the list of curves


def test_the_list_shows_stroke_and_fill(editor, panel):
    leaf = square(0, 0, 3, "Leaf", style=Style(stroke=RED, width=0.2, fill=BLUE))
    begin(editor, leaf, square(4, 0, 3, "Stem", style=Style(fill=GREEN, stroke="none")))
    editor.show_dock("curvesDock")
    view = editor.window.findChild(QWidget, "curveList")
    image = view.viewport().grab().toImage()
    counts: dict[str, int] = {}
    for x in range(20):
        for y in range(image.height()):
            code = QColor(image.pixel(x, y)).name()
            counts[code] = counts.get(code, 0) + 1
    assert all(counts.get(code, 0) > 8 for code in (RED, BLUE, GREEN))


def test_the_list_changes_the_visible_colour(editor, panel):
    begin(editor, square(0, 0, 3, "Leaf"), square(4, 0, 3, "Stem", style=Style(fill=GREEN, stroke="none")))
    for row, name, wanted in (
        (0, "colour_Vermillion", Style(stroke=RED)),
        (1, "colour_Vermillion", Style(stroke="none", fill=RED)),
    ):
        editor.click_in_list(row, Spot.SWATCH)
        editor.choose(name)
        assert styles(editor)[row] == wanted
    editor.click_in_list(0, Spot.SWATCH)
    editor.choose("colour_Other")
    choice = QApplication.activePopupWidget()
    assert isinstance(choice, ColourPopup)
    pick(choice, "#123456")
    assert styles(editor)[0].stroke == "#123456"
    assert editor.session.is_previewing
    QTest.keyClick(choice, Qt.Key.Key_Return)
    editor.settle()
    assert not editor.session.is_previewing
    assert styles(editor)[0] == Style(stroke="#123456")


def test_the_list_sets_fills(editor, panel):
    editor.click_in_list(2, Spot.SWATCH)
    menu = editor.menu()
    (inside,) = [each.menu() for each in menu.actions() if each.menu() is not None]
    (entry,) = [each for each in inside.actions() if each.objectName() == "fill_Blue"]
    entry.trigger()
    menu.close()
    assert styles(editor)[2].fill == BLUE
    assert editor.session.undo_stack.undoText() == "Fill Root"


def test_a_new_curve_has_the_style_of_the_last_one(editor, panel):
    click(panel, "strokePaint_Blue")
    enter(editor, panel, "strokeWidth", "0.5")
    editor.trigger("newCurve")
    assert styles(editor)[editor.session.active_index] == Style(stroke=BLUE, width=0.5)
    assert len(styles(editor)) == 4


def test_without_a_selection_the_panel_shows_and_sets_the_next_style(editor, panel):
    editor.escape()
    assert editor.session.selected.whole_curves == {1}
    assert child(panel, QLabel, "styleSubject").text() == "Stem"
    editor.key(Qt.Key.Key_Delete)
    assert [curve.name for curve in editor.session.document.curves] == ["Leaf", "Root"]
    before, steps = editor.session.document, editor.session.undo_stack.count()
    assert child(panel, QLabel, "styleSubject").text() == "The next curve"
    note = "No curve is selected: this style is for the next curve. Click a curve, or press Ctrl+A for all."
    assert child(panel, QLabel, "styleNote").text() == note
    assert not editor.action("copyStyle").isEnabled()
    assert not editor.action("pasteStyle").isEnabled()
    enter(editor, panel, "strokeWidth", "0.25")
    enter(editor, panel, "fillPaintHex", BLUE)
    QTest.keyClick(child(panel, QSlider, "strokeOpacitySlider"), Qt.Key.Key_Home)
    enter(editor, panel, "fillOpacity", "50 %")
    assert editor.session.document is before
    assert editor.session.undo_stack.count() == steps
    editor.trigger("rectangleTool")
    assert child(panel, QLabel, "styleSubject").text() == "The next curve"
    assert text_of(panel, "strokeWidth") == "0.25 cm"
    editor.fit()
    editor.drag((1, 1), (3, 3))
    drawn = editor.session.document.curves[-1].style
    assert (drawn.width, drawn.fill, drawn.fill_opacity, drawn.stroke_opacity) == (0.25, BLUE, 0.5, 0.0)
    assert child(panel, QLabel, "styleSubject").text() == editor.curve.name
    assert editor.session.document.curves[:-1] == before.curves
    editor.session.undo_stack.undo()
    editor.trigger("selectTool")
    editor.key(Qt.Key.Key_A, Qt.KeyboardModifier.ControlModifier)
    assert child(panel, QLabel, "styleSubject").text() == "2 curves"
    enter(editor, panel, "strokeWidth", "0.5")
    assert [curve.style.width for curve in editor.session.document.curves] == [0.5, 0.5]


def test_a_fine_line_is_drawn_without_qt_s_stroker_and_not_made_for_the_edited_curve_again(
    editor, monkeypatch
):
    begin(editor, square(0, 0, 4, "Leaf"))
    width = 3.0 / editor.window.canvas.pixel_map.sx
    curve = square(0, 0, 4, "Leaf", style=Style(stroke=RED, width=width, fill=BLUE))
    editor.session.commit(Document((curve,)), "Style")
    lines, stroked, plain = (
        noted_calls(monkeypatch, owner, "fill") for owner in (RoundLine, Stroke, WideLine)
    )
    editor.drag_point(2, to=(4.5, 4.5))
    assert pytest.approx(3.0) in [width for *_, width in lines]
    assert not stroked
    assert len(plain) == 0


# Swapped


def test_swapping_fill_and_stroke_swaps_the_opacities_of_all_selected_curves(editor, panel):
    looks = (
        Style(fill=RED, fill_opacity=0.5, stroke=BLUE, width=0.3, stroke_opacity=0.8),
        Style(stroke=GREEN, fill=BLUE),
        Style(fill=RED, stroke=NO_PAINT),
    )
    curves = tuple(
        replace(curve, style=look) for curve, look in zip(editor.session.document.curves, looks, strict=True)
    )
    begin(editor, *curves, unit="cm")
    editor.session.selected.select_whole({0, 1, 2})
    click(panel, "swapFillAndStrokeButton")
    first, second, third = (curve.style for curve in editor.session.document.curves)
    assert first == Style(fill=BLUE, fill_opacity=0.8, stroke=RED, stroke_opacity=0.5, width=0.3)
    assert (second.stroke, second.fill) == (BLUE, GREEN)
    assert (third.fill, third.stroke) == (NO_PAINT, RED)
    assert editor.session.undo_stack.undoText() == "Swap fill and stroke of 3 curves"
    editor.key(Qt.Key.Key_X, Qt.KeyboardModifier.ShiftModifier)
    assert editor.session.document == Document(curves, unit="cm")


def test_swapping_fill_and_stroke_without_a_selection_changes_the_next_style(editor, panel):
    editor.session.selected.select_whole(())
    before, style = editor.session.document, editor.session.template_curve.style
    editor.key(Qt.Key.Key_X, Qt.KeyboardModifier.ShiftModifier)
    now = editor.session.template_curve.style
    assert (now.fill, now.stroke) == (style.stroke, style.fill) != (style.fill, style.stroke)
    assert editor.session.document is before


def test_recent_colours_are_listed_below_without_moving_other_widgets(editor, panel):
    """In one row they pushed ends of rows out of the dock; a new row pushed Width from under a click."""
    editor.select([])
    edit, before = panel.findChild(QLineEdit, "fillPaintHex"), panel.minimumSizeHint()
    rows = [child(panel, QWidget, name) for name in ("strokePaint_Blue", "strokeWidth", "strokeOpacity")]
    places = [row.mapTo(panel, QPoint()) for row in rows]
    assert panel.findChild(QToolButton, "fillPaint_#102030") is None
    used = ["#102030", "#405060", "#708090", "#a0b0c0", "#d0e0f0"]
    for colour in used:
        enter(editor, panel, "fillPaintHex", colour)
    swatches = [panel.findChild(QToolButton, f"fillPaint_{colour}") for colour in used]
    always = panel.findChild(QToolButton, "fillPaint_Blue")
    level = always.mapTo(panel, QPoint()).y()
    assert all(each.isVisible() and each.mapTo(panel, QPoint()).y() > level for each in swatches)
    assert panel.minimumSizeHint() == before
    assert [row.mapTo(panel, QPoint()) for row in rows] == places
    QTest.mouseClick(swatches[0], Qt.MouseButton.LeftButton)
    editor.settle()
    assert edit.text() == used[0]


def test_the_preset_of_dots_sets_round_ends_and_typed_invisible_dots_have_a_note(editor, panel):
    """Butt ends of a dash of length 0 are nothing at all: the line was gone."""
    note = child(panel, QLabel, "styleUnseenDots")
    click(panel, "lineCap_butt")
    steps = editor.session.undo_stack.count()
    box = child(panel, QComboBox, "dashBox")
    box.setFocus()
    QTest.keyClick(box, Qt.Key.Key_Down)
    editor.settle()
    assert (styles(editor)[1].dash, styles(editor)[1].cap) == ((0.0, 2.0), LineCap.ROUND)
    assert editor.session.undo_stack.count() == steps + 1
    assert not note.isVisible()
    enter(editor, panel, "dashList", "4 1 0 1")
    click(panel, "lineCap_butt")
    assert note.isVisible()
    assert "invisible with butt ends" in note.text()
    assert styles(editor)[1].dash == (4.0, 1.0, 0.0, 1.0)
    click(panel, "lineCap_square")
    assert not note.isVisible()
