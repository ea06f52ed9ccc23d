"""Import dialog for drawings and documents: their content, before its curves come in."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtWidgets import QWidget

from ...document.shapes import counted_shapes, shapes
from ...document.words import count_of, number
from ...exchange.cubics_in import Imported
from ...qt.labels import Label
from ...widgets.boxes import column_of, row_of
from .form_parts import A_NEW_DOCUMENT, Verb, into_box
from .group_tree import GroupTree
from .import_foot import ImportFoot
from .import_picture import ImportPicture
from .work_dialog import WorkDialog

_MOST_REMARKS = 12


class ImportDrawingDialog(WorkDialog):
    """Shows what was found, says what of it comes in otherwise, and asks where it goes.

    Parameters
    ----------
    verb, name
        What is done with the file, and what that is called.
    rest
        Returns what is said of all that stays behind where the curves go: to a new document, or this one.

    Signals
    -------
    chosen
        The person wants it: what is `Imported`, and whether it is to become a new document.
    """

    chosen = Signal(object, bool)

    def __init__(
        self,
        verb: Verb,
        name: str,
        found: Imported,
        rest: Callable[[bool], str],
        parent: QWidget | None = None,
    ) -> None:
        super().__init__("importDrawingDialog", f"{verb.value} {name}", "importProblem", parent)
        self._found, self._rest = found, rest
        count = sum(1 for _ in shapes(found.document.curves))
        self.groups = GroupTree(found.document) if count > 1 else None
        self.picture = ImportPicture(self.jobs)
        self.summary = Label(_summary(found, found), name="importSummary", wordWrap=True)
        self.remarks = Label(_remarks(found), name="importRemarks", wordWrap=True)
        self.remarks.setVisible(bool(found.remarks))
        self.rest = Label(name="importRest", wordWrap=True)
        self.into = into_box(verb)
        self.into.currentTextChanged.connect(self._show_rest)
        self._show_rest()
        self.foot = ImportFoot(self, "importDrawing", "Take the curves in", verb, self.into)
        self.ok = self.foot.ok
        self.foot.box.accepted.connect(self._import)
        self._lay_out()
        self.picture.show_document(found.document)

    def _lay_out(self) -> None:
        side = column_of(self.summary, margins=0, spacing=8)
        if self.groups is None:
            side.addStretch(1)
        else:
            side.addWidget(self.groups, 1)
            self.groups.chosen.connect(self._show_taken)
        above = row_of((self.picture, Qt.AlignmentFlag.AlignTop), (side, 1), margins=0, spacing=18)
        layout = column_of((above, 1), margins=(16, 14, 16, 0), spacing=10, parent=self.body)
        layout.addWidget(self.remarks)
        layout.addLayout(row_of("Into", self.into, 1))
        layout.addWidget(self.rest)
        self.hold(self.foot, wished=QSize(660, 0))

    @property
    def _is_anew(self) -> bool:
        return self.into.currentText() == A_NEW_DOCUMENT

    def _show_rest(self) -> None:
        text = self._rest(self._is_anew)
        self.rest.setText(text)
        self.rest.setVisible(bool(text))

    def _taken(self) -> list[bool]:
        return self.groups.taken if self.groups is not None else [True] * len(self._found.document.curves)

    def _show_taken(self) -> None:
        """Show how much of the drawing is taken; without a curve there is nothing to import."""
        taken = self._taken()
        self.ok.setEnabled(any(taken))
        some = self._found if all(taken) or not any(taken) else self._found.only(taken)
        none = f"None of {counted_shapes(self._found.document.curves)}; choose at least one."
        self.summary.setText(_summary(self._found, some) if any(taken) else none)
        if any(taken):
            self.picture.show_document(some.document)
        else:
            self.picture.clear()

    def _import(self) -> None:
        # First, for a new document closes the dialogs of the one before.
        self.accept()
        self.chosen.emit(self._found.only(self._taken()), self._is_anew)


def _summary(found: Imported, taken: Imported) -> str:
    """Return what is taken of a drawing."""
    points = sum(len(curve.points) for curve in taken.document.curves)
    exact = f"at most {number(taken.deviation, 2)} from the file" if taken.deviation else "exact"
    some = counted_shapes(taken.document.curves)
    if taken is not found:
        some = f"{some.split()[0]} of {counted_shapes(found.document.curves)}"
    return f"{some} with {count_of(points, 'point')}, {exact}."


def _remarks(found: Imported) -> str:
    lines = list(found.remarks[:_MOST_REMARKS])
    more = len(found.remarks) - len(lines)
    return "\n".join([*lines, *([f"… and {more} more."] if more else [])])
