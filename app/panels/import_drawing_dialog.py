"""What a drawing or a document holds, before its curves come in."""

from __future__ import annotations

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtWidgets import (
    QHBoxLayout,
    QVBoxLayout,
    QWidget,
)

from app.exchange.cubics_in import Imported
from app.labels import Label
from app.panels.fitting import FittedDialog
from app.panels.form_parts import into_box
from app.panels.import_foot import ImportFoot
from app.panels.words import count_of

_MOST_REMARKS = 8


class ImportDrawingDialog(FittedDialog):
    """Says what was found and asks where it goes.

    Signals
    -------
    chosen
        The person wants it; whether as a new document.
    """

    chosen = Signal(bool)

    def __init__(self, title: str, found: Imported, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName("importDrawingDialog")
        self.setWindowTitle(f"Import {title}")
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.summary = Label(_summary(found))
        self.summary.setObjectName("importSummary")
        self.remarks = Label(_remarks(found))
        self.remarks.setObjectName("importRemarks")
        self.remarks.setWordWrap(True)
        self.remarks.setVisible(bool(found.remarks))
        self.into = into_box()
        into = QHBoxLayout()
        into.addWidget(Label("Into"))
        into.addWidget(self.into)
        into.addStretch(1)
        self.foot = ImportFoot(self, "importDrawing", "Take the curves in")
        self.ok = self.foot.ok
        self.foot.box.accepted.connect(self._import)
        layout = QVBoxLayout(self.body)
        layout.setContentsMargins(16, 14, 16, 0)
        layout.setSpacing(10)
        layout.addWidget(self.summary)
        layout.addWidget(self.remarks)
        layout.addLayout(into)
        layout.addStretch(1)
        self.hold(self.foot, wished=QSize(380, 0))

    def _import(self) -> None:
        # First, for a new document closes the dialogs of the one before.
        self.accept()
        self.chosen.emit(self.into.currentIndex() == 1)


def _summary(found: Imported) -> str:
    curves = found.document.curves
    points = sum(len(curve.nodes) for curve in curves)
    exact = f"at most {found.deviation:.2g} from the file" if found.deviation else "exact"
    return f"{count_of(len(curves), 'curve')} with {count_of(points, 'point')}, {exact}."


def _remarks(found: Imported) -> str:
    lines = list(found.remarks[:_MOST_REMARKS])
    more = len(found.remarks) - len(lines)
    return "\n".join([*lines, *([f"… and {more} more."] if more else [])])
