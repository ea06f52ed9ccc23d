"""Light and dark: legible, told apart, complete."""

import itertools

import numpy as np
import pytest
import shiboken6
from PySide6.QtCore import QEvent, QObject, QPoint, QSize, Qt
from PySide6.QtGui import QColor, QIcon, QPalette
from PySide6.QtTest import QTest
from PySide6.QtWidgets import (
    QAbstractButton,
    QApplication,
    QCheckBox,
    QComboBox,
    QDialog,
    QDialogButtonBox,
    QDoubleSpinBox,
    QLineEdit,
    QMainWindow,
    QPushButton,
    QSpinBox,
    QToolBar,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from app.appearance.colours import line_colour, point_colours
from app.appearance.icons import app_icon, icon
from app.appearance.theme import (
    DARK,
    LIGHT,
    ThemeMode,
    apply_theme,
    palette_of,
    rim,
    style_sheet_of,
    theme_of,
)
from app.storage.resources import resource
from app.workbench.docks import Dock
from tests.waiting import until

THEMES = [pytest.param(LIGHT, id="light"), pytest.param(DARK, id="dark")]
ICONS = sorted(path.stem for path in resource("icons").glob("*.svg"))

# The colour arithmetic below is this test's own: WCAG 2.2 for contrast, OKLab (Ottosson 2020) for
# distance and hue, Machado, Oliveira & Fernandes (2009) at severity 1 for colour blindness.
RGB_TO_LMS = np.array(
    [
        [0.4122214708, 0.5363325363, 0.0514459929],
        [0.2119034982, 0.6806995451, 0.1073969566],
        [0.0883024619, 0.2817188376, 0.6299787005],
    ]
)
LMS_TO_LAB = np.array(
    [
        [0.2104542553, 0.7936177850, -0.0040720468],
        [1.9779984951, -2.4285922050, 0.4505937099],
        [0.0259040371, 0.7827717662, -0.8086757660],
    ]
)
EYES = {
    "normal": np.eye(3),
    "protanopia": np.array(
        [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]]
    ),
    "deuteranopia": np.array(
        [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]]
    ),
    "tritanopia": np.array(
        [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]]
    ),
}
OKABE_ITO = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#f0e442"]


def linear(colours):
    srgb = np.array([QColor(colour).getRgbF()[:3] for colour in colours])
    return np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)


def oklab(colours, eyes="normal"):
    seen = np.clip(linear(colours) @ EYES[eyes].T, 0.0, 1.0)
    return np.cbrt(seen @ RGB_TO_LMS.T) @ LMS_TO_LAB.T


def contrast(one, other):
    dark, light = sorted(linear([one, other]) @ np.array([0.2126, 0.7152, 0.0722]))
    return (light + 0.05) / (dark + 0.05)


def test_the_contrast_formula_matches_known_contrasts():
    assert contrast("black", "white") == pytest.approx(21.0)
    # Hand check from the WCAG literature: #767676 is the lightest grey that passes 4.5 on white.
    assert contrast("#767676", "white") == pytest.approx(4.54, abs=0.005)


@pytest.mark.parametrize("theme", THEMES)
def test_text_is_readable_on_paper_and_panels(theme):
    for text, ground in itertools.product(
        (theme.ink, theme.muted, theme.accent, theme.warning), (theme.paper, theme.surface)
    ):
        assert contrast(text, ground) >= 4.5, (text.name(), ground.name())


@pytest.mark.parametrize("theme", THEMES)
def test_the_curve_has_the_highest_contrast_and_the_grid_the_lowest(theme):
    order = [theme.grid_fine, theme.grid_coarse, theme.ghost, theme.handle, theme.curve]
    strength = [contrast(colour, theme.paper) for colour in order]
    assert strength == sorted(strength)
    assert strength[3] >= 3.0  # handles are dragged, so they must be seen
    assert strength[1] < 1.6


@pytest.mark.parametrize("theme", [LIGHT, DARK], ids=lambda each: each.name)
def test_marks_are_visible_on_the_paper(theme):
    marks = [theme.accent, theme.handle, theme.warning]
    for mark in marks:
        assert contrast(mark, theme.paper) >= 3.0, mark.name()
    for words in (theme.accent, theme.muted, theme.ink):
        assert contrast(words, theme.paper) >= 4.5, words.name()


def test_the_colours_of_the_brief():
    assert (LIGHT.paper.name(), LIGHT.ink.name()) == ("#fafafa", "#1f2328")
    assert (DARK.paper.name(), DARK.ink.name()) == ("#15181c", "#e6e8ea")


@pytest.mark.parametrize("theme", THEMES)
@pytest.mark.parametrize("n", [1, 8, 9, 60, 1000])
def test_every_point_has_contrast_to_the_paper(theme, n):
    colours = point_colours(n, theme)
    assert len(colours) == n
    assert all(colour.alpha() == 255 for colour in colours)
    assert min(contrast(colour, theme.paper) for colour in colours) >= 3.0


def test_words_in_colours_of_points_are_readable_on_dark_paper():
    """The number of point 0 and |v| of the motion were dark blue on black: 3.4."""
    assert min(contrast(colour, DARK.paper) for colour in point_colours(8, DARK)) >= 4.5
    for code, drawn in zip(OKABE_ITO, point_colours(7, DARK), strict=True):
        assert line_colour(code, DARK) == drawn


@pytest.mark.parametrize("theme", THEMES)
def test_up_to_eight_points_have_the_hues_of_okabe_and_ito(theme):
    colours = point_colours(8, theme)
    assert colours[7] == theme.ink
    hue, wanted = (np.arctan2(lab[:, 2], lab[:, 1]) for lab in (oklab(colours[:7]), oklab(OKABE_ITO)))
    turn = np.degrees(np.angle(np.exp(1j * (hue - wanted))))
    # Rounding to 8 bits moves the hue of these chromas (0.1 and more) by less than a degree.
    assert np.abs(turn).max() < 1.5


def test_up_to_eight_points_keep_their_colours_when_a_point_is_added():
    for n in range(8):
        assert point_colours(n, DARK) == point_colours(n + 1, DARK)[:n]
    assert point_colours(0, LIGHT) == ()


@pytest.mark.parametrize("theme", THEMES)
@pytest.mark.parametrize("eyes", EYES)
def test_eight_points_have_colours_that_colour_blind_people_distinguish(theme, eyes):
    lab = oklab(point_colours(8, theme), eyes)
    least = min(np.linalg.norm(a - b) for a, b in itertools.combinations(lab, 2))
    # A step of 0.02 is just seen; the published colours, untouched, come down to 0.06 to 0.08.
    # Lightening and darkening them just far enough for the contrast came down to 0.014.
    assert least > 0.06


@pytest.mark.parametrize("theme", THEMES)
@pytest.mark.parametrize("n", [9, 12, 60, 1000])
def test_a_ramp_is_even_and_neighbours_differ(theme, n):
    lab = oklab(point_colours(n, theme))
    step = np.linalg.norm(np.diff(lab, axis=0), axis=1)
    assert step.min() >= 0.04
    # Same side of the alternation: the hue circle itself. 8 bits and the edge of sRGB cost a little.
    ring = np.linalg.norm(lab[2:] - lab[:-2], axis=1)
    if n <= 60:
        assert ring.max() < 1.6 * ring.min() + 0.006


def test_a_palette_determines_the_theme():
    assert theme_of(palette_of(LIGHT)) is LIGHT
    assert theme_of(palette_of(DARK)) is DARK
    assert theme_of(QPalette(QColor("#202020"))) is DARK


@pytest.mark.parametrize("theme", THEMES)
def test_palettes_are_complete(theme):
    palette = palette_of(theme)
    roles = [
        role
        for role in QPalette.ColorRole
        if role not in {QPalette.ColorRole.NoRole, QPalette.ColorRole.NColorRoles}
    ]
    groups = [QPalette.ColorGroup.Active, QPalette.ColorGroup.Inactive, QPalette.ColorGroup.Disabled]
    for group, role in itertools.product(groups, roles):
        assert palette.isBrushSet(group, role), (group, role)
    text = palette.color(QPalette.ColorGroup.Active, QPalette.ColorRole.Text)
    assert palette.color(QPalette.ColorGroup.Disabled, QPalette.ColorRole.Text) != text


@pytest.mark.parametrize("theme", THEMES)
def test_the_style_sheet_has_no_colour_left_open(theme):
    assert "$" not in style_sheet_of(theme)


def forget_the_system(app):
    """As if no theme had been applied in this process."""
    follower = app.findChild(QObject, "themeFollower")
    if follower is not None:
        shiboken6.delete(follower)


@pytest.fixture
def dressed(qapp):
    """The application, undressed again afterwards."""
    style, palette, sheet = qapp.style().name(), qapp.palette(), qapp.styleSheet()
    # Another test may have put the palette back that all have, and with it taken away those of some classes.
    qapp.setStyleSheet("")
    yield qapp
    forget_the_system(qapp)
    qapp.setStyleSheet(sheet)
    qapp.setStyle(style)
    qapp.setPalette(palette)


class Canvas(QWidget):
    """Notes the theme that each change of the palette brings."""

    def __init__(self):
        super().__init__()
        self.told = []

    def changeEvent(self, event):
        if event.type() is QEvent.Type.PaletteChange:
            self.told.append(theme_of(self.palette()))
        super().changeEvent(event)


def test_another_theme_sets_the_style_no_second_time(dressed, qtbot, monkeypatch):
    """Under a style sheet it has no name, and was taken for another one: every widget was polished twice."""
    set_to = []
    apply_theme(dressed, ThemeMode.LIGHT)
    monkeypatch.setattr(QApplication, "setStyle", set_to.append)
    apply_theme(dressed, ThemeMode.DARK)
    assert set_to == []


def test_a_new_theme_is_applied_to_open_windows_at_once(dressed, qtbot):
    window = QMainWindow()
    qtbot.addWidget(window)
    canvas = Canvas()
    window.setCentralWidget(canvas)
    window.addToolBar("Tools").addAction("Grid").setCheckable(True)
    apply_theme(dressed, ThemeMode.LIGHT)
    window.show()
    for mode, theme in [(ThemeMode.DARK, DARK), (ThemeMode.LIGHT, LIGHT), (ThemeMode.DARK, DARK)]:
        canvas.told.clear()
        assert apply_theme(dressed, mode) is theme
        assert theme_of(dressed.palette()) is theme
        assert theme_of(window.palette()) is theme
        assert set(canvas.told) == {theme}


def test_following_the_system_replaces_the_set_theme(dressed):
    own = apply_theme(dressed, ThemeMode.SYSTEM)
    apply_theme(dressed, ThemeMode.DARK if own is LIGHT else ThemeMode.LIGHT)
    assert apply_theme(dressed, ThemeMode.SYSTEM) is own


def test_a_system_without_a_colour_scheme_is_judged_by_its_palette(dressed):
    for theme in (DARK, LIGHT):
        forget_the_system(dressed)
        dressed.setPalette(palette_of(theme))
        assert apply_theme(dressed, ThemeMode.SYSTEM) is theme


def test_the_same_theme_again_changes_no_widget(dressed, qtbot):
    canvas = Canvas()
    qtbot.addWidget(canvas)
    apply_theme(dressed, ThemeMode.DARK)
    canvas.show()
    canvas.told.clear()
    apply_theme(dressed, ThemeMode.DARK)
    assert canvas.told == []


def test_a_change_of_the_system_is_followed_only_when_asked_for(dressed):
    own = apply_theme(dressed, ThemeMode.SYSTEM)
    dressed.setPalette(palette_of(DARK if own is LIGHT else LIGHT))
    dressed.styleHints().colorSchemeChanged.emit(Qt.ColorScheme.Unknown)
    assert theme_of(dressed.palette()) is own
    apply_theme(dressed, ThemeMode.DARK)
    dressed.styleHints().colorSchemeChanged.emit(Qt.ColorScheme.Light)
    assert theme_of(dressed.palette()) is DARK


MODES = [
    pytest.param(ThemeMode.LIGHT, LIGHT, id="light"),
    pytest.param(ThemeMode.DARK, DARK, id="dark"),
]


def editable_box():
    box = QComboBox()
    box.setEditable(True)
    return box


def left_border(widget):
    """Return the colours of the first pixels from the left edge, halfway down."""
    image = widget.grab().toImage()
    return [image.pixelColor(x, image.height() // 2) for x in range(3)]


@pytest.mark.parametrize(("mode", "theme"), MODES)
@pytest.mark.parametrize("make", [QLineEdit, QSpinBox, QDoubleSpinBox, QComboBox, editable_box])
def test_fields_have_a_visible_border_that_shows_the_focus(dressed, qtbot, mode, theme, make):
    apply_theme(dressed, mode)
    panel, field = QWidget(), make()
    layout = QVBoxLayout(panel)
    layout.addWidget(QPushButton())
    layout.addWidget(field)
    qtbot.addWidget(panel)
    with qtbot.waitExposed(panel):
        panel.show()
    panel.activateWindow()
    field.clearFocus()
    calm = max(left_border(field), key=lambda colour: contrast(colour, theme.surface))
    assert contrast(calm, theme.surface) >= 3.0
    assert contrast(calm, theme.paper) >= 3.0
    field.setFocus(Qt.FocusReason.TabFocusReason)
    until(field.hasFocus)
    ring = max(left_border(field), key=lambda colour: colour.hsvSaturation())
    assert ring.hsvHue() == pytest.approx(theme.accent.hsvHue(), abs=8)
    assert contrast(ring, theme.surface) >= 3.0


@pytest.mark.parametrize(("mode", "theme"), MODES)
def test_check_boxes_have_a_visible_border(dressed, qtbot, mode, theme):
    apply_theme(dressed, mode)
    box = QCheckBox("Grid")
    qtbot.addWidget(box)
    border = max(left_border(box), key=lambda colour: contrast(colour, theme.surface))
    assert contrast(border, theme.surface) >= 3.0


@pytest.mark.parametrize(("mode", "theme"), MODES)
def test_buttons_are_flat(dressed, qtbot, mode, theme):
    apply_theme(dressed, mode)
    for button in (QPushButton("Close"), QComboBox()):
        qtbot.addWidget(button)
        button.resize(90, 26)
        image = button.grab().toImage()
        # Between border and words: a gradient would have other colours above than below.
        assert len({image.pixelColor(5, y).name() for y in range(2, 24)}) == 1


@pytest.mark.parametrize(("mode", "theme"), MODES)
def test_the_buttons_of_docks_are_visible(dressed, qtbot, mode, theme):
    apply_theme(dressed, mode)
    window = QMainWindow()
    dock = Dock("Points", QWidget, window)
    dock.setObjectName("pointsDock")
    dock.fill()
    window.addDockWidget(Qt.DockWidgetArea.RightDockWidgetArea, dock)
    qtbot.addWidget(window)
    with qtbot.waitExposed(window):
        window.show()
    buttons = dock.titleBarWidget().findChildren(QAbstractButton)
    assert len(buttons) == 2
    for button in buttons:
        seen = [colour for colour in pixels(button.grab()) if contrast(colour, theme.surface) >= 3.0]
        assert min(button.width(), button.height()) >= 16
        assert len(seen) >= 10


def test_buttons_of_dialogs_have_texts_and_no_icons(dressed, qtbot):
    apply_theme(dressed, ThemeMode.DARK)
    buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Close)
    qtbot.addWidget(buttons)
    assert buttons.button(QDialogButtonBox.StandardButton.Close).icon().isNull()


@pytest.mark.parametrize("theme", THEMES)
def test_images_of_the_style_sheet_exist_in_the_muted_colour(theme):
    files = sorted(resource("icons", "styled").glob(f"*-{theme.name}.svg"))
    assert [path.stem.partition("-")[0] for path in files] == ["arrow", "more"]
    for path in files:
        assert path.as_posix() in style_sheet_of(theme)
        assert f'stroke="{theme.muted.name()}"' in path.read_text(encoding="utf-8")
    assert contrast(rim(theme), theme.surface) >= 3.0


def pixels(image):
    image = image.toImage()
    return [image.pixelColor(x, y) for x in range(image.width()) for y in range(image.height())]


@pytest.mark.parametrize("name", [name for name in ICONS if name != "app"])
def test_every_icon_draws_in_ink_and_stays_inside(qapp, name):
    drawn = icon(name, LIGHT).pixmap(QSize(24, 24), 1.0)
    seen = [colour for colour in pixels(drawn) if colour.alpha() > 200]
    assert seen
    # Premultiplied 8-bit alpha costs at most two steps of a channel above alpha 200.
    assert all(abs(colour.red() - LIGHT.ink.red()) <= 2 for colour in seen)
    image = drawn.toImage()
    corners = [image.pixelColor(x, y).alpha() for x in (0, 23) for y in (0, 23)]
    assert corners == [0, 0, 0, 0]


@pytest.mark.parametrize("ratio", [1.0, 2.0])
@pytest.mark.parametrize("size", [16, 20, 24, 32, 40])
def test_icons_are_drawn_at_their_exact_size(qapp, size, ratio):
    drawn = icon("open", DARK).pixmap(QSize(size, size), ratio)
    assert drawn.size() == QSize(round(size * ratio), round(size * ratio))
    assert drawn.devicePixelRatio() == ratio


def test_icons_show_checked_and_disabled(qapp):
    grid = icon("grid", LIGHT)

    def strongest(mode, state):
        return max(pixels(grid.pixmap(QSize(32, 32), 1.0, mode, state)), key=lambda colour: colour.alpha())

    assert strongest(QIcon.Mode.Normal, QIcon.State.Off).name() == LIGHT.ink.name()
    assert strongest(QIcon.Mode.Normal, QIcon.State.On).name() == LIGHT.accent.name()
    disabled = strongest(QIcon.Mode.Disabled, QIcon.State.Off)
    assert contrast(disabled, LIGHT.surface) < contrast(LIGHT.muted, LIGHT.surface)
    assert strongest(QIcon.Mode.Disabled, QIcon.State.On) == disabled


def test_upright_lines_are_crisp_at_16_pixels(qapp):
    # Centred on x = 3/24 of 16 px a line fell on two half-grey columns.
    picture = icon("comb", LIGHT).pixmap(QSize(16, 16), 1.0)
    column = [colour.alpha() for colour in pixels(picture)]
    assert max(column) == 255


def test_icons_are_loaded_once(qapp):
    assert icon("save", LIGHT) is icon("save", LIGHT)
    assert icon("save", LIGHT) is not icon("save", DARK)


def test_an_unknown_icon_is_named(qapp):
    with pytest.raises(FileNotFoundError, match=r"resources/icons/unicorn\.svg"):
        icon("unicorn", LIGHT)


def test_the_program_has_its_own_icon(qapp):
    sizes = app_icon().availableSizes()
    assert QSize(16, 16) in sizes
    assert QSize(256, 256) in sizes


def test_resources_without_a_name_give_the_folder():
    assert resource().is_dir()
    assert resource("icons", "app.svg").is_file()


def test_check_boxes_have_a_visible_border_in_the_dark_theme(editor):
    editor.trigger("exportPicture")
    dialog = editor.window.findChild(QDialog, "exportDialog")
    rims = {}
    for name in ("themeDark", "themeLight"):
        editor.trigger(name)
        theme = theme_of(dialog.palette())
        names = ("points", "handles", "grid", "basis", "transparent")
        for widget in (dialog.form.fields[name].widget for name in names):
            QTest.mouseClick(widget, Qt.MouseButton.LeftButton, pos=QPoint(8, widget.height() // 2))
            picture = widget.grab().toImage()
            row = [picture.pixelColor(x, picture.height() // 2) for x in range(picture.width() // 4)]
            rims[name, widget] = max(contrast(colour, theme.surface) for colour in row[:3])
            assert theme_of(widget.parentWidget().palette()) is theme
    assert min(rim for (name, _), rim in rims.items() if name == "themeDark") > 3
    assert min(rim for (name, _), rim in rims.items() if name == "themeLight") > 1.3
    dialog.close()


@pytest.mark.parametrize(("mode", "theme"), [(ThemeMode.LIGHT, LIGHT), (ThemeMode.DARK, DARK)])
def test_the_extension_arrow_of_the_toolbar_is_visible(dressed, qtbot, mode, theme):
    apply_theme(dressed, mode)
    bar = QToolBar()
    qtbot.addWidget(bar)
    for number in range(9):
        bar.addAction(f"Action {number}")
    bar.resize(200, 40)
    with qtbot.waitExposed(bar):
        bar.show()
    arrow = bar.findChild(QToolButton, "qt_toolbar_ext_button")
    assert arrow.isVisible()
    seen = [colour for colour in pixels(arrow.grab()) if contrast(colour, theme.surface) >= 3.0]
    assert len(seen) >= 12  # it was a dot: 0 in the dark, 1 in the light
