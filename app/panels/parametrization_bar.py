"""The rule for the parameters in the toolbar: a box and the exponent α."""

from __future__ import annotations

from PySide6.QtCore import Qt, Signal
from PySide6.QtWidgets import QComboBox, QHBoxLayout, QSizePolicy, QWidget

from app.document import edits
from app.document.model import Curve, Document, ParametrizationKind
from app.labels import Label
from app.panels.live_slider import LiveSlider
from app.panels.slider_edit import SliderEdit
from app.session import Session
from app.view_model.curve_view import CurveView

KIND_NAMES = {
    ParametrizationKind.UNIFORM: "Uniform",
    ParametrizationKind.CHORD_LENGTH: "Chord length",
    ParametrizationKind.CENTRIPETAL: "Centripetal",
    ParametrizationKind.POWER: "Power α",
    ParametrizationKind.CHEBYSHEV: "Chebyshev",
    ParametrizationKind.MANUAL: "Manual",
}

_STEPS = 100
_SLIDER_WIDTH, _COMPACT_SLIDER_WIDTH = 96, 64

_ALPHAS = {
    ParametrizationKind.UNIFORM: 0.0,
    ParametrizationKind.CENTRIPETAL: 0.5,
    ParametrizationKind.CHORD_LENGTH: 1.0,
}
"""Three of the rules are members of the power family; the slider shows where they stand."""


class ParametrizationBar(QWidget):
    """Chooses the rule that gives the t_i.

    Signals
    -------
    drag_changed
        The slider is being dragged, or no longer.
    """

    drag_changed = Signal(bool)

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._session = session
        self.box = QComboBox()
        self.box.setObjectName("parametrizationBox")
        self.box.setAccessibleName("Parametrization")
        self.box.setToolTip("The rule that gives the parameters t")
        self.box.addItems(list(KIND_NAMES.values()))
        self.box.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToContents)
        self._label = Label("Parameters")
        self._slider = self._make_slider()
        self._alpha = Label()
        self._alpha.setObjectName("alphaValue")
        self._alpha.setMinimumWidth(self._alpha.fontMetrics().horizontalAdvance("α 0.00"))
        self._lay_out()
        self.box.activated.connect(self._choose_kind)

    def _make_slider(self) -> LiveSlider:
        slider = LiveSlider(Qt.Orientation.Horizontal)
        slider.setObjectName("alphaSlider")
        slider.setAccessibleName("Exponent α of the power rule")
        slider.setToolTip("Δt = |Δp|^α: 0 uniform, ½ centripetal, 1 chord length")
        slider.setRange(0, _STEPS)
        slider.setFixedWidth(_SLIDER_WIDTH)
        slider.sliderPressed.connect(lambda: self.drag_changed.emit(True))
        edit = SliderEdit(
            slider, self._session, self._with_alpha, lambda position: f"Set α to {position / _STEPS:.2f}"
        )
        edit.finished.connect(self._show_end)
        return slider

    def _lay_out(self) -> None:
        layout = QHBoxLayout(self)
        layout.setContentsMargins(4, 0, 4, 0)
        layout.setSpacing(6)
        layout.addWidget(self._label)
        layout.addWidget(self.box)
        layout.addWidget(self._slider)
        layout.addWidget(self._alpha)
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Preferred)

    def set_compact(self, compact: bool) -> None:
        """Take less room in a narrow window."""
        self._label.setVisible(not compact)
        self._slider.setFixedWidth(_COMPACT_SLIDER_WIDTH if compact else _SLIDER_WIDTH)

    def render_view(self, view: CurveView) -> None:
        """Show the rule of `view`."""
        rule = view.source.parametrization
        self.box.setCurrentIndex(list(KIND_NAMES).index(rule.kind))
        alpha = _ALPHAS.get(rule.kind, rule.alpha)
        if not self._slider.isSliderDown():
            self._slider.setValue(round(alpha * _STEPS))
        has_alpha = rule.kind in _ALPHAS or rule.kind is ParametrizationKind.POWER
        self._slider.setEnabled(has_alpha)
        self._alpha.setEnabled(has_alpha)
        self._alpha.setText(f"α {alpha:.2f}")

    def _choose_kind(self, index: int) -> None:
        kind = list(KIND_NAMES)[index]
        session = self._session
        session.interrupt()
        parameters = session.active_view.parameters.tolist()
        if kind is ParametrizationKind.MANUAL and not session.active_view.is_current:
            session.refuse("There are no parameters to start from; mend the points first.")
            self.render_view(session.active_view)
            return
        document = edits.set_parametrization(session.document, session.active_index, kind, parameters)
        session.commit(document, f"Use {KIND_NAMES[kind].lower()} parameters")

    def _with_alpha(self, document: Document, position: int) -> Document:
        index, alpha = self._session.active_index, position / _STEPS
        if _alpha_of(document.curves[index]) == alpha:
            return document
        return edits.set_alpha(document, index, alpha)

    def _show_end(self) -> None:
        self.render_view(self._session.active_view)
        self.drag_changed.emit(False)


def _alpha_of(curve: Curve) -> float | None:
    rule = curve.parametrization
    return rule.alpha if rule.kind is ParametrizationKind.POWER else _ALPHAS.get(rule.kind)
