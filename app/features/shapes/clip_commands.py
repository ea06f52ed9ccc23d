"""Shapes cut by the outline of another one, and made whole again."""

from __future__ import annotations

from ...actions.declaration import action, also
from ...actions.needs import Need
from ...actions.sections import CURVE_CLIPS
from ...actions.state import ActionState
from ...actions.strips import CHOSEN_MENU
from ...view_model.shapes.clipping import with_clip_released, with_clip_set
from ...workbench.context import WindowContext
from .chosen_shapes import SEVERAL_SHAPES, meant
from .clip_editing import ClipEditing
from .shape_work import ShapeWork


def _is_clipped(now: ActionState) -> bool:
    curves = now.session.document.curves
    return any(curves[place].style.clips for place in meant(now.session))


class ClipCommands:
    """Clips of the chosen shapes."""

    def __init__(self, context: WindowContext) -> None:
        self._session, self._work = context.session, ShapeWork(context)
        self._editing = ClipEditing(context)

    @action(
        "editClip",
        "Edit Clip",
        CURVE_CLIPS,
        icon="edit-clip",
        full_name="Edit Clip of Shapes",
        needs=Need("a shape that is clipped", _is_clipped),
        keywords="clipping path outline points nodes crop mask change",
    )
    @also(CHOSEN_MENU(33))
    def _edit(self) -> None:
        """Show the outline that cuts the chosen shapes and change its points; Escape puts it back."""
        self._editing.begin()

    @action(
        "setClip",
        "Set Clip",
        CURVE_CLIPS,
        icon="clip",
        full_name="Set Clip of Shapes",
        needs=SEVERAL_SHAPES,
        keywords="clipping path mask crop cut inside object",
    )
    @also(CHOSEN_MENU(32))
    def _set(self) -> None:
        """Cut the chosen shapes by the one in front; Release Clip brings that back."""
        self._work.compute("Set clip", with_clip_set)

    @action(
        "releaseClip",
        "Release Clip",
        CURVE_CLIPS,
        icon="release-clip",
        full_name="Release Clip of Shapes",
        needs=Need("a shape that is clipped", _is_clipped),
        keywords="clipping path unclip remove mask crop whole",
    )
    @also(CHOSEN_MENU(33))
    def _release(self) -> None:
        """Show the chosen shapes whole, and the outline that cut them as a shape of its own."""
        self._work.compute("Release clip", with_clip_released)
