"""Colours, style and icons: how the editor looks in light and in dark."""

from __future__ import annotations

import enum
from dataclasses import dataclass
from functools import lru_cache
from typing import Final

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QByteArray, QObject, QPoint, QRect, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QIcon, QIconEngine, QImage, QPainter, QPalette, QPixmap
from PySide6.QtSvg import QSvgRenderer
from PySide6.QtWidgets import QApplication, QStyleFactory

from app.resources import resource


class ThemeMode(enum.Enum):
    """What the person asked for."""

    SYSTEM = "system"
    LIGHT = "light"
    DARK = "dark"


@dataclass(frozen=True, eq=False)
class Theme:
    """
    The colours of one appearance.

    Compared by identity: a QColor has no hash, and there are two themes.

    Attributes
    ----------
    name : str
        ``"light"`` or ``"dark"``.
    paper : QColor
        Background of the canvas and of input fields.
    surface : QColor
        Background of toolbars and panels.
    ink, muted : QColor
        Text, and secondary text; both readable on paper and on surface.
    grid_fine, grid_coarse : QColor
        Grid lines, opaque: ink at 8 and 16 % over paper.
    curve, ghost, handle : QColor
        The curve, the curve as it was before a change, the lines to the handles.
    accent : QColor
        Selection, focus and the checked state.
    warning : QColor
        Orange; always shown together with a sign or a word.
    """

    name: str
    paper: QColor
    surface: QColor
    ink: QColor
    muted: QColor
    grid_fine: QColor
    grid_coarse: QColor
    curve: QColor
    ghost: QColor
    handle: QColor
    accent: QColor
    warning: QColor


def mix(over: QColor, under: QColor, share: float) -> QColor:
    """Return the opaque colour that ``over`` at opacity ``share`` makes on ``under``."""
    rest = 1.0 - share
    return QColor.fromRgbF(
        share * over.redF() + rest * under.redF(),
        share * over.greenF() + rest * under.greenF(),
        share * over.blueF() + rest * under.blueF(),
    )


def _theme(name: str, *, paper: str, surface: str, ink: str, muted: str, accent: str, warning: str) -> Theme:
    background, foreground = QColor(paper), QColor(ink)
    return Theme(
        name=name,
        paper=background,
        surface=QColor(surface),
        ink=foreground,
        muted=QColor(muted),
        grid_fine=mix(foreground, background, 0.08),
        grid_coarse=mix(foreground, background, 0.16),
        curve=foreground,
        ghost=mix(foreground, background, 0.32),
        handle=mix(foreground, background, 0.62),
        accent=QColor(accent),
        warning=QColor(warning),
    )


LIGHT: Final = _theme(
    "light",
    paper="#fafafa",
    surface="#f0f1f3",
    ink="#1f2328",
    muted="#5b636d",
    accent="#2563d9",
    warning="#b25000",
)
DARK: Final = _theme(
    "dark",
    paper="#15181c",
    surface="#22272d",
    ink="#e6e8ea",
    muted="#9aa3ad",
    accent="#6ea8fe",
    warning="#ffab52",
)


def theme_of(palette: QPalette) -> Theme:
    """Return the theme that goes with a palette: dark when its windows are darker than their text."""
    window = palette.color(QPalette.ColorRole.Window)
    text = palette.color(QPalette.ColorRole.WindowText)
    return DARK if window.lightnessF() < text.lightnessF() else LIGHT


# --- applying a theme ---------------------------------------------------------------------------


class _SystemFollower(QObject):
    """Keeps the application in step with the system while the mode is ``SYSTEM``; a child of it."""

    def __init__(self, app: QApplication) -> None:
        super().__init__(app)
        self.setObjectName("themeFollower")
        self.mode = ThemeMode.SYSTEM
        # Made before the first palette of ours, so this one is still the system's.
        self.before = theme_of(app.palette())
        app.styleHints().colorSchemeChanged.connect(self._follow)

    def _follow(self) -> None:
        app = self.parent()
        if self.mode is ThemeMode.SYSTEM and isinstance(app, QApplication):
            _dress(app, self.system_theme(app))

    def system_theme(self, app: QApplication) -> Theme:
        """Return what the system wants; where it does not say, what its palette was at the start."""
        scheme = app.styleHints().colorScheme()
        return {Qt.ColorScheme.Dark: DARK, Qt.ColorScheme.Light: LIGHT}.get(scheme, self.before)


def apply_theme(app: QApplication, mode: ThemeMode) -> Theme:
    """
    Give the whole application its style, palette and style sheet.

    Widgets that are open hear of it by ``QEvent.Type.PaletteChange``; those that paint with a
    `Theme` or show an `icon` fetch them again there with ``theme_of(self.palette())``.

    Parameters
    ----------
    app : QApplication
        The running application.
    mode : ThemeMode
        With ``SYSTEM``, later changes of the system's colour scheme are followed.

    Returns
    -------
    Theme
        The theme now in force.
    """
    follower = app.findChild(_SystemFollower, "themeFollower") or _SystemFollower(app)
    follower.mode = mode
    _set_native_scheme(app, mode)
    theme = {ThemeMode.LIGHT: LIGHT, ThemeMode.DARK: DARK}.get(mode) or follower.system_theme(app)
    _dress(app, theme)
    return theme


def _set_native_scheme(app: QApplication, mode: ThemeMode) -> None:
    """Tell the platform, so that title bars and native dialogs go along where they can."""
    hints = app.styleHints()
    if mode is ThemeMode.SYSTEM:
        hints.unsetColorScheme()
    else:
        hints.setColorScheme(Qt.ColorScheme.Dark if mode is ThemeMode.DARK else Qt.ColorScheme.Light)


def _dress(app: QApplication, theme: Theme) -> None:
    palette, sheet = palette_of(theme), style_sheet_of(theme)
    if app.palette() == palette and app.styleSheet() == sheet:
        return  # every widget would be polished again, for nothing
    if app.style().name().lower() != "fusion":
        app.setStyle(QStyleFactory.create("Fusion"))
    app.setPalette(palette)
    app.setStyleSheet(sheet)


def palette_of(theme: Theme) -> QPalette:
    """Return the complete palette of a theme, the disabled and inactive groups included."""
    role = QPalette.ColorRole
    colours = _role_colours(theme)
    palette = QPalette()
    for key, colour in colours.items():
        palette.setColor(QPalette.ColorGroup.All, key, colour)
    pale = mix(theme.ink, theme.surface, 0.38)
    for key in (role.WindowText, role.Text, role.ButtonText, role.HighlightedText, role.PlaceholderText):
        palette.setColor(QPalette.ColorGroup.Disabled, key, pale)
    palette.setColor(QPalette.ColorGroup.Disabled, role.Base, theme.surface)
    for key in (role.Highlight, role.Accent):
        palette.setColor(QPalette.ColorGroup.Disabled, key, mix(theme.ink, theme.surface, 0.14))
    return palette


def _role_colours(theme: Theme) -> dict[QPalette.ColorRole, QColor]:
    role = QPalette.ColorRole
    raised = mix(theme.ink, theme.surface, 0.1) if theme.name == "dark" else theme.paper
    return {
        role.Window: theme.surface,
        role.WindowText: theme.ink,
        role.Base: theme.paper,
        role.AlternateBase: mix(theme.ink, theme.paper, 0.03),
        role.Text: theme.ink,
        role.PlaceholderText: theme.muted,
        role.Button: raised,
        role.ButtonText: theme.ink,
        role.BrightText: theme.warning,
        role.ToolTipBase: raised,
        role.ToolTipText: theme.ink,
        role.Highlight: theme.accent,
        role.HighlightedText: theme.paper,
        role.Accent: theme.accent,
        role.Link: theme.accent,
        role.LinkVisited: mix(theme.accent, theme.ink, 0.6),
        # Fusion draws its bevels and frames with these five.
        role.Light: mix(QColor("white"), raised, 0.5 if theme.name == "light" else 0.08),
        role.Midlight: mix(theme.ink, theme.surface, 0.05),
        role.Mid: mix(theme.ink, theme.surface, 0.18),
        role.Dark: mix(theme.ink, theme.surface, 0.28),
        role.Shadow: QColor("#000000") if theme.name == "dark" else mix(theme.ink, theme.surface, 0.5),
    }


_STYLE_SHEET: Final = """
QToolBar { background: $surface; border: none; border-bottom: 1px solid $line; padding: 4px; spacing: 2px }
QToolBar::separator { background: $line; width: 1px; height: 1px; margin: 5px 6px }
QToolBar QToolButton { background: none; border: 1px solid transparent; border-radius: 5px; padding: 4px }
QToolBar QToolButton:hover { background: $hover }
QToolBar QToolButton:pressed { background: $pressed }
QToolBar QToolButton:checked { background: $checked; border-color: $accent; color: $accent }
QToolBar QToolButton:focus { border-color: $accent }
QToolBar QToolButton:disabled { color: $pale }
QToolBar QToolButton[popupMode="1"] { padding-right: 16px }
QToolBar QToolButton::menu-button { border: none; width: 14px }
QMainWindow::separator, QSplitter::handle { background: $line; width: 1px; height: 1px }
QMainWindow::separator:hover, QSplitter::handle:hover { background: $accent }
QDockWidget::title { background: $surface; padding: 7px 10px; text-align: left }
QHeaderView { background: $surface; border: none }
QHeaderView::section, QTableCornerButton::section {
    background: $surface; color: $muted; border: none; border-bottom: 1px solid $line; padding: 5px 8px
}
QTableView { border: none; gridline-color: $fine }
QTableView, QListView, QTreeView { selection-background-color: $chosen; selection-color: $ink }
QTabWidget::pane { border: none; border-top: 1px solid $line }
QTabBar::tab { background: none; border: 2px solid transparent; padding: 5px 10px; color: $muted }
QTabBar::tab:hover { color: $ink }
QTabBar::tab:top:selected { color: $ink; border-bottom-color: $accent }
QTabBar::tab:bottom:selected { color: $ink; border-top-color: $accent }
QTabBar::tab:selected:focus { color: $accent }
QStatusBar { background: $surface; border-top: 1px solid $line; color: $muted }
QStatusBar::item { border: none }
QStatusBar QLabel { color: $muted; padding: 2px 6px }
QMenu { background: $raised; border: 1px solid $edge; padding: 4px }
QToolTip { background: $raised; color: $ink; border: 1px solid $line; padding: 4px 6px }
"""


def style_sheet_of(theme: Theme) -> str:
    """Return the style sheet of a theme: only what the Fusion style draws too heavily."""
    colours = {
        "$surface": theme.surface,
        "$raised": _role_colours(theme)[QPalette.ColorRole.ToolTipBase],
        "$line": mix(theme.ink, theme.surface, 0.14),
        "$edge": mix(theme.ink, theme.surface, 0.24),
        "$fine": mix(theme.ink, theme.paper, 0.07),
        "$hover": mix(theme.ink, theme.surface, 0.07),
        "$pressed": mix(theme.ink, theme.surface, 0.14),
        "$checked": mix(theme.accent, theme.surface, 0.14),
        "$chosen": mix(theme.accent, theme.paper, 0.22),
        "$accent": theme.accent,
        "$muted": theme.muted,
        "$pale": mix(theme.ink, theme.surface, 0.38),
        "$ink": theme.ink,
    }
    sheet = _STYLE_SHEET
    for word, colour in colours.items():
        sheet = sheet.replace(word, colour.name())
    return sheet


# --- colours of the points ----------------------------------------------------------------------

_OKABE_ITO: Final = {
    # On light paper five of the seven are too pale. Lightness alone is moved, by hand and search,
    # so that colours stay apart for red-, green- and blue-blind eyes too (tests/gui/test_theme.py).
    "light": ("#006097", "#c35500", "#00835f", "#b2618e", "#c08404", "#3798cb", "#554f00"),
    "dark": ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#f0e442"),
}
"""Blue, vermillion, bluish green, reddish purple, orange, sky blue, yellow; ink stands for black.

Okabe & Ito, "Color Universal Design" (2008); the dark theme has them as published.
"""

CURVE_COLOURS: Final = {
    "Ink": "",
    "Blue": "#0072b2",
    "Vermillion": "#d55e00",
    "Bluish green": "#009e73",
    "Reddish purple": "#cc79a7",
    "Orange": "#e69f00",
    "Sky blue": "#56b4e9",
    "Yellow": "#f0e442",
}
"""The colours a curve can have, as a document writes them; the ink is that of the theme."""


def curve_colour(code: str, theme: Theme) -> QColor:
    """Return the colour of a curve in this theme: the Okabe–Ito colours are darker on light paper."""
    published = _OKABE_ITO["dark"]
    if code in published:
        return QColor(_OKABE_ITO[theme.name][published.index(code)])
    return QColor(code) if code else QColor(theme.curve)


# OKLab to cone responses (cube roots), and those to linear RGB:
# B. Ottosson, "A perceptual color space for image processing" (2020).
_LAB_TO_LMS: Final = np.array(
    [
        [1.0, 0.3963377774, 0.2158037573],
        [1.0, -0.1055613458, -0.0638541728],
        [1.0, -0.0894841775, -1.2914855480],
    ]
)
_LMS_TO_RGB: Final = np.array(
    [
        [4.0767416621, -3.3077115913, 0.2309699292],
        [-1.2684380046, 2.6097574011, -0.3413193965],
        [-0.0041960863, -0.7034186147, 1.7076147010],
    ]
)


def point_colours(n: int, theme: Theme) -> list[QColor]:
    """
    Return one colour for each of ``n`` points, all legible on the theme's paper.

    Up to eight points have the Okabe–Ito colours, darker on light paper; the eighth is the ink.
    More points run through an even ramp of hues whose lightness alternates, so that neighbours
    can be told apart however many there are.

    Parameters
    ----------
    n : int
        How many, 0 or more.
    theme : Theme
        Where they will be drawn.

    Returns
    -------
    list of QColor
        The colours by point index.
    """
    few = [*_OKABE_ITO[theme.name], theme.ink.name()]
    if n <= len(few):
        return [QColor(name) for name in few[:n]]
    return [QColor(code) for code in _ramp(n, theme).tolist()]


def _ramp(n: int, theme: Theme) -> NDArray[np.int64]:
    """Return ``n`` packed colours 0xffRRGGBB from violet-blue over green to magenta, n >= 2."""
    # At this lightness and chroma every hue is legible, and within sRGB to a rounding.
    middle, chroma = (0.74, 0.115) if theme.name == "dark" else (0.59, 0.105)
    hue = np.radians(np.linspace(265.0, -20.0, n))
    lightness = middle + np.where(np.arange(n) % 2 == 0, -0.03, 0.03)
    lab = np.stack([lightness, chroma * np.cos(hue), chroma * np.sin(hue)], axis=-1)
    rgb = np.clip((lab @ _LAB_TO_LMS.T) ** 3 @ _LMS_TO_RGB.T, 0.0, 1.0)
    srgb = np.where(rgb <= 0.0031308, 12.92 * rgb, 1.055 * rgb ** (1.0 / 2.4) - 0.055)
    red, green, blue = np.rint(255.0 * srgb).astype(np.int64).T
    code: NDArray[np.int64] = (0xFF << 24) | (red << 16) | (green << 8) | blue
    return code


# --- icons --------------------------------------------------------------------------------------

_PIXELS: Final = (16, 20, 24, 32, 40, 48, 64, 80)
"""16, 20, 24, 32 and 40 px at device pixel ratios 1 and 2."""


@lru_cache(maxsize=256)
def icon(name: str, theme: Theme) -> QIcon:
    """
    Return an icon of ``resources/icons`` in the colours of a theme.

    Ink as a rule, muted when disabled, the accent when checked.

    Parameters
    ----------
    name : str
        File name without ``.svg``.
    theme : Theme
        Where it will be shown.

    Returns
    -------
    QIcon
        Drawn at every size in use, never scaled. The same object for the same arguments.

    Raises
    ------
    FileNotFoundError
        When there is no such icon.
    """
    drawing = resource("icons", f"{name}.svg").read_text(encoding="utf-8")
    return QIcon(_IconEngine(drawing.replace("currentColor", theme.ink.name()), theme))


class _IconEngine(QIconEngine):
    """Draws an icon when a size of it is first asked for: at the start most never are."""

    def __init__(self, drawing: str, theme: Theme) -> None:
        super().__init__()
        self._drawing, self._theme = drawing, theme
        self._made: dict[tuple[int, QIcon.Mode, QIcon.State], QPixmap] = {}

    def pixmap(self, size: QSize, mode: QIcon.Mode, state: QIcon.State) -> QPixmap:
        """Return the icon at a size in pixels of the device."""
        key = (min(size.width(), size.height()), mode, state)
        if key not in self._made:
            self._made[key] = QPixmap.fromImage(self._image(*key))
        return self._made[key]

    def _image(self, pixels: int, mode: QIcon.Mode, state: QIcon.State) -> QImage:
        shape = _render(self._drawing, max(pixels, 1))
        if mode is QIcon.Mode.Disabled:
            return _tinted(shape, mix(self._theme.muted, self._theme.surface, 0.5))
        return _tinted(shape, self._theme.accent) if state is QIcon.State.On else shape

    def paint(self, painter: QPainter, rect: QRect, mode: QIcon.Mode, state: QIcon.State) -> None:
        """Draw the icon in the middle of `rect`."""
        device = painter.device()
        ratio = device.devicePixelRatioF() if device is not None else 1.0
        side = min(rect.width(), rect.height())
        pixmap = QPixmap(self.pixmap(QSize(1, 1) * round(side * ratio), mode, state))
        pixmap.setDevicePixelRatio(ratio)
        corner = rect.center() - QPoint(side, side) / 2
        painter.drawPixmap(QRect(corner, QSize(side, side)), pixmap)

    def availableSizes(  # noqa: N802
        self, mode: QIcon.Mode = QIcon.Mode.Normal, state: QIcon.State = QIcon.State.Off
    ) -> list[QSize]:
        """Return the sizes in use; any other is drawn as well."""
        return [QSize(pixels, pixels) for pixels in _PIXELS]

    def actualSize(self, size: QSize, mode: QIcon.Mode, state: QIcon.State) -> QSize:  # noqa: N802
        """Return the square that fits."""
        side = min(size.width(), size.height())
        return QSize(side, side)

    def clone(self) -> QIconEngine:
        """Return another engine for the same drawing."""
        return _IconEngine(self._drawing, self._theme)


def app_icon() -> QIcon:
    """Return the program's own icon, for windows and the task bar; it has its own colours."""
    result = QIcon()
    drawing = resource("icons", "app.svg").read_text(encoding="utf-8")
    for pixels in (*_PIXELS, 128, 256):
        result.addPixmap(QPixmap.fromImage(_render(drawing, pixels)))
    return result


def _render(drawing: str, pixels: int) -> QImage:
    image = QImage(pixels, pixels, QImage.Format.Format_ARGB32_Premultiplied)
    image.fill(Qt.GlobalColor.transparent)
    painter = QPainter(image)
    if pixels % 32 == 16:
        # The 1.5/24 wide lines are 1, 3 or 5 px here: centred on whole numbers they would blur.
        painter.translate(0.5, 0.5)
    QSvgRenderer(QByteArray(drawing.encode())).render(painter, QRectF(0, 0, pixels, pixels))
    painter.end()
    return image


def _tinted(image: QImage, colour: QColor) -> QImage:
    """Return the image with every pixel in one colour, its opacity kept."""
    result = QImage(image)
    painter = QPainter(result)
    painter.setCompositionMode(QPainter.CompositionMode.CompositionMode_SourceIn)
    painter.fillRect(result.rect(), colour)
    painter.end()
    return result
