"""Edits by the parametrization bar and the menu of the rules."""

from __future__ import annotations

from app.document import edits
from app.document.edits import EditError
from app.document.model import Curve, Document, ParametrizationKind
from app.panels.parametrization_bar import STEPS, ParametrizationBar
from app.session import Change, Session
from app.workbench.slider_gesture import SliderGesture


def use_parametrization(session: Session, kind: ParametrizationKind) -> Change:
    """Give the active curve its parameters by another rule."""

    def edit(document: Document) -> Document:
        view = session.active_view
        if kind is ParametrizationKind.MANUAL and not view.is_current:
            raise EditError("There are no parameters to start from; mend the points first.")
        return edits.set_parametrization(document, session.active_index, kind, view.parameters.tolist())

    return session.change(f"Use {kind.label.lower()} parameters", edit)


class ParametrizationController:
    """Turns what is chosen in the parametrization bar into changes of the active curve."""

    def __init__(self, session: Session, bar: ParametrizationBar) -> None:
        self._session = session
        self._alpha = SliderGesture(session, bar.slider, self._with_alpha, _alpha_step)
        bar.kind_chosen.connect(self._use)

    def _use(self, kind: ParametrizationKind) -> None:
        use_parametrization(self._session, kind)

    def _with_alpha(self, document: Document, position: int) -> Document:
        index, alpha = self._session.active_index, position / STEPS
        if _alpha_of(document.curves[index]) == alpha:
            return document
        return edits.set_alpha(document, index, alpha)


def _alpha_step(position: int) -> str:
    return f"Set α to {position / STEPS:.2f}"


def _alpha_of(curve: Curve) -> float | None:
    rule = curve.parametrization
    return rule.alpha if rule.kind is ParametrizationKind.POWER else rule.kind.alpha
