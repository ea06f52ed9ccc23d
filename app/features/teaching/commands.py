"""Warnings that teach: a badge in the status line, and the explanation that it opens."""

from __future__ import annotations

from PySide6.QtCore import QObject, QPoint, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QFrame, QPushButton, QToolButton

from ...appearance.theme import FollowsTheme, Theme
from ...qt.labels import Label, set_tip, tip_of
from ...qt.overrides import SafeOverrides
from ...view_model.analysis.warnings import CurveWarning, Topic, warnings_of
from ...view_model.basis import growth_of_points
from ...view_model.curve.curve_view import CurveView
from ...widgets.boxes import column_of, row_of
from ...widgets.controls import push_button
from ...workbench.context import WindowContext

_WIDTH = 340


class TeachingBadge(FollowsTheme, QToolButton):
    """Badge with a warning: a sign and a word; a click opens the explanation. Hidden without a warning.

    Signals
    -------
    laboratory_wanted, explanation_wanted
        The person follows a link.
    dismissed
        The person dismisses the warning.
    """

    laboratory_wanted = Signal()
    explanation_wanted = Signal()
    dismissed = Signal()

    def __init__(self) -> None:
        super().__init__()
        self.setObjectName("teachingBadge")
        self.setAutoRaise(True)
        # As high as the labels beside it: the canvas must not move when the badge appears.
        self.setFixedHeight(self.fontMetrics().height() + 4)
        self._popup = _Popup(self)
        self.clicked.connect(self._open)
        self.hide()
        self.follow_theme()

    @property
    def sentence(self) -> str:
        """Sentence of the warning; empty while the badge is hidden."""
        return "" if self.isHidden() else self._popup.sentence.text()

    def render_warning(self, warning: CurveWarning | None) -> None:
        """Show a warning; hide the badge for None."""
        self.setVisible(warning is not None)
        if warning is None:
            self._popup.hide()
            return
        self.setText(warning.badge)
        set_tip(self, tip_of(f"{warning.sentence} Click to see the remedies"))
        self.setAccessibleName(f"{warning.badge}. {warning.sentence}")
        self._popup.sentence.setText(warning.sentence)

    def _open(self) -> None:
        popup = self._popup
        popup.adjustSize()
        corner = self.mapToGlobal(QPoint(self.width(), 0))
        popup.move(corner - QPoint(popup.width(), popup.height() + 6))
        popup.show()
        popup.laboratory.setFocus(Qt.FocusReason.PopupFocusReason)

    def set_theme(self, theme: Theme) -> None:
        self.setStyleSheet(f"QToolButton {{ color: {theme.warning.name()}; padding: 0px 8px }}")


class _Popup(SafeOverrides, QFrame):
    """Popup with the sentence, two links and a button that dismisses the warning."""

    def __init__(self, badge: TeachingBadge) -> None:
        super().__init__(badge, Qt.WindowType.Popup)
        # The status line, its ancestor, would give it a muted colour.
        self.setStyleSheet("QLabel { color: palette(window-text); padding: 0px }")
        self.setObjectName("teachingPopup")
        self.setFrameShape(QFrame.Shape.StyledPanel)
        self.setFixedWidth(_WIDTH)
        self.sentence = Label(name="teachingSentence", wordWrap=True)
        self.laboratory = _link(
            "openLaboratory", "Open the laboratory", "Compute with few digits to see the loss of accuracy"
        )
        self.explain = _link("openExplanation", "Show a cure", "Explain the widest wiggle, and try cures")
        self.dismiss = _link("putBadgeAway", "Dismiss", "Hide this warning until a new cause occurs")
        for button, signal in (
            (self.laboratory, badge.laboratory_wanted),
            (self.explain, badge.explanation_wanted),
            (self.dismiss, badge.dismissed),
        ):
            button.clicked.connect(self.hide)
            button.clicked.connect(signal)
        links = row_of(self.laboratory, self.explain, self.dismiss)
        column_of(self.sentence, links, margins=(12, 10, 12, 10), parent=self)

    def keyPressEvent(self, event: QKeyEvent) -> None:
        if event.key() == Qt.Key.Key_Escape:
            self.hide()
            return
        super().keyPressEvent(event)


def _link(name: str, text: str, tip: str) -> QPushButton:
    return push_button(name, text, tip, text)


class TeachingCommands(QObject):
    """Commands that show the badge. A dismissed warning returns when its reason was gone and comes back."""

    def __init__(self, context: WindowContext) -> None:
        super().__init__(context.window)
        self._context, self._session = context, context.session
        self._dismissed: set[tuple[int, Topic]] = set()
        self._warning: CurveWarning | None = None
        self._cached: tuple[CurveView, list[CurveWarning]] | None = None
        self._badge = TeachingBadge()
        context.status_line.addPermanentWidget(self._badge)
        self._badge.hide()
        self._lebesgue = context.status_line.findChild(Label, "lebesgueConstant")
        self._badge.laboratory_wanted.connect(self._open_laboratory)
        self._badge.explanation_wanted.connect(context.actions["explainWidest"].trigger)
        self._badge.dismissed.connect(self._dismiss)
        self._session.opened.connect(self._begin_anew)

    def _open_laboratory(self) -> None:
        """Bring the laboratory to the front; its action would close it if it is open."""
        dock = self._context.docks["laboratoryDock"]
        if self._context.store.state.analysis.laboratory.on and dock.isVisible():
            dock.raise_()
        else:
            self._context.actions["toggleLaboratory"].trigger()

    def render_panel(self, view: CurveView) -> None:
        """Show the first warning that is not dismissed; nothing changes during a drag."""
        if self._session.is_previewing:
            return
        warnings = self._warnings(view)
        curve, topics = self._session.active_index, {warning.topic for warning in warnings}
        self._dismissed -= {(curve, topic) for topic in Topic if topic not in topics}
        active = (warning for warning in warnings if (curve, warning.topic) not in self._dismissed)
        self._warning = next(active, None)
        self._badge.render_warning(self._warning)
        # The badge has the same number.
        if self._lebesgue is not None:
            self._lebesgue.setVisible(self._warning is None or self._warning.topic is not Topic.LEBESGUE)

    def _warnings(self, view: CurveView) -> list[CurveWarning]:
        if self._cached is None or self._cached[0] is not view:
            basis = self._context.central.basis
            warnings = warnings_of(view, growth_of_points(view, basis)) if basis is not None else []
            self._cached = view, warnings
        return self._cached[1]

    def _dismiss(self) -> None:
        if self._warning is not None:
            self._dismissed.add((self._session.active_index, self._warning.topic))
            self.render_panel(self._session.active_view)

    def _begin_anew(self) -> None:
        self._dismissed.clear()
        self.render_panel(self._session.active_view)


COMMAND_SETS = (TeachingCommands,)
