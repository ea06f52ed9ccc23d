"""Themes: colours of the window and the drawing, light and dark, and widgets that follow them."""

from __future__ import annotations

from typing import Final

import msgspec
from PySide6.QtCore import QEvent, QObject, Qt
from PySide6.QtGui import QColor, QPalette
from PySide6.QtWidgets import QApplication, QStyleFactory

from ..document.words import NamedEnum
from ..qt.overrides import SafeOverrides, guard
from ..storage.resources import resource
from ..view_model.palette import ACCENT, INK, PAPER


class ThemeMode(NamedEnum):
    """The appearance that the user has chosen."""

    SYSTEM = "system", "System default"
    LIGHT = "light", "Light"
    DARK = "dark", "Dark"


class Theme(msgspec.Struct, frozen=True, eq=False):
    """
    The colours of one appearance.

    Compared by identity: a QColor has no hash, and there are three themes.

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
        Selection, focus and the checked state; words on paper.
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


def _theme(name: str, *, surface: str, muted: str, warning: str) -> Theme:
    background, foreground = QColor(PAPER[name]), QColor(INK[name])
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
        accent=QColor(ACCENT[name]),
        warning=QColor(warning),
    )


LIGHT: Final = _theme("light", surface="#f0f1f3", muted="#5b636d", warning="#b25000")
DARK: Final = _theme("dark", surface="#22272d", muted="#9aa3ad", warning="#ffab52")


def theme_of(palette: QPalette) -> Theme:
    """Return the theme of a palette: dark when its windows are darker than their text."""
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
            _apply(app, self.system_theme(app))

    def system_theme(self, app: QApplication) -> Theme:
        """Return the theme of the system; without a colour scheme, the theme of its palette at the start."""
        scheme = app.styleHints().colorScheme()
        return {Qt.ColorScheme.Dark: DARK, Qt.ColorScheme.Light: LIGHT}.get(scheme, self.before)


def apply_theme(app: QApplication, mode: ThemeMode) -> Theme:
    """
    Give the whole application its style, palette and style sheet.

    Open widgets get ``QEvent.Type.PaletteChange``; widgets that paint with a `Theme` or show an
    `icon` then fetch these again with ``theme_of(self.palette())``.

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
    _apply(app, theme)
    return theme


def _set_native_scheme(app: QApplication, mode: ThemeMode) -> None:
    """Set the colour scheme of the platform for title bars and native dialogs."""
    hints = app.styleHints()
    if mode is ThemeMode.SYSTEM:
        hints.unsetColorScheme()
    else:
        hints.setColorScheme(Qt.ColorScheme.Dark if mode is ThemeMode.DARK else Qt.ColorScheme.Light)


def _apply(app: QApplication, theme: Theme) -> None:
    palette, sheet = palette_of(theme), style_sheet_of(theme)
    if app.palette() == palette and app.styleSheet() == sheet:
        return  # otherwise every widget would be polished again without need
    # Under a style sheet the style has no name; under ours it is Fusion, and every widget is polished once.
    is_ours = app.styleSheet() in map(style_sheet_of, (LIGHT, DARK))
    if not is_ours and app.style().name().lower() != "fusion":
        app.setStyle(QStyleFactory.create("Fusion"))
    app.setPalette(palette)
    boxes = _palette_of_boxes(theme)
    for name in ("QCheckBox", "QLineEdit", "QAbstractSpinBox"):
        # PySide accepts the name as text, against its type hints.
        app.setPalette(boxes, name)  # type: ignore[arg-type]
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


def _palette_of_boxes(theme: Theme) -> QPalette:
    """Return the palette of check boxes and fields, whose border Fusion draws in a darker shade of Window.

    A shade of the usual colour would be hardly visible, and invisible in the dark theme; these widgets use
    the colour for nothing else.
    """
    palette, window = palette_of(theme), QPalette.ColorRole.Window
    palette.setColor(window, rim(theme).lighter(_FUSION_DARKER))
    pale = mix(theme.ink, theme.surface, 0.24).lighter(_FUSION_DARKER)
    palette.setColor(QPalette.ColorGroup.Disabled, window, pale)
    return palette


def rim(theme: Theme) -> QColor:
    """Return the colour of the border around a field, with a contrast of three to its surroundings."""
    return mix(theme.ink, theme.surface, 0.58 if theme.name == "light" else 0.46)


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


_FUSION_DARKER: Final = 140
"""Fusion's borders are Window, so many hundredths darker."""

_STYLE_SHEET: Final = """
QToolBar { background: $surface; border: none; border-bottom: 1px solid $line; padding: 4px; spacing: 2px }
QToolBar QToolBar { background: none; border: none; padding: 0 }
QToolBar::separator { background: $line; width: 1px; height: 1px; margin: 5px 6px }
QToolBar QToolButton { background: none; border: 1px solid transparent; border-radius: 5px; padding: 4px }
QToolBar QToolButton:hover { background: $hover }
QToolBar QToolButton:pressed { background: $pressed }
QToolBar QToolButton:checked { background: $checked; border-color: $accent; color: $accent }
QToolBar QToolButton:focus { border-color: $accent }
QToolBar QToolButton:disabled { color: $pale }
QToolBar QToolButton[popupMode="1"] { padding-right: 10px }
ToolbarWidget QToolButton[popupMode="2"] { padding-right: 16px }
QToolBar QToolButton::menu-button { border: none; width: 10px }
ToolbarWidget QToolButton::menu-indicator {
    image: url("$icons/arrow-$name.svg"); width: 10px; subcontrol-origin: padding;
    subcontrol-position: center right; right: 4px
}
QToolBar QToolBarExtension {
    qproperty-icon: url("$icons/more-$name.svg"); qproperty-iconSize: 12px 12px; padding: 0; border: none
}
QMainWindow::separator, QSplitter::handle { background: $line; width: 1px; height: 1px }
QMainWindow::separator:hover, QSplitter::handle:hover { background: $accent }
DockTitle { background: $surface }
DockTitle QToolButton { background: none; border: 1px solid transparent; border-radius: 4px; padding: 3px }
DockTitle QToolButton:hover { background: $hover }
DockTitle QToolButton:checked { background: $checked; border-color: $accent }
DockTitle QToolButton:pressed { background: $pressed }
DockTitle QToolButton:focus { border-color: $accent }
QPushButton, QComboBox, QToolButton[autoRaise="false"] {
    background: $raised; border: 1px solid $edge; border-radius: 3px; color: $ink; padding: 3px 8px
}
QPushButton { padding: 3px 5px }
QDialogButtonBox { dialogbuttonbox-buttons-have-icons: 0 }
QDialogButtonBox QPushButton { min-width: 56px; padding: 4px 12px }
QPushButton:hover, QComboBox:hover, QToolButton[autoRaise="false"]:hover { background: $lifted }
QPushButton:pressed, QToolButton[autoRaise="false"]:pressed { background: $pressed }
QPushButton:checked { background: $checked; border-color: $accent }
QToolButton[autoRaise="false"] { padding: 1px 2px }
QToolButton[autoRaise="false"][checkable="true"] { background: none }
QToolButton[autoRaise="false"]:checked { background: $raised }
PivotChooser QToolButton[checkable="true"] {
    background: $paper; border: 1px solid $rim; border-radius: 2px; padding: 0
}
PivotChooser QToolButton[checkable="true"]:hover { background: $hover }
PivotChooser QToolButton[checkable="true"]:focus { border-color: $accent }
PivotChooser QToolButton[checkable="true"]:checked { background: $accent; border-color: $accent }
PivotChooser QToolButton[checkable="true"]:disabled { background: none; border-color: $line }
QPushButton:disabled, QComboBox:disabled, QToolButton[autoRaise="false"]:disabled {
    background: none; border-color: $line; color: $pale
}
QPushButton:default, QPushButton:focus, QComboBox:focus, QToolButton[autoRaise="false"]:focus {
    border-color: $accent
}
QCommandLinkButton, QCommandLinkButton:default { background: none; border-color: transparent }
QCommandLinkButton:hover { background: $hover }
QCommandLinkButton:focus { border-color: $accent }
QTextBrowser { border: 1px solid transparent }
QTextBrowser:focus { border-color: $accent }
QComboBox { border-color: $rim; padding: 2px 4px 2px 6px }
QComboBox:editable { background: $paper; padding-left: 1px }
QComboBox::drop-down { border: none; width: 18px }
QComboBox::down-arrow { image: url("$icons/arrow-$name.svg"); width: 14px; height: 14px }
QHeaderView { background: $surface; border: none }
QHeaderView::section, QTableCornerButton::section {
    background: $surface; color: $muted; border: none; border-bottom: 1px solid $line; padding: 5px 8px
}
QTableView { border: none; gridline-color: $fine }
QTableView, QListView, QTreeView { selection-background-color: $chosen; selection-color: $ink }
QTabWidget::pane { border: none; border-top: 1px solid $line }
QTabBar { qproperty-elideMode: ElideNone; qproperty-usesScrollButtons: true }
QTabBar::tab { background: none; border: 2px solid transparent; padding: 5px 10px; color: $muted }
QTabBar::tab:hover { color: $ink }
QTabBar::tab:top:selected { color: $ink; border-bottom-color: $accent }
QTabBar::tab:bottom:selected { color: $ink; border-top-color: $accent }
QTabBar::tab:selected:focus { color: $accent }
QStatusBar { background: $surface; border-top: 1px solid $line; color: $muted }
QStatusBar::item { border: none }
QStatusBar QLabel { color: $muted; padding: 2px 6px }
QProgressBar { background: $line; border: none; border-radius: 4px }
QProgressBar::chunk { background: $accent; border-radius: 4px }
QMenu { background: $raised; border: 1px solid $edge; padding: 4px }
QMenu::item { padding: 5px 22px 5px 8px; border-radius: 4px; color: $ink }
QMenu::item:selected { background: $selected; color: $ink }
QMenu::item:disabled { color: $pale }
QMenu::icon { padding-left: 6px }
QMenu::icon:checked { background: $checked; border: 1px solid $accent; border-radius: 4px }
QMenu::indicator { width: 14px; height: 14px; margin-left: 6px }
QMenu::separator { height: 1px; background: $line; margin: 4px 8px }
QToolTip { background: $raised; color: $ink; border: 1px solid $line; padding: 4px 6px }
"""


def style_sheet_of(theme: Theme) -> str:
    """Return the style sheet of a theme: it lightens details that the Fusion style draws too heavily."""
    colours = {
        "$surface": theme.surface,
        "$raised": _role_colours(theme)[QPalette.ColorRole.ToolTipBase],
        "$line": mix(theme.ink, theme.surface, 0.14),
        "$edge": mix(theme.ink, theme.surface, 0.24),
        "$fine": mix(theme.ink, theme.paper, 0.07),
        "$hover": mix(theme.ink, theme.surface, 0.07),
        "$pressed": mix(theme.ink, theme.surface, 0.14),
        "$checked": mix(theme.accent, theme.surface, 0.14),
        "$selected": mix(theme.accent, theme.surface, 0.24),
        "$chosen": mix(theme.accent, theme.paper, 0.22),
        "$accent": theme.accent,
        "$muted": theme.muted,
        "$pale": mix(theme.ink, theme.surface, 0.38),
        "$ink": theme.ink,
        "$paper": theme.paper,
        "$rim": rim(theme),
        "$lifted": mix(theme.ink, _role_colours(theme)[QPalette.ColorRole.Button], 0.06),
    }
    folder = resource("icons", "styled", f"arrow-{theme.name}.svg").parent
    sheet = _STYLE_SHEET.replace("$icons", folder.as_posix()).replace("$name", theme.name)
    for word, colour in colours.items():
        sheet = sheet.replace(word, colour.name())
    return sheet


class FollowsTheme(SafeOverrides):
    """Mixin for widgets, named before Qt's class: `set_theme` is called whenever the theme changes.

    The widget calls `follow_theme` once, at the end of its constructor.

    Attributes
    ----------
    theme
        The current theme of the widget.
    """

    theme: Theme = LIGHT
    _is_following = False

    def follow_theme(self) -> None:
        """Use the current theme, and from now on every new one."""
        # Not the widget's own palette: it is outdated until the widget has been polished.
        theme = theme_of(QApplication.palette())
        if self._is_following and theme is self.theme:
            return  # Qt reports a palette repeatedly, and a new style sheet as a new palette
        self._is_following, self.theme = True, theme
        self.set_theme(theme)

    def set_theme(self, theme: Theme) -> None:
        """Use the colours of `theme`."""
        raise NotImplementedError

    @guard
    def changeEvent(self, event: QEvent) -> None:
        """Follow a change of the palette; called by Qt."""
        super().changeEvent(event)  # type: ignore[misc]  # that of the widget's class
        if self._is_following and event.type() == QEvent.Type.PaletteChange:
            self.follow_theme()
