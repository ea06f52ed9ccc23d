"""What was opened from a file of another format, written back to it."""

from __future__ import annotations

from functools import partial
from pathlib import Path
from typing import NamedTuple

from msgspec.structs import replace

from ... import exchange
from ...actions.declaration import action
from ...actions.needs import Need
from ...actions.sections import FILE_SAVE
from ...actions.situation import Situation
from ...document.model import Document
from ...document.words import count_of, names_of
from ...exchange.formats import Written, are_read_alike
from ...session import Beginning
from ...storage.foreign import Foreign
from ...storage.reasons import shown
from ...tasks.progress import Report, part
from ...workbench.context import WindowContext
from ...workbench.unsaved_changes import words_of_loss


def _has_file(now: Situation) -> bool:
    return now.session.files.foreign is not None


def _title(now: Situation) -> str:
    foreign = now.session.files.foreign
    return f"Overwrite “{shown(foreign.path.name)}”" if foreign is not None else "Overwrite the Opened File"


def _words_about_change(foreign: Foreign) -> str:
    """Return what is said before a file is written that somebody else has written meanwhile."""
    return (
        f"{shown(foreign.path.name)} was changed by another program since it was opened here. Overwrite "
        "again to put these curves into what it holds now, of which a copy is kept."
    )


def _words_about_loss(foreign: Foreign) -> str:
    """Return what is said before a file is written without what did not come in."""
    count, name = len(foreign.missed), shown(foreign.path.name)
    them = "it" if count == 1 else "them"
    return (
        f"{count_of(count, 'thing')} in {name} did not come in as drawn and would be lost: "
        f"{names_of([each.words for each in foreign.missed])}. Overwrite again to write it without {them}."
    )


def _words_about(foreign: Foreign, done: Done) -> str:
    """Return how near a file is to the document, and to what it was."""
    if not foreign.missed:
        return f", {done.written.words}"
    count = count_of(len(foreign.missed), "thing")
    if done.is_kept:
        verb = "is" if len(foreign.missed) == 1 else "are"
        return f", {done.written.words}; {count} that had not come in {verb} as before"
    near = f", {done.written.words}" if done.written.deviation else ""
    return f" without {count} that had not come in{near}"


class Done(NamedTuple):
    """A file that was written.

    Attributes
    ----------
    written
        What.
    is_kept
        Whether nothing else of it was changed.
    copy
        What keeps what it was; None where nothing had to.
    now
        The file as it is now.
    is_same
        Whether it was like that already, so that nothing was written.
    """

    written: Written
    is_kept: bool
    copy: Path | None
    now: Foreign
    is_same: bool = False


class _Question(NamedTuple):
    """What a person is to know before a file is written."""

    words: str


class OverwriteCommands:
    """Writes a drawing back to the file that it was opened from."""

    def __init__(self, context: WindowContext) -> None:
        self._session, self._work, self._preferences = context.session, context.work, context.preferences
        self._told: tuple[Foreign, Document] | None = None
        context.files.save_back = self._save
        context.files.save_as_svg = self._save_as

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
        """Write the drawing back to the file that it was opened from; what else is in an SVG stays."""
        self._write(waits=False)

    def _save(self, waits: bool) -> bool:
        """Save there, unless a person who was not asked yet is to say whether it is the place."""
        session, foreign = self._session, self._session.files.foreign
        assert foreign is not None
        session.cancel()
        if not waits and (lost := words_of_loss(foreign, session.committed)):
            session.offer(lost, "overwriteForeign", "saveDocumentAs")
            session.refuse(f"{shown(foreign.path.name)} is not saved yet.")
            return False
        self._write(waits=waits)
        return not session.files.is_modified

    def _save_as(self, path: Path, waits: bool) -> bool:
        """Save to another file, which the document stands for from then on; say what it does not keep."""
        session = self._session
        session.cancel()
        document, files = session.committed, session.files
        work = partial(written_to, path.absolute(), files.foreign, document)
        done = partial(self._go_over, document, files.beginning, files.foreign)
        start = self._work.do_now if waits else self._work.start
        start(f"Writing {shown(path.name)}", work, done, path, "saved")
        return not files.is_modified

    def _go_over(self, document: Document, beginning: Beginning, origin: Foreign | None, found: Done) -> None:
        session, path = self._session, found.now.path
        session.files.go_over_to(found.now, beginning, document)
        self._preferences.add_recent_file(path)
        self._preferences.last_folder = path.parent
        lasting = exchange.lasting
        lost = lasting.words_about_loss(document, path), lasting.words_about_plain(document, path)
        session.offer(" ".join(filter(None, lost)), "saveDocumentAs")
        near = _words_about(origin or found.now, found)
        session.say(" ".join([f"Saved {shown(path.name)}{near}.", *found.written.changes]))
        self._work.warn_of(found.written.remarks)

    def _write(self, *, waits: bool) -> None:
        session, foreign = self._session, self._session.files.foreign
        assert foreign is not None
        document, beginning = session.committed, session.files.beginning
        work = partial(_written_back, foreign, document, self._told == (foreign, document))
        done = partial(self._tell, foreign, document, beginning)
        start = self._work.do_now if waits else self._work.start
        start(f"Writing {shown(foreign.path.name)}", work, done, foreign.path, "written")

    def _tell(
        self, foreign: Foreign, document: Document, beginning: Beginning, found: Done | _Question
    ) -> None:
        session, name = self._session, shown(foreign.path.name)
        if isinstance(found, _Question):
            self._told = foreign, document
            session.offer(found.words, "overwriteForeign")
            session.refuse(f"{name} is not written yet.")
            return
        session.files.note_written_back(beginning, found.now, document)
        session.offer("")
        if found.is_same:
            session.say(f"{name} is like this already.")
            return
        copy = f" What it was is kept as {shown(found.copy.name)}." if found.copy is not None else ""
        plain = exchange.lasting.words_about_plain(document, foreign.path)
        parts = f"{_words_about(foreign, found)}.", *found.written.changes, plain
        session.say(f"Wrote {name}{' '.join(filter(None, parts))}{copy}")
        self._work.warn_of(found.written.remarks)


def _written_back(foreign: Foreign, document: Document, may: bool, report: Report) -> Done | _Question:
    """Write a document back to a file, unless a person who was not asked yet is to know something first."""
    writing, content = exchange.writing, foreign.content()
    if content is not None and foreign.is_another(content) and not may:
        return _Question(_words_about_change(foreign))
    kept = None
    if content is not None:
        ahead = part(report, 0.0, 0.9)
        kept = writing.with_changes(content.data, foreign.path, document, foreign.begun, ahead)
    if kept is None and foreign.missed and not may:
        return _Question(_words_about_loss(foreign))
    if kept is not None and content is not None and kept.data == content.data:
        return Done(kept, True, None, foreign, is_same=True)
    copy = foreign.keep_what_would_be_lost()
    if kept is not None:
        writing.put(kept, foreign.path, report)
        return Done(kept, True, copy, foreign.as_it_is(document, is_kept=True))
    return _anew(foreign, document, copy, report)


def _anew(foreign: Foreign, document: Document, copy: Path | None, report: Report) -> Done:
    """Write a file with a document and nothing else."""
    options = replace(exchange.options.DEFAULT, unit=document.unit, tells_exactness=False)
    written = exchange.writing.export(document, foreign.path, options.reporting(report))
    return Done(written, False, copy, foreign.as_it_is(document, is_kept=False))


def written_to(path: Path, origin: Foreign | None, document: Document, report: Report) -> Done:
    """Write a document to another file, with all else in that which it came from if it is of that format."""
    writing, new = exchange.writing, Foreign(path)
    content = origin.content() if origin is not None and are_read_alike(origin.path, path) else None
    if origin is None or content is None:
        return _anew(new, document, None, report)
    ahead = part(report, 0.0, 0.9)
    kept = writing.with_changes(content.data, path, document, origin.begun, ahead)
    if kept is None:
        return _anew(new, document, None, report)
    writing.put(kept, path, report)
    new = replace(new, missed=origin.missed)
    return Done(kept, True, None, new.as_it_is(document, is_kept=True))
