"""The last transform done once more: to what is chosen, or to a copy of it."""

from __future__ import annotations

from ...actions.declaration import action
from ...actions.needs import CHOSEN
from ...actions.sections import EDIT_TRANSFORM_AGAIN
from ...document.model import Vector
from ...document.readings import readings_of
from ...document.several_curves import add_copies, named, whole_curves
from ...view_model.boxes.last_transform import Done, transform_between
from ...workbench.context import WindowContext
from ...workbench.highlight import highlighted_curves

_NONE_YET = "Nothing was moved, rotated, scaled, skewed or flipped yet."


class RepeatCommands:
    """Repeats the last transform, wherever it was done: by the mouse, by keys or by numbers."""

    def __init__(self, context: WindowContext) -> None:
        self._context, self._session = context, context.session
        self._target = context.central.canvas.tools.target

    @action(
        "repeatTransform",
        "Repeat",
        EDIT_TRANSFORM_AGAIN,
        "Ctrl+Alt+R",
        "transform-again",
        full_name="Repeat the Last Transform",
        needs=CHOSEN,
        keywords="again transform same move rotate scale skew flip",
    )
    def _repeat(self) -> None:
        """Move, rotate, scale, skew or flip what is selected or chosen as it was done last."""
        session, target = self._session, self._target
        last = self._last()
        if refusal := target.refusal_of_keys or ("" if last is not None else _NONE_YET):
            session.refuse(refusal)
        elif last is not None:
            group, transform = target.for_keys, last.transform
            about = target.pivot or last.about_for(group.curves, session.document.curves) or target.centre
            text = transform.words(readings_of(session.document)).format(target.words)
            if session.change(f"{text} again", lambda document: transform.done(document, group, about)):
                session.say(f"{text} again{f'; {group.stays}' if group.stays else ''}.")

    @action(
        "duplicateAndRepeat",
        "Duplicate and Repeat",
        EDIT_TRANSFORM_AGAIN,
        "Ctrl+Alt+D",
        "duplicate-again",
        full_name="Duplicate and Repeat the Last Transform",
        needs=CHOSEN,
        keywords="again transform step array power copy pattern row petals",
    )
    def _duplicate(self) -> None:
        """Add a copy of what is chosen, transformed as it was done last; once more goes on from there."""
        session, last = self._session, self._last()
        originals = highlighted_curves(self._context)
        if last is None or not any(session.document.curves[place].points for place in originals):
            session.refuse(_NONE_YET if last is None else self._target.refusal_of_keys)
            return
        about = self._about(last, originals)
        added, transform = add_copies(session.document, originals), last.transform
        copies = whole_curves(added.document, added.places)
        copy = f"a copy of {named(session.document, originals)}"
        text = transform.words(readings_of(session.document)).format(copy)
        if session.change(
            text, lambda _: transform.done(added.document, copies, about), active=added.places[0]
        ):
            session.selected.choose(added.places)
            # What the next copy is turned about, too.
            self._target.pivot = about if last.about is not None else None
            session.say(f"{text}; it is chosen.")

    def _about(self, last: Done, curves: frozenset[int]) -> Vector:
        """Return what a transform of whole curves is about: their pivot, the same place, or their middle."""
        document, target = self._session.document, self._target
        is_target = target.for_keys.curves == curves
        return (
            (target.pivot if is_target else None)
            or last.about_for(curves, document.curves)
            or target.bounds_of(whole_curves(document, curves)).centre
        )

    def _last(self) -> Done | None:
        found = (transform_between(*each) for each in self._session.history.done())
        return next(filter(None, found), None)
