"""The basis panel with its header: switches for kinds of functions, formulas, and their range."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QEvent, QSize, Qt
from PySide6.QtGui import QAction, QIcon, QResizeEvent
from PySide6.QtWidgets import QSizePolicy, QToolButton, QWidget

from ...appearance.theme import FollowsTheme, Theme
from ...document.derivatives import DERIVATIVES
from ...document.words import number
from ...plotting.pens import SIGN, sign_pixmap
from ...qt.labels import MUTED, WARNING, Label, set_tip
from ...tasks.task import DelayedCall
from ...view_model.basis import BasisView, basis_formulas
from ...view_model.curve.curve_view import CurveView
from ...view_model.line_styles import KIND_DASHES, LineStyle
from ...widgets.boxes import Part, column_of, row_of
from ...widgets.controls import choice_style, mirror, named, tool_button
from ...widgets.elided_label import ElidedLabel
from ...widgets.frames import Scrolled
from ...workbench.central_area import CentralPane
from .function_lines import note_on_drawing
from .panel import BasisPanel

_NO_PARAMETERS = "No functions: the rule gives no parameters"
_NO_CURVE = "No functions: there is no curve with these parameters"
_NAMES = ("position", *(derivative.name for derivative in DERIVATIVES))

_CARDINAL_TITLES = ("Cardinal functions  Cᵢ(t)", "Cᵢ(t)")
_CARDINAL_TIP = "Effect of point i on the curve, including the derivatives estimated from it"

_ESTIMATES = "With estimates"
_TEXT = Qt.ToolButtonStyle.ToolButtonTextOnly
_TEXT_BESIDE_ICON = Qt.ToolButtonStyle.ToolButtonTextBesideIcon

_WORDS_MS = 33

_LEAST_HEADER = QSize(260, 100)
"""Largest minimum size of the header."""


class _HeaderRow(Scrolled[QWidget]):
    """A row that scrolls by wheel and Tab where it is too long; a bar would cover it."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(QWidget, _LEAST_HEADER, parent)
        self.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setVerticalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Fixed)

    def sizeHint(self) -> QSize:
        # A fixed width: a longer note must not lay the window out anew.
        return QSize(_LEAST_HEADER.width(), super().sizeHint().height())


class BasisPane(FollowsTheme, CentralPane):
    """The basis functions with their header: the lower third of the window.

    The plot inside is the window's ``basis_panel``, whose x axis is t; the t-rail lies along its lower edge.
    The header has the switches for the kinds of functions, their formulas, and a warning where functions
    leave the visible range.
    """

    def __init__(self, panel: BasisPanel, estimates: QAction, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.plot = self._panel = panel
        self._title = named(Label("Basis functions"), "basisTitle")
        label = "Show the effect of each point including its estimates"
        self._estimates = _keep_room(tool_button("withEstimates", label, "", text=_ESTIMATES))
        mirror(self._estimates, estimates)
        self._shows_cardinals, self._linearised = False, ""
        self._kinds = [self._kind_button(kind) for kind in range(len(_NAMES))]
        # The functions of the header, and whether they include estimates.
        self._header_key: tuple[BasisView | None, bool] = (None, False)
        # The formulas of the kinds, the note on the drawing, and the name of the functions.
        self._header_texts: tuple[tuple[str, ...], str, str] = ((), "", self._title.text())
        self._unselected = ""
        self._reach: tuple[float, float] | None = None
        self._drawing = ElidedLabel("basisDrawing", role=MUTED)
        self._extent = ElidedLabel("basisExtent", role=WARNING)
        self._fit, self._is_fitted = self._fit_button(), False
        self._findings = Label(name="basisFindings", label="Findings about the functions", wordWrap=True)
        self._findings.setContentsMargins(10, 0, 8, 2)
        self._findings.hide()
        # Level of brevity of the header, from 0 to 4.
        self._brevity = 0
        self._words_timer = DelayedCall(self, _WORDS_MS, self._write_reach)
        self._lay_out()
        panel.drawing.extent_changed.connect(self._show_extent)
        self._write_reach()
        self.follow_theme()

    def _kind_button(self, kind: int) -> QToolButton:
        name, scaled = _NAMES[kind], "; h is the longer segment beside the point" if kind else ""
        tip = f"Show or hide the {name} functions{scaled}"
        button = tool_button(f"{name}Functions", f"Show {name} functions", tip)
        button.setCheckable(True)
        button.setChecked(True)
        button.setIconSize(SIGN)
        button.clicked.connect(lambda: self._panel.drawing.switch_kind(kind))
        return button

    def _fit_button(self) -> QToolButton:
        tip = "Show the full range of the functions"
        button = tool_button("fitBasis", "Fit the basis functions", tip, text="Fit")
        button.setCheckable(True)
        button.clicked.connect(self._fit_or_calm)
        return _keep_room(button)

    def _lay_out(self) -> None:
        row = _HeaderRow(self)
        named(row.content, "basisHeader")
        # Estimates change what is left of the stretch: their switch stays at the right.
        ends = (self._extent, self._estimates, self._fit)
        parts: tuple[Part, ...] = (self._title, *self._kinds, self._drawing, 1, *ends)
        self._header = row_of(*parts, margins=(10, 4, 8, 2), spacing=6, parent=row.content)
        self._header.insertSpacing(1, 8)
        for button in (*self._kinds, self._estimates):
            # Hidden until there is a curve: otherwise the window reserves room for all of them.
            button.hide()
        column_of(row, self._findings, (self._panel, 1), margins=0, spacing=0, parent=self)

    @property
    def stop(self) -> QWidget:
        return self._panel

    def render_view(self, view: CurveView) -> None:
        """Show the functions of `view`, and the legend of its family."""
        drawing = self._panel.drawing
        drawing.render_view(view)
        basis = drawing.basis
        if view.displacement is not None and self._header_key == (basis, drawing.with_estimates):
            # Points have moved, and the functions have not.
            return
        self._header_key = (basis, drawing.with_estimates)
        has_estimates = view.source.family.derivatives > 0
        shows_cardinals = drawing.with_estimates and has_estimates
        formulas = ("Cᵢ(t)",) if shows_cardinals else basis_formulas(view.source.family)
        note = " · ".join(filter(None, (view.linearised * shows_cardinals, _note(basis, view))))
        # A layout of the header takes longer than drawing the curve: only when a text changes.
        header_texts = (formulas, note, view.source.family.curve_class.functions)
        if header_texts != self._header_texts:
            self._header_texts, self._shows_cardinals = header_texts, shows_cardinals
            self._linearised = view.linearised
            self._estimates.setVisible(has_estimates)
            for kind, button in enumerate(self._kinds):
                button.setVisible(kind < len(formulas) and len(formulas) > 1)
            self._write_note()
            self._write_header()

    def show_unselected(self, name: str) -> None:
        """Say that no curve is selected, and whose functions are drawn; empty for a selected curve."""
        note = f"No curve is selected; functions of “{name}”" if name else ""
        if note != self._unselected:
            self._unselected = note
            self._write_note()
            self._write_header()

    def _write_note(self) -> None:
        self._drawing.setText(" · ".join(filter(None, (self._unselected, self._header_texts[1]))))

    def show_findings(self, findings: Sequence[str], remark: str) -> None:
        """Show findings and a remark about the functions below the header."""
        text = " ".join(filter(None, ("⚠" * bool(findings), *findings, remark)))
        if text != self._findings.text():
            self._findings.setText(text)
            self._findings.setForegroundRole(WARNING if findings else MUTED)
            self._findings.setVisible(bool(text))

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._write_header()

    def changeEvent(self, event: QEvent) -> None:
        super().changeEvent(event)
        if event.type() in (QEvent.Type.StyleChange, QEvent.Type.FontChange) and self.isVisible():
            self._write_header()

    def _write_header(self) -> None:
        """Write as much as there is room for.

        First the names beside the formulas are omitted, then words of the note, factors of functions, and
        at last the title and the samples of lines.
        """
        linearised = f"; shown are those {self._linearised}" if self._linearised else ""
        set_tip(self._title, f"{_CARDINAL_TIP}{linearised}" if self._shows_cardinals else "")
        formulas, _drawing, functions = self._header_texts
        for brief in range(5):
            self._brevity, is_briefest = brief, brief > 3
            self._title.setHidden(is_briefest)
            self._estimates.setText("Cᵢ(t)" if is_briefest else _ESTIMATES)
            self._title.setText(_CARDINAL_TITLES[min(brief, 1)] if self._shows_cardinals else functions)
            for kind, formula in enumerate(formulas):
                # The leading space keeps the text off its line sample.
                # The function without factors: B₁ of 2·B₁ ∕ h.
                text = formula.rpartition("·")[2].partition(" ")[0] if brief > 2 else formula
                self._kinds[kind].setText(" " + (text if brief else f"{_NAMES[kind]}  {formula}"))
                self._kinds[kind].setToolButtonStyle(_TEXT if is_briefest else _TEXT_BESIDE_ICON)
            self._write_extent()
            # The notes are elided before the title is omitted.
            needed = self._header.sizeHint() if brief < 3 else self._header.minimumSize()
            if needed.width() <= self.width():
                break

    def _write_extent(self) -> None:
        self._extent.setText(_reach_text(self._reach, brief=self._brevity > 1))
        set_tip(self._extent, _reach_text(self._reach))

    def set_theme(self, theme: Theme) -> None:
        """Use the colours of `theme`."""
        self._panel.set_theme(theme)
        for button, dashes in zip(self._kinds, KIND_DASHES, strict=True):
            button.setIcon(QIcon(sign_pixmap(LineStyle("ink", width=1.5, dashes=dashes), theme, 2.0)))
        self._estimates.setStyleSheet(choice_style(theme))

    def fit(self, *, whole: bool) -> None:
        drawing = self._panel.drawing
        self._show_fitted(False)
        drawing.calm_values()
        drawing.fit_domain()
        self._fit.setVisible(self._reach is not None)
        if whole and self._reach is not None:
            self._show_fitted(True)
            drawing.fit_values()

    def _show_fitted(self, fitted: bool) -> None:
        self._is_fitted = fitted
        self._fit.setChecked(fitted)

    def _fit_or_calm(self, fitted: bool) -> None:
        self._is_fitted = fitted
        drawing = self._panel.drawing
        drawing.fit_values() if fitted else drawing.calm_values()

    def _show_extent(self, extent: tuple[float, float] | None) -> None:
        appears_or_goes = (extent is None) != (self._reach is None)
        self._reach = extent
        if appears_or_goes:
            self._write_reach()
        elif extent is not None and not self._words_timer.isActive():
            # At most every 33 ms during a drag: nobody reads faster.
            self._words_timer.start()

    def _write_reach(self) -> None:
        self._fit.setVisible(self._reach is not None or self._is_fitted)
        room = self._extent.sizeHint()
        self._write_extent()
        if self._extent.sizeHint() != room:
            # The brevity of the header depends on the room that this text leaves.
            self._write_header()


def _keep_room(button: QToolButton) -> QToolButton:
    """Return a button whose room stays when it is hidden; otherwise the plot below would jump."""
    policy = button.sizePolicy()
    policy.setRetainSizeWhenHidden(True)
    button.setSizePolicy(policy)
    return button


def _reach_text(reach: tuple[float, float] | None, *, brief: bool = False) -> str:
    """Return the note about functions beyond the visible range; empty for none."""
    if reach is None:
        return ""
    span = f"{number(reach[0], 3)} to {number(reach[1], 3)}"
    return f"⚠ {span}" if brief else f"⚠ The functions range from {span}"


def _note(basis: BasisView | None, view: CurveView) -> str:
    """Return the note on the drawn functions, or why there are none."""
    if basis is not None:
        return note_on_drawing(basis)
    if len(view.ticks):
        return _NO_CURVE
    return _NO_PARAMETERS if len(view.points) > 1 else ""
