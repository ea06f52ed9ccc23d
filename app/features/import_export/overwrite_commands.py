"""What was opened from a file of another format, written back to it."""

from __future__ import annotations

from pathlib import Path

from msgspec.structs import replace

from ... import exchange
from ...actions.declaration import action
from ...actions.needs import Need
from ...actions.sections import FILE_SAVE
from ...actions.situation import Situation
from ...document.model import Document
from ...document.words import count_of, names_of
from ...exchange.formats import Written
from ...storage.foreign import Foreign
from ...storage.reasons import shown
from ...tasks.progress import Report
from ...workbench.context import WindowContext


def _has_file(now: Situation) -> bool:
    return now.session.files.foreign is not None


def _title(now: Situation) -> str:
    foreign = now.session.files.foreign
    return f"Overwrite “{shown(foreign.path.name)}”" if foreign is not None else "Overwrite the Opened File"


def _words_about_loss(foreign: Foreign) -> str:
    """Return what is said before a file is written without what did not come in."""
    count, name = len(foreign.missed), shown(foreign.path.name)
    them = "it" if count == 1 else "them"
    return (
        f"{count_of(count, 'thing')} in {name} did not come in as drawn and would be lost: "
        f"{names_of(foreign.missed)}. Overwrite again to write it without {them}."
    )


def _words_about(foreign: Foreign, written: Written) -> str:
    """Return how near a file is to the document, and to what it was."""
    if not foreign.missed:
        return f", {written.words}"
    near = f", {written.words}" if written.deviation else ""
    return f" without {count_of(len(foreign.missed), 'thing')} that had not come in{near}"


class OverwriteCommands:
    """Writes a drawing back to the file that it was opened from."""

    def __init__(self, context: WindowContext) -> None:
        self._session, self._work = context.session, context.work
        self._told: tuple[Foreign, Document] | None = None

    @action(
        "overwriteForeign",
        "Overwrite the Opened File",
        FILE_SAVE,
        "Ctrl+Alt+S",
        "export",
        keywords="save SVG DXF again export back",
        needs=Need("a drawing that was opened from an SVG or DXF file", _has_file),
        title=_title,
    )
    def _overwrite(self) -> None:
        """Write the drawing back to the SVG or DXF file that it was opened from."""
        session, foreign = self._session, self._session.files.foreign
        assert foreign is not None
        document, beginning = session.committed, session.files.beginning
        if foreign.missed and self._told != (foreign, document):
            self._told = foreign, document
            session.offer(_words_about_loss(foreign), "overwriteForeign")
            session.refuse(f"{shown(foreign.path.name)} is not written yet.")
            return
        options = replace(exchange.options.DEFAULT, unit=document.unit, tells_exactness=False)

        def work(report: Report) -> tuple[Path | None, Written, Foreign]:
            kept = foreign.keep_what_would_be_lost()
            written = exchange.writing.export(document, foreign.path, options.reporting(report))
            return kept, written, foreign.as_it_is()

        def done(found: tuple[Path | None, Written, Foreign]) -> None:
            kept, written, now = found
            session.files.note_written_back(beginning, now)
            session.offer("", "overwriteForeign")
            copy = f" What it was is kept as {shown(kept.name)}." if kept is not None else ""
            session.say(f"Wrote {shown(foreign.path.name)}{_words_about(foreign, written)}.{copy}")
            self._work.warn_of(written.remarks)

        name = shown(foreign.path.name)
        self._work.start(f"Writing {name}", work, done, foreign.path, "written")
