"""Points and derivatives on the clipboard: between curves, windows, and with text from anywhere."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import msgspec
from msgspec.structs import replace
from PySide6.QtCore import QMimeData, QObject, Qt, Signal
from PySide6.QtGui import QGuiApplication

from app.commands.curve_clipboard import CurveClipboard, put_on_clipboard
from app.commands.parts import Handlers, Parts
from app.document import curve_edits, edits
from app.document.edits import EditError
from app.document.model import Curve, Document, Node
from app.document.words import count_of
from app.exchange.table.clipboard import Block, TableTextError, read_titled_block, write_block
from app.panels.number_text import decimal_mark, exact_text
from app.panels.point_columns import known_titles
from app.storage.format import FormatError, decode, encode
from app.view_model.curve_view import CurveView
from app.view_model.pasting import (
    appended,
    appended_with_parameters,
    as_new_curve,
    copied,
    copied_as_new_curve,
    nodes_of_rows,
    refuse_unordered,
)

POINTS = "application/x-curvebench-points"
"""MIME type of points: a document of one curve that has these points only."""

DERIVATIVES = "application/x-curvebench-derivatives"
"""MIME type of a node's derivatives: a node of which the position does not count."""

_ON_CANVAS = ("cutPoints", "copyPoints", "pastePoints", "pasteAsCurve", "copyDerivatives", "pasteDerivatives")


class _Pasted(msgspec.Struct, frozen=True):
    """What is on the clipboard: points, whether they came as text, and the row they begin in.

    `note` goes on the sentence that tells what was pasted.
    """

    nodes: tuple[Node, ...]
    like: Curve | None = None
    first_row: int = 1
    note: str = ""


class _ClipboardWatch(QObject):
    """Knows whether there are derivatives on the clipboard.

    Another program may have to be asked for that: it is, when somebody wants to know, and once.
    """

    changed = Signal()

    def __init__(self, window: QObject) -> None:
        # A child of the window: the clipboard lives longer.
        super().__init__(window)
        self._known: bool | None = None
        QGuiApplication.clipboard().dataChanged.connect(self._forget)

    @property
    def holds_derivatives(self) -> bool:
        """Whether there are some now."""
        if self._known is None:
            data = QGuiApplication.clipboard().mimeData()
            self._known = data is not None and data.hasFormat(DERIVATIVES)
        return self._known

    def _forget(self) -> None:
        self._known = None
        self.changed.emit()


class ClipboardCommands:
    """Cut, copy and paste with the canvas in focus; the point table has its own for cells."""

    def __init__(self, parts: Parts) -> None:
        self._parts = parts
        self._session = parts.session
        self._curves = CurveClipboard(parts)
        self._watch = _ClipboardWatch(parts.window)
        self._watch.changed.connect(self._render_paste)
        for name in _ON_CANVAS:
            # The point table and the fields of the panels use the same keys for what they show.
            parts.actions[name].setShortcutContext(Qt.ShortcutContext.WidgetWithChildrenShortcut)
            parts.canvas.addAction(parts.actions[name])

    def handlers(self) -> Handlers:
        """Return what each action does."""
        return {
            "cutPoints": self._cut,
            "copyPoints": self._copy,
            "pastePoints": lambda: self._paste(self._append),
            "pasteAsCurve": lambda: self._paste(self._add_curve),
            "copyDerivatives": self._copy_derivatives,
            "pasteDerivatives": self._paste_derivatives,
        }

    def render(self, view: CurveView) -> None:
        """Enable what needs selected points, and derivatives on the clipboard."""
        actions, chosen = self._parts.actions, self._session.selection
        for name in ("cutPoints", "copyPoints"):
            actions[name].setEnabled(bool(chosen) or self._curves.has_several)
        has_derivatives = view.source.family.derivatives > 0
        actions["copyDerivatives"].setEnabled(has_derivatives and len(chosen) == 1 and view.is_current)
        self._render_paste()

    def _render_paste(self) -> None:
        has_derivatives = self._session.active_curve.family.derivatives > 0
        usable = has_derivatives and bool(self._session.selection) and self._watch.holds_derivatives
        self._parts.actions["pasteDerivatives"].setEnabled(usable)

    # Points

    def _copy(self) -> None:
        view, chosen = self._session.active_view, self._session.selection
        if self._curves.has_several:
            self._curves.copy()
        if not chosen:
            return
        clip, mark = copied(view, chosen), decimal_mark()
        rows = [
            [exact_text(number, mark) for number in _row(node, timed=view.source.is_manual)]
            for node in clip.nodes
        ]
        data = QMimeData()
        data.setData(POINTS, encode(Document((clip,))))
        data.setText(write_block(rows))
        put_on_clipboard(data)
        self._session.say(f"Copied {count_of(len(clip.nodes), 'point')}.")

    def _cut(self) -> None:
        session, chosen = self._session, self._session.selection
        if self._curves.has_several:
            self._curves.cut()
        if not chosen:
            return
        self._copy()
        if session.change(
            f"Cut {count_of(len(chosen), 'point')}",
            lambda document: edits.delete_nodes(document, session.active_index, chosen),
        ):
            session.select([])
            session.say(f"Cut {count_of(len(chosen), 'point')}.")

    def _paste(self, put: Callable[[_Pasted], None]) -> None:
        try:
            if not self._curves.paste():
                put(_on_clipboard())
        except (EditError, TableTextError) as reason:
            self._session.refuse(str(reason))

    def _append(self, pasted: _Pasted) -> None:
        session, view = self._session, self._session.active_view
        count = len(view.source.nodes)
        if pasted.like is None and pasted.nodes[0].t is not None:
            curve = appended_with_parameters(view, pasted.nodes, pasted.first_row)
        else:
            curve = appended(view, pasted.nodes)
        if session.change(
            f"Paste {count_of(len(pasted.nodes), 'point')}",
            lambda document: curve_edits.replace_curve(document, session.active_index, curve),
        ):
            session.select(range(count, count + len(pasted.nodes)))
            self._show_points()
            session.say(f"Pasted {count_of(len(pasted.nodes), 'point')}{pasted.note}.")

    def _add_curve(self, pasted: _Pasted) -> None:
        session, place = self._session, self._session.active_index + 1
        name = curve_edits.free_name(session.document)
        if pasted.like is not None:
            curve = copied_as_new_curve(pasted.like, name)
        else:
            refuse_unordered(pasted.nodes, pasted.first_row) if pasted.nodes[0].t is not None else None
            curve = as_new_curve(session.active_curve, pasted.nodes, name)
        document = curve_edits.add_curve(session.document, place, curve)
        edits.set_nodes(document, place, curve.nodes)
        if session.change(f"Paste as {name}", lambda _: document, active=place):
            self._show_points()
            session.say(f"Pasted {count_of(len(curve.nodes), 'point')} as “{name}”{pasted.note}.")

    def _show_points(self) -> None:
        """Fit the view if points that were pasted lie outside it."""
        if not self._parts.canvas.shows_all_points:
            self._parts.actions["fitView"].trigger()

    # Derivatives

    def _copy_derivatives(self) -> None:
        view, index = self._session.active_view, self._session.selected
        if index is None or not view.is_current:
            return
        node = view.source.nodes[index]
        jet = Node(
            0.0,
            0.0,
            velocity=view.velocity_of(index, ahead=False),
            acceleration=view.acceleration_of(index, ahead=False),
            corner=node.corner,
            velocity_after=view.velocity_of(index) if node.corner else None,
            acceleration_after=view.acceleration_of(index) if node.corner else None,
        )
        mark = decimal_mark()
        numbers = (*(jet.velocity or ()), *(jet.acceleration or ()))
        data = QMimeData()
        data.setData(DERIVATIVES, msgspec.json.encode(jet))
        data.setText(write_block([[exact_text(number, mark) for number in numbers]]))
        put_on_clipboard(data)
        self._session.say(f"Copied the derivatives of point {index}.")

    def _paste_derivatives(self) -> None:
        session, chosen = self._session, self._session.selection
        jet = _derivatives_on_clipboard()
        if jet is None:
            session.refuse("There are no derivatives on the clipboard; Copy Derivatives puts them there.")
            return
        nodes = (
            _with_derivatives(node, jet) if index in chosen else node
            for index, node in enumerate(session.active_curve.nodes)
        )
        what = f"point {next(iter(chosen))}" if len(chosen) == 1 else count_of(len(chosen), "point")
        if session.change(
            f"Paste derivatives to {what}",
            lambda document: edits.set_nodes(document, session.active_index, nodes),
        ):
            session.say(f"Pasted the derivatives into {what}.")


def _row(node: Node, *, timed: bool) -> Sequence[float]:
    return (node.t, *node.position) if timed and node.t is not None else node.position


def _on_clipboard() -> _Pasted:
    """Return the points on the clipboard, as they were copied here or read from text."""
    data = QGuiApplication.clipboard().mimeData() or QMimeData()  # None where nothing was ever copied
    if data.hasFormat(POINTS):
        try:
            (curve, *_) = decode(bytes(data.data(POINTS).data())).curves
        except FormatError as reason:
            raise EditError(f"The points on the clipboard cannot be read: {reason}.") from None
        if curve.nodes:
            return _Pasted(curve.nodes, curve)
    text = data.text() if data.hasText() else ""
    block = read_titled_block(text, decimal_mark(), known_titles())
    # A row of titles was skipped.
    first_row = 1 + len(text.rstrip().splitlines()) - len(block.rows)
    note = "; the row of titles was skipped" if block.titles else ""
    return _Pasted(nodes_of_rows(_in_order(block)), first_row=first_row, note=note)


def _in_order(block: Block) -> list[list[float]]:
    """Return the rows of points with the columns that titles name in the order t x y.

    Raises
    ------
    EditError
        If the titles name something else.
    """
    names = [title for title in block.titles if title != "#"]
    if not names:
        return block.rows
    if sorted(names) not in (["x", "y"], ["t", "x", "y"]):
        raise EditError(
            f"Points are x y, or t x y; the titles are {' '.join(names)}. The point table takes them all."
        )
    places = [block.titles.index(name) for name in sorted(names)]
    return [[row[place] for place in places] for row in block.rows]


def _derivatives_on_clipboard() -> Node | None:
    data = QGuiApplication.clipboard().mimeData() or QMimeData()
    if not data.hasFormat(DERIVATIVES):
        return None
    try:
        return msgspec.json.decode(bytes(data.data(DERIVATIVES).data()), type=Node)
    except (msgspec.DecodeError, UnicodeDecodeError):
        return None


def _with_derivatives(node: Node, jet: Node) -> Node:
    """Return `node` with the derivatives of `jet`; of a higher order it keeps its own."""
    changed = replace(node, corner=jet.corner, velocity=jet.velocity, velocity_after=jet.velocity_after)
    if jet.acceleration is None:
        return changed
    return replace(changed, acceleration=jet.acceleration, acceleration_after=jet.acceleration_after)
