"""The joint certificate: built when its dock is first opened; a click on a joint zooms to it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QWidget

from ...actions.declaration import action
from ...actions.menus import ANALYSIS_JOINTS
from ...view_model import analysis
from ...view_model.curve.curve_view import CurveView
from ...workbench.context import WindowContext
from ...workbench.docks import Panel
from .. import joints

if TYPE_CHECKING:
    from ...view_model.analysis.joints import JointRow
    from .panel import JointsPanel

_CLOSE_UP = 0.6
"""Half the width of a close-up, in distances to the nearer neighbour."""

_LEAST = 1e-6


class JointCommands:
    """Keeps the certificate in step with the curve, at the pace of the panels."""

    def __init__(self, context: WindowContext) -> None:
        self._context = context
        self._panel: JointsPanel | None = None
        self._view: CurveView | None = None

    @Panel("jointsDock", "Joints")
    def build_panel(self, parent: QWidget) -> QWidget:
        """Return the panel; called when its dock is first shown."""
        actions = self._context.actions
        self._panel = joints.panel.JointsPanel(actions["copyJoints"], actions["matchCurvature"], parent)
        self._panel.visited.connect(self._visit)
        self._panel.became_visible.connect(lambda: self.render_panel(self._context.session.active_view))
        return self._panel

    def render_panel(self, view: CurveView) -> None:
        """Show the joints of `view` if the panel is visible."""
        panel = self._panel
        if panel is None or not panel.isVisible():
            return
        if view is not self._view:
            self._view = view
            panel.render_certificate(analysis.joints.certificate_of(view), view.t_text)
        panel.set_selection(self._context.session.selection)

    @action("showJoints", "Joint Certificate", ANALYSIS_JOINTS, icon="joints")
    def _bring_up(self) -> None:
        """Measure how smooth the curve is at each joint."""
        self._context.docks["jointsDock"].bring_up()

    @action("copyJoints", "Copy Joint Certificate", ANALYSIS_JOINTS, icon="copy")
    def _copy(self) -> None:
        """Copy the measured joints as a table of text."""
        certificate = analysis.joints.certificate_of(self._context.session.active_view)
        QGuiApplication.clipboard().setText(analysis.joints.as_text(certificate))
        self._context.session.say(f"Copied: {certificate.summary}")

    def _visit(self, row: JointRow) -> None:
        """Zoom to a joint, and select its point."""
        x, y = row.position
        half = max(_CLOSE_UP * row.reach, _LEAST)
        self._context.central.canvas.camera.show_box((x - half, x + half), (y - half, y + half))
        self._context.session.selected.set_points([row.joint])
        self._context.session.say(f"Zoomed to joint {row.joint}. Press F to show the whole curve.")


COMMAND_SETS = (JointCommands,)
