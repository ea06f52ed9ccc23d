"""Actions for families from files: write a template, use a file, report on it."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QObject, QTimer
from PySide6.QtWidgets import QBoxLayout, QFileDialog, QSizePolicy

from ...actions.declaration import action
from ...actions.menus import FILE_FAMILY, FILE_FAMILY_MORE
from ...actions.needs import Need
from ...document.words import enumerated
from ...families import FAMILIES, Family
from ...storage.files import StorageError, write
from ...view_model.curve.curve_view import CurveView
from ...workbench.context import WindowContext
from ...workbench.message_bar import NoticeBar
from .. import own_families
from .files import family_files

_PYTHON = "Python (*.py);;All files (*)"
_NEW_NAME = "my_family.py"


class OwnFamilyCommands(QObject):
    """Actions that write templates and use files, with the bar that reports on them."""

    def __init__(self, context: WindowContext) -> None:
        super().__init__(context.window)
        self._context, self._session = context, context.session
        self._files = family_files()
        self._files.brought.connect(self._use_families)
        self._files.changed.connect(self._show)
        self._files.answered.connect(self._draw_anew)
        self._answered: set[Family] = set()
        self._shows_late = False
        self._bar: FamilyBar | None = None
        # What was asked for here and has not come yet: one is tried after the other.
        self._asked = set[Path]()
        self._news = ""
        self._dismissed = ""
        if self._sentence()[0]:
            self._show()

    # What can be done

    @action("familyTemplate", "Family Template…", FILE_FAMILY)
    def _write_template(self) -> None:
        """Save a Python template of a curve family, to edit in any text editor."""
        start = self._context.preferences.last_folder / _NEW_NAME
        name, _ = QFileDialog.getSaveFileName(self._context.window, "Family Template", str(start), _PYTHON)
        if not name:
            return
        path = Path(name) if Path(name).suffix else Path(f"{name}.py")
        try:
            if path != Path(name) and path.exists():
                # The dialog has asked only about the name without the suffix.
                raise StorageError(f"“{path.name}” already exists. Select it in the list to replace it.")
            write(path, own_families.template.template(path).encode())
        except StorageError as problem:
            self._files.offered = None
            self._tell(f"{path.name} was not written. {problem}")
            return
        self._context.preferences.last_folder = path.parent
        self._files.offered = path
        self._tell(
            f"“{path.name}” is in {path.parent}. It holds Lagrange's functions; change them in any editor. "
            "Using it runs this Python code, now and whenever it is saved."
        )

    @action("useFamilyFile", "Use Family File…", FILE_FAMILY)
    def _ask_and_use(self) -> None:
        """Run a Python file, now and whenever it is saved, and use its families."""
        folder = str(self._context.preferences.last_folder)
        title = "Run a Python File and Use Its Families"
        name, _ = QFileDialog.getOpenFileName(self._context.window, title, folder, _PYTHON)
        if name:
            self._context.preferences.last_folder = Path(name).parent
            self._use(Path(name))

    @action(
        "useOwnFamily",
        "Use New Family",
        FILE_FAMILY_MORE,
        icon="play",
        full_name="Use the New Family",
        needs=Need("a family file that was just saved or used", lambda state: state.window.offers_family),
    )
    def _use_offered(self) -> None:
        """Use the template that was just saved, or the family that was just loaded."""
        offered = self._files.offered
        if isinstance(offered, Path):
            self._use(offered)
        elif offered is not None:
            self._context.actions[offered.action_name].trigger()

    @action(
        "stopFamilyFile",
        "Stop",
        FILE_FAMILY_MORE,
        icon="stop",
        full_name="Stop the Family File",
        needs=Need("", lambda state: state.window.runs_family_file, "No family file is running."),
    )
    def _stop(self) -> None:
        """Stop the running family file; the document does not change."""
        self._files.stop()

    def _use(self, path: Path) -> None:
        self._asked.add(path.absolute())
        self._news = self._dismissed = ""
        self._files.use(path)

    # What became of it

    def _use_families(self, path: Path, families: frozenset[Family]) -> None:
        """Offer the families of a file, and redraw their curves."""
        self._context.actions.declare_again()
        self._session.renew(families)
        offered = [family for family in FAMILIES.files[path] if family in FAMILIES]
        if path in self._asked:
            self._asked.remove(path)
            self._files.offered = offered[0]
            names = enumerated([f"“{family.label}”" for family in offered])
            self._tell(f"“{path.name}” adds {names}. It runs again whenever it is saved.")
        else:
            self._news = ""
            self._session.say(f"{path.name} ran again: its curves are redrawn.")

    def _draw_anew(self, family: Family) -> None:
        """Redraw curves of a family; a gesture in flight goes on."""
        self._answered.add(family)
        self._draw_answered()

    def _catch_up(self) -> None:
        """Redraw curves and show the bar after a gesture, which they would have disturbed."""
        self._draw_answered()
        if self._shows_late:
            self._show()

    def _draw_answered(self) -> None:
        if self._answered and not self._session.is_previewing:
            answered, self._answered = frozenset(self._answered), set()
            self._session.renew(answered)

    def render_panel(self, view: CurveView) -> None:
        """Hide the notice about a new family once the active curve is of it."""
        if (self._answered or self._shows_late) and not self._session.is_previewing:
            QTimer.singleShot(0, self, self._catch_up)
        if self._news and view.source.family == self._files.offered:
            self._news = ""
            self._show()

    def _tell(self, text: str) -> None:
        self._news, self._dismissed = text, ""
        self._show()

    def _show(self) -> None:
        """Show the most urgent notice: a file that runs, a mistake, a new family."""
        self._shows_late = self._session.is_previewing
        if self._shows_late:
            # The canvas has another size with it: what is dragged would move under the hand.
            return
        files, store = self._files, self._context.store
        store.change(offers_family=files.offered is not None, runs_family_file=bool(files.running))
        text, offered, warns = self._sentence()
        if not text or text == self._dismissed:
            if self._bar is not None:
                self._bar.hide()
            return
        if self._bar is None:
            self._bar = FamilyBar(self._context.central.under_canvas)
            self._bar.closed.connect(self._dismiss)
        self._bar.show_notice(text, [self._context.actions[name] for name in offered], warns=warns)

    def _sentence(self) -> tuple[str, tuple[str, ...], bool]:
        if self._files.running:
            return self._files.running, ("stopFamilyFile",), False
        for path, problem in reversed(self._files.problems.items()):
            last = " The last version that worked stays in use." if path in FAMILIES.files else ""
            return f"{problem}{last} The file runs again when it is saved.", (), True
        return self._news, ("useOwnFamily",) if self._files.offered is not None else (), False

    def _dismiss(self, text: str) -> None:
        self._dismissed = text
        if text == self._news:
            self._news = ""


COMMAND_SETS = (OwnFamilyCommands,)


class FamilyBar(NoticeBar):
    """Bar with a sentence and buttons about a family file, between the canvas and the basis panel.

    Parameters
    ----------
    column
        What it stands in.
    """

    def __init__(self, column: QBoxLayout) -> None:
        parent = column.parentWidget()
        assert parent is not None
        super().__init__("family", parent)
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Fixed)
        column.addWidget(self)

    def place(self) -> None:
        """Take the width of the column, with the buttons beside the sentence where they fit."""
        self.place_buttons(self.below.width())
        self.updateGeometry()
