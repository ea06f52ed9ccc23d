"""The outline of a clip, shown for as long as it is edited."""

from __future__ import annotations

from functools import partial

from PySide6.QtCore import QTimer

from ...document.shapes import shape_of
from ...document.words import names_of
from ...view_model.shapes.clip_outlines import (
    ClipOutlines,
    cut_by,
    outline_at,
    with_clip_outlines,
    without_outline,
)
from ...view_model.shapes.regions import name_of_shape, named_operands
from ...workbench.computed_step import ComputedStep
from ...workbench.context import WindowContext
from .chosen_shapes import meant


class ClipEditing:
    """Makes shapes of the outlines of clips, and puts them back when they are edited no longer."""

    def __init__(self, context: WindowContext) -> None:
        self._session, self._step = context.session, ComputedStep(context)
        self._canvas = context.central.canvas
        self._edited = frozenset[frozenset[str]]()
        # What is chosen instead is chosen first, and the drawing does not change under a press.
        self._soon = QTimer(context.window, singleShot=True, interval=0)
        self._soon.timeout.connect(self._look)
        selected_changed = self._session.selected_curves_changed, self._session.active_changed
        for changed in (*selected_changed, self._canvas.gesture_ended):
            changed.connect(self._look_soon)

    def begin(self) -> None:
        """Show what cuts the chosen shapes, and edit it."""
        session = self._session
        document, views, curves = session.committed, session.views, meant(session)
        what = f"Edit clip of {named_operands(document, curves)}"
        self._step.begin(what, partial(with_clip_outlines, document, views, curves), partial(self._put, what))

    def _put(self, what: str, made: ClipOutlines) -> None:
        session = self._session
        with session.telling:
            if not session.change(what, lambda _: made.document, active=min(made.places)):
                return
            session.clips.begin(made.names)
            session.selected.choose(made.places)
            session.selected.edit_chosen()
        session.say(f"{what}: drag its points; Escape puts it back.")

    def _look_soon(self) -> None:
        if self._session.clips.outlines:
            self._soon.start()

    def _look(self) -> None:
        """Put outlines back that are edited no longer."""
        session = self._session
        if self._canvas.is_dragging or session.is_previewing:
            return
        before, document = self._edited, session.committed
        edited = session.selected.edited
        self._edited = frozenset(
            names for names in session.clips.outlines if outline_at(document, names) & edited
        )
        for names in before - self._edited:
            if outline := outline_at(session.committed, names):
                self._put_back(outline)

    def _put_back(self, outline: frozenset[int]) -> None:
        session = self._session
        document, cut = session.committed, cut_by(session.committed, min(outline))
        shapes = {shape_of(document, place) for place in cut}
        named = names_of([name_of_shape(document, each) for each in sorted(shapes, key=min)])
        left = [place for place in range(len(document.curves)) if place not in outline]
        selected, now = session.selected, {old: new for new, old in enumerate(left)}
        is_editing, kept = selected.is_editing, selected.marked - outline
        active = now.get(session.active_index, now[min(cut)])
        chosen = [now[place] for place in (kept or (cut if selected.marked else ()))]
        with session.telling:
            text = f"Put back clip of {named}"
            if not session.change(text, lambda was: without_outline(was, outline), active=active):
                return
            selected.choose(chosen)
            if is_editing and kept:
                selected.edit_chosen()
