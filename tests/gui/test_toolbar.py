"""The toolbar in windows of different widths, with few families and with many."""

from itertools import product

import pytest
from PySide6.QtCore import QPoint, Qt, QTimer
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QComboBox, QStyle, QStyleOptionComboBox, QToolButton, QWidget

from app.document.model import ParametrizationKind
from app.families import FAMILIES, HERMITE, LAGRANGE, QUINTIC_HERMITE, Family
from app.testing import Editor
from app.tools.tool import TOOLS
from curvecore import LagrangeCurve

CTRL, SHIFT = Qt.KeyboardModifier.ControlModifier, Qt.KeyboardModifier.ShiftModifier
FIRST = (LAGRANGE, HERMITE, QUINTIC_HERMITE)
TEXT, BOTH, ICON = (
    Qt.ToolButtonStyle.ToolButtonTextOnly,
    Qt.ToolButtonStyle.ToolButtonTextBesideIcon,
    Qt.ToolButtonStyle.ToolButtonIconOnly,
)


@pytest.fixture
def editor_with(qtbot):
    """Make an editor of a width that offers so many families: three as they are, the others of the test."""
    others = [family for family in FAMILIES if family not in FIRST]
    added = []

    def editor_with(count, width):
        for family in others:
            FAMILIES.remove(family)
        for k in range(count - len(FIRST)):
            body = {"__slots__": (), "name": f"tests_no_{k}", "title": f"invented no. {k}"}
            added.append(Family.of(type("InventedCurve", (LagrangeCurve,), body)))
            FAMILIES.add(added[-1])
        return Editor(qtbot, size=(width, 800))

    yield editor_with
    for family in added:
        FAMILIES.remove(family)
    for family in others:
        FAMILIES.add(family)


def button_of(editor, name):
    return editor.window.toolbar.widgetForAction(editor.action(name))


def styles(editor):
    """How the families that have a button of their own are shown."""
    return [button_of(editor, family.action_name).toolButtonStyle() for family in FIRST]


def menu_button(editor):
    return editor.window.findChild(QToolButton, "familiesButton")


def all_are_seen(editor):
    """Whether three families have a button and all others stand in the menu, and both are seen whole."""
    further = [editor.action(family.action_name) for family in FAMILIES[len(FIRST) :]]
    button = menu_button(editor)
    assert button.menu().actions() == further
    shown = [button_of(editor, family.action_name) for family in FIRST] + [button] * bool(further)
    assert button.isVisible() is bool(further)
    return all(each.visibleRegion().boundingRect() == each.rect() for each in shown)


def is_as_said(editor, width, words, style):
    """Whether the toolbar of a window that is made as wide says so much, and all that it has is seen."""
    editor.window.resize(width, 800)
    editor.settle()
    toolbar = editor.window.toolbar
    assert toolbar.sizeHint().width() <= toolbar.width() == width
    assert editor.action("familyQuinticHermite").iconText() == words
    assert styles(editor) == style
    return all_are_seen(editor)


@pytest.mark.parametrize(
    ("count", "rows"),
    [
        (
            3,
            [
                (1280, "Quintic Hermite", [BOTH] * 3),
                (1040, "Quintic", [TEXT] * 3),
                (1000, "Quintic", [BOTH, ICON, ICON]),
                (960, "Quintic", [ICON] * 3),
            ],
        ),
        (
            4,
            [
                (1440, "Quintic Hermite", [BOTH] * 3),
                (1280, "Quintic", [BOTH] * 3),
                (1040, "Quintic", [BOTH, ICON, ICON]),
            ],
        ),
        (
            8,
            [
                (1440, "Quintic Hermite", [BOTH] * 3),
                (1280, "Quintic", [BOTH] * 3),
                (1040, "Quintic", [BOTH, ICON, ICON]),
                (960, "Quintic", [ICON] * 3),
            ],
        ),
    ],
    ids=lambda value: str(value) if isinstance(value, int) else "",
)
def test_the_toolbar_shows_as_much_text_as_fits(editor_with, count, rows):
    """However many families there are: those after three stand in a menu. On the way down and up again."""
    editor = editor_with(count, rows[0][0])
    for row in (*rows, *rows[::-1]):
        assert is_as_said(editor, *row), row


@pytest.mark.parametrize(("count", "width"), [(3, 900), (4, 900), (8, 920)])
def test_families_and_the_rule_stay_visible_in_a_narrow_window(editor_with, count, width):
    editor = editor_with(count, width)
    assert editor.window.toolbar.sizeHint().width() > editor.window.toolbar.width() == width
    assert styles(editor) == [ICON] * 3
    assert all_are_seen(editor)
    assert button_of(editor, "fitView").isVisible()
    box = editor.window.findChild(QComboBox, "parametrizationBox")
    assert box.visibleRegion().boundingRect() == box.rect()


def test_the_name_of_every_rule_is_read_whole(editor_with):
    editor = editor_with(8, 1024)
    box = editor.window.findChild(QComboBox, "parametrizationBox")
    slider = editor.window.findChild(QWidget, "alphaSlider")
    for width, kind in product((1024, 1440), ParametrizationKind):
        if editor.window.width() != width:
            editor.window.resize(width, 800)
            editor.settle()
        editor.choose_parametrization(kind)
        room = box.style().subControlRect(
            QStyle.ComplexControl.CC_ComboBox, combo_option(box), QStyle.SubControl.SC_ComboBoxEditField, box
        )
        # The power has its exponent beside it.
        assert box.currentText() == kind.label + " = 0.50" * (kind is ParametrizationKind.POWER)
        assert box.fontMetrics().horizontalAdvance(box.currentText()) <= room.width(), (width, kind)
        assert slider.isVisible(), (width, kind)
        assert editor.window.toolbar.sizeHint().width() <= width, (width, kind)


def combo_option(box):
    option = QStyleOptionComboBox()
    box.initStyleOption(option)
    return option


def test_the_toolbar_text_matches_the_current_family(editor_with):
    editor = editor_with(4, 1040)
    editor.trigger("familyHermite")
    assert styles(editor) == [ICON, BOTH, ICON]
    editor.trigger("undo")
    assert styles(editor) == [BOTH, ICON, ICON]


@pytest.mark.parametrize("width", [1024, 1440])
def test_the_button_of_the_menu_shows_the_family_in_use(editor_with, width):
    editor = editor_with(5, width)
    button = menu_button(editor)
    before = button.width()
    assert (button.isChecked(), button.text(), button.toolTip()) == (
        False,
        "Families",
        "More families of curves",
    )
    family = FAMILIES[4]
    QTimer.singleShot(0, lambda: choose_in_menu(editor, family))
    QTest.mouseClick(button, Qt.MouseButton.LeftButton)
    editor.settle()
    assert editor.curve.family == family
    assert (button.isChecked(), button.text()) == (True, "Invented")
    assert button.toolTip() == "More families of curves; in use: Invented no. 1"
    assert button.icon().cacheKey() == editor.action(family.action_name).icon().cacheKey()
    assert button.width() == before
    assert all_are_seen(editor)
    editor.trigger("familyLagrange")
    assert (button.isChecked(), button.text()) == (False, "Families")


def choose_in_menu(editor, family):
    menu = menu_button(editor).menu()
    action = editor.action(family.action_name)
    assert (action.text(), action.isCheckable(), action.isChecked()) == (family.label, True, False)
    assert not action.icon().isNull()
    QTest.mouseClick(menu, Qt.MouseButton.LeftButton, pos=menu.actionGeometry(action).center())


def test_a_wider_window_displays_more_text_again(editor_with):
    editor = editor_with(3, 900)
    editor.window.resize(1280, 800)
    editor.settle()
    assert styles(editor) == [BOTH] * 3
    assert editor.action("familyQuinticHermite").iconText() == "Quintic Hermite"
    editor.window.resize(1040, 800)
    editor.settle()
    assert styles(editor) == [TEXT] * 3


@pytest.mark.parametrize("width", [1024, 1440])
def test_one_button_has_the_tools_without_a_button_and_keeps_the_last_one_used(editor_with, width):
    editor = editor_with(8, width)
    button = editor.window.findChild(QToolButton, "moreToolsButton")
    assert button.visibleRegion().boundingRect() == button.rect()
    assert editor.window.toolbar.sizeHint().width() <= width
    names = [tool.action for tool in TOOLS if not tool.in_toolbar]
    assert {"rectangleTool", "ellipseTool", "measureTool"} <= set(names)
    assert [each.objectName() for each in button.menu().actions()] == names
    assert (button.defaultAction(), button.isChecked()) == (editor.action("rectangleTool"), False)
    left = QPoint(12, button.height() // 2)
    QTest.mouseClick(button, Qt.MouseButton.LeftButton, pos=left)
    assert editor.action("rectangleTool").isChecked()
    assert button.isChecked()
    menu, ellipse = button.menu(), editor.action("ellipseTool")

    def choose():
        QTest.mouseClick(menu, Qt.MouseButton.LeftButton, pos=menu.actionGeometry(ellipse).center())

    QTimer.singleShot(0, choose)
    arrow = QPoint(button.width() - 5, button.height() // 2)
    QTest.mouseClick(button, Qt.MouseButton.LeftButton, pos=arrow)
    editor.settle()
    assert ellipse.isChecked()
    assert button.isChecked()
    assert button.icon().cacheKey() == ellipse.icon().cacheKey()
    editor.trigger("selectTool")
    assert not button.isChecked()
    QTest.mouseClick(button, Qt.MouseButton.LeftButton, pos=left)
    assert ellipse.isChecked()


def test_the_toolbar_has_the_same_width_without_a_curve(editor):
    bar = editor.window.findChild(QComboBox, "parametrizationBox").parentWidget()
    width = bar.sizeHint().width()
    editor.new()
    editor.trigger("selectTool")
    bar.render_view(None)
    # A pixel less, and words come back into the toolbar of a window that just has no room for them.
    assert bar.sizeHint().width() == width


@pytest.mark.parametrize("width", [1020, 1026, 1160, 1200])
def test_neither_a_rule_nor_a_family_pushes_a_button_out(editor_with, width):
    """Widths measured without the slider of α, or with a shorter family in use, counted for all others."""
    editor = editor_with(8, 1440)
    for family, kind in (
        (HERMITE, ParametrizationKind.CHEBYSHEV),
        (LAGRANGE, ParametrizationKind.CHORD_LENGTH),
    ):
        editor.choose_family(family)
        editor.choose_parametrization(kind)
        editor.window.resize(width, 800)
        editor.settle()
        assert editor.window.toolbar.sizeHint().width() <= width
        assert button_of(editor, "playMotion").isVisible()


def positions(window):
    """Return the geometry of each widget in the toolbar, and of each dock that is in front."""
    toolbar = window.toolbar
    places = {
        each.objectName(): (each.mapTo(toolbar, QPoint(0, 0)).toTuple(), each.size().toTuple())
        for each in toolbar.findChildren(QWidget)
        if each.objectName() and each.isVisibleTo(toolbar)
    }
    in_front = {
        (dock.x(), dock.width()) for dock in window.context.docks.side if not dock.visibleRegion().isEmpty()
    }
    return places, in_front


@pytest.mark.parametrize("size", [(1440, 900), (1024, 700), (960, 540)])
def test_rules_and_tabs_move_nothing_in_the_toolbar_and_keep_the_width_of_panels(editor_with, size):
    """The box grew by 54 pixels for “Chebyshev”, and the slider of α shrank or went away."""
    editor = editor_with(8, 1440)
    editor.window.resize(*size)
    editor.settle()
    before = positions(editor.window)
    assert before[0].keys() >= {"parametrizationBox", "alphaSlider"}
    for kind in ParametrizationKind:
        editor.choose_parametrization(kind)
        assert positions(editor.window) == before, kind
    for dock in editor.window.context.docks.side:
        editor.show_dock(dock.objectName())
        assert positions(editor.window) == before, dock.objectName()


def test_the_box_of_rules_shows_the_exponent_that_is_dragged(editor_with):
    editor = editor_with(8, 1440)
    before = positions(editor.window)
    editor.choose_parametrization(ParametrizationKind.POWER)
    box = editor.window.findChild(QComboBox, "parametrizationBox")
    slider = editor.window.findChild(QWidget, "alphaSlider")
    slider.setFocus()
    QTest.keyClick(slider, Qt.Key.Key_End)
    editor.settle()
    assert editor.curve.parametrization.alpha == 1.0
    assert box.currentText() == "Power α = 1.00"
    editor.choose_parametrization(ParametrizationKind.UNIFORM)
    assert [box.itemText(index) for index in range(box.count())] == [
        kind.label for kind in ParametrizationKind
    ]
    assert positions(editor.window) == before
