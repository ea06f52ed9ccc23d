"""The form of the active curve in the window: its dock, and what it shows."""

from __future__ import annotations

from functools import partial

from PySide6.QtWidgets import QWidget

from ...document.edits import set_family_setting
from ...document.model import Document
from ...view_model.curve_view import CurveView
from ...workbench.context import WindowContext
from ...workbench.docks import Panel
from ...workbench.form_edits import FormEdits
from ...workbench.slider_gesture import SliderGesture
from .panel import CurveSettings
from .setting_fields import step_of


class CurveSettingsCommands:
    """Keeps the form in step with the active curve.

    Attributes
    ----------
    panel
        The form, as soon as the docks are filled.
    """

    panel: CurveSettings

    def __init__(self, context: WindowContext) -> None:
        self._session, self._hold_ghost = context.session, context.central.canvas.drawing.hold_ghost
        self._gestures: list[SliderGesture] = []
        self._shown: CurveView | None = None

    @Panel("curveDock", "Curve")
    def build_panel(self, parent: QWidget) -> QWidget:
        """Return the form."""
        self.panel = CurveSettings(self._session.active_view, parent)
        self._edits = FormEdits(self._session, self.panel)
        self.panel.settings.rebuilt.connect(self._follow_sliders)
        self._follow_sliders()
        return self.panel

    def _follow_sliders(self) -> None:
        self._gestures = []
        for setting, field in self.panel.settings.numbers.items():
            with_value, step = partial(self._with_value, setting.name), partial(step_of, setting)
            self._gestures.append(SliderGesture(self._session, field.slider, with_value, step))
            field.slider.sliderPressed.connect(lambda: self._hold_ghost(True))
            field.slider.drag_ended.connect(lambda: self._hold_ghost(False))

    def _with_value(self, name: str, document: Document, value: int) -> Document:
        return set_family_setting(document, self._session.active_index, name, value)

    def render(self, view: CurveView) -> None:
        """Show `view`; where only the selection has changed, the form stays as it is."""
        if view is not self._shown:
            self._shown = view
            self.panel.render_view(view)


COMMAND_SETS = (CurveSettingsCommands,)
