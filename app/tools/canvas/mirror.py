"""The tool that mirrors the selection about a line, by two clicks or a drag; in place or as a copy."""

from __future__ import annotations

from ...document import words
from ...document.limits import EditError
from ...document.model import Axis, Document, Vector
from ...document.point_group import NO_POINTS, PointGroup
from ...document.selection import SelectionState
from ...document.several_curves import duplicate_curves, name_or_count, transform_group, whole_curves
from ...document.transforms import reflection_about
from ...document.words import NamedEnum
from ...view_model.settings import ChoiceSetting
from ..box import SelectionBox
from ..editing_session import EditingSession
from ..marks import Marks
from ..pointer import SNAP_KEY, STEP_KEYS, Hint, Pointer, minus
from ..snapping import Snapper, stepped_from
from ..tool import CanvasQueries, Drag, GestureRow, Tool, ToolEvent, ToolRecord

_AXES = {"x": Axis.X, "y": Axis.Y}

_OUTSIDE = " Part of it is outside the view; “Fit Selection” shows it."


class MirrorResult(NamedEnum):
    """Whether mirror images are copies, or take the place of the original."""

    COPY = "copy", "Mirrored Copy"
    IN_PLACE = "in_place", "Mirrored in Place"


MIRROR_RESULT = ChoiceSetting(
    "mirrorBox",
    "Mirror",
    MirrorResult.COPY,
    tip="Mirror a copy of the curves, or the selection itself",
    stored_as="mirror/result",
)


def _subject(
    session: EditingSession, box: SelectionBox, result: MirrorResult
) -> tuple[Document, PointGroup, str, SelectionState | None]:
    """Return a document, the points in it to mirror, their label, and the selection from then on.

    They are the points that flips act on, or copies of the whole curves that these are of.

    Raises
    ------
    EditError
        If nothing is selected, or in place a part of it is locked.
    """
    document, selected, is_copied = session.document, session.selected, result is MirrorResult.COPY
    if box.is_nothing or (box.refusal_of_keys and not is_copied):
        raise EditError(box.refusal_of_keys)
    if not is_copied:
        return document, box.for_keys, box.words, None
    curves = selected.target_curves
    copied, copies = duplicate_curves(document, curves)
    new_curves, is_editing = frozenset(copies), selected.is_editing and len(copies) == 1
    whole = frozenset[int]() if is_editing else new_curves
    selects = SelectionState(copies[-1], NO_POINTS, new_curves, whole, is_editing)
    label = f"{'a copy' if len(copies) == 1 else 'copies'} of {name_or_count(document, curves)}"
    return copied, whole_curves(copied, copies), label, selects


def mirror_about_axis(
    session: EditingSession, box: SelectionBox, canvas: CanvasQueries, result: MirrorResult, axis: Axis
) -> None:
    """Mirror the selection about the x axis or the y axis of the plane.

    Raises
    ------
    EditError
        If nothing is selected, or in place a part of it is locked.
    """
    document, group, label, selects = _subject(session, box, result)
    by = reflection_about((0.0, 0.0), (1.0, 0.0) if axis is Axis.X else (0.0, 1.0))
    active, mirrored = selects.active if selects else None, transform_group(document, group, by)
    if not session.change(f"Mirror {label} about the {axis} axis", lambda _: mirrored, active=active):
        return
    if selects is not None:
        session.selected.restore(selects)
    outside = "" if canvas.shows_curves(group.curves) else _OUTSIDE
    session.say(f"{group.remark or f'Mirrored {label} about the {axis} axis'}.{outside}")


class MirrorLine(Drag, kw_only=True):
    """A line from the press to the pointer, about which the selection is mirrored.

    A click sets the first position; then it follows the pointer until the next click.

    Attributes
    ----------
    label
        What is mirrored.
    start
        The first position.
    """

    follows_click = True
    label: str
    start: Vector
    snapper: Snapper
    refusal: str = "Click another position: the mirror line goes through two."

    keys = f"click or release: done · {STEP_KEYS} · {SNAP_KEY}"

    def _end(self, pointer: Pointer) -> Vector:
        return stepped_from(self.start, pointer, self.snapper)

    def move(self, event: ToolEvent) -> None:
        """Preview the mirror image, as soon as there is a line."""
        if self._end(event.pointer) != self.start:
            super().move(event)

    def document_at(self, pointer: Pointer) -> Document:
        """Return the document with the mirror image about the line to the pointer."""
        by = reflection_about(self.start, self._end(pointer))
        return transform_group(self.document, self.group, by)

    def undo_text(self, pointer: Pointer) -> str:
        """Return "Mirror a copy of Leaf"."""
        return f"Mirror {self.label}"

    def amount(self, pointer: Pointer) -> str:
        """Return the name of the step, and the direction of the line."""
        line = words.direction(minus(self._end(pointer), self.start))
        return f"{self.undo_text(pointer)} about a line at {line}"

    def marks(self, event: ToolEvent) -> Marks:
        """Return the mirror line, and the snap of its end."""
        along = minus(self._end(event.pointer), self.start)
        return Marks(axis=(self.start, along), spot=self.start, snap=event.snapping.caught)


class MirrorTool(Tool):
    """Tool that mirrors the selection about a line."""

    hits = frozenset()
    edits_points = False

    def press(self, event: ToolEvent) -> MirrorLine:
        """Begin the mirror line here."""
        document, group, label, selects = _subject(event.session, event.box, event.value(MIRROR_RESULT))
        snapper = event.snapping.for_new_point(-1)
        return MirrorLine(
            document=document,
            selects=selects,
            group=group,
            label=label,
            start=snapper.at(event.pointer),
            snapper=snapper,
        )

    def wants_key(self, event: ToolEvent, key: str) -> bool:
        """Return whether a key names an axis to mirror about."""
        return key in _AXES

    def key(self, event: ToolEvent, key: str) -> bool:
        """Mirror about the x axis or the y axis."""
        if key not in _AXES:
            return super().key(event, key)
        mirror_about_axis(event.session, event.box, event.canvas, event.value(MIRROR_RESULT), _AXES[key])
        return True

    def hover(self, event: ToolEvent) -> Hint:
        """Return the hint, and preview the snap."""
        event.preview_snap(-1)
        what = "a copy of the curves" if event.value(MIRROR_RESULT) is MirrorResult.COPY else "the selection"
        return Hint(
            f"Click two positions of a line, or drag along it, to mirror {what} · X, Y: about that axis · "
            f"Edit › Tools: copy or in place · {SNAP_KEY}"
        )


MIRROR = ToolRecord(
    name="mirror",
    make=MirrorTool,
    hint="Click two positions of the mirror line; V or Escape returns to Select.",
    doing="mirroring",
    gestures=(
        GestureRow("Click twice, or drag", "mirror about the line; Ctrl or Shift: 15° steps"),
        GestureRow("X, Y", "mirror about the x axis, the y axis"),
        GestureRow("Escape", "cancel the line"),
    ),
    rank=28,
    action="mirrorTool",
    title="Mirror",
    full_name="Mirror Tool",
    key="Shift+M",
    icon="mirror",
    tip="Mirror the selection about a line through two positions, as a copy or in place",
    keywords="reflect flip symmetry half",
    settings=(MIRROR_RESULT,),
)
