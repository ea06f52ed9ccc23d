"""Offers what was not saved when the program last ended, and brings it back."""

from __future__ import annotations

import os
import time
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from app.actions.declaration import action
from app.actions.sections import FILE_RECOVERY
from app.autosave import Autosave, snapshot_folder
from app.commands.context import WindowContext
from app.document.model import Document
from app.file_commands import NEW_NAME
from app.set_aside import SetAside
from app.storage.recovery import Found, Snapshot, list_snapshots

if TYPE_CHECKING:
    from app.panels.recovery_bar import Offer, RecoveryBar


OpenBeside = Callable[[Document, Path | None], Autosave]
"""Opens another window on a document with changes that are not in its file."""


class RecoveryCommands:
    """Unsaved work: restored, discarded or left for later."""

    def __init__(self, context: WindowContext) -> None:
        self._context = context
        self._bar: RecoveryBar | None = None
        self._found = Found()
        self._autosave: Autosave | None = None
        self._open_beside: OpenBeside | None = None
        self._set_aside: SetAside | None = None

    def keep_with(self, autosave: Autosave, open_beside: OpenBeside) -> None:
        """Keep with `autosave` what is restored here; where there is other work, restore it elsewhere."""
        self._autosave, self._open_beside = autosave, open_beside
        self._set_aside = SetAside(self._context.session, snapshot_folder(), self._context.window)

    def close(self) -> None:
        """Keep for the next start what is not decided, and what only the history of this window holds."""
        self.leave()
        if self._set_aside is not None:
            self._set_aside.leave()

    @action("recoverWork", "Recover Unsaved Work", FILE_RECOVERY, icon="history")
    def _look_again(self) -> None:
        """Offer what was not saved when the program last ended."""
        self.look()
        if not self._found.snapshots and not self._found.damaged:
            self._context.session.say("There is no unsaved work.")
        elif self._bar is not None:
            self._bar.take_focus()

    def look(self) -> None:
        """Offer what there is; say nothing where there is nothing."""
        self.leave()
        self._found = list_snapshots(snapshot_folder())
        if self._found.snapshots or self._found.damaged:
            self._render()

    def leave(self) -> None:
        """Keep what is not decided for the next start."""
        for snapshot in self._found.snapshots:
            snapshot.leave()
        self._found = Found()
        if self._bar is not None:
            self._bar.hide()

    def _render(self) -> None:
        # Imported and built only where there is something to show: almost no start has that.
        from app.panels.recovery_bar import RecoveryBar  # noqa: PLC0415

        if self._bar is None:
            self._bar = RecoveryBar(self._context.central.canvas)
            self._bar.restore_asked.connect(self._restore)
            self._bar.discard_asked.connect(self._discard)
            self._bar.later_asked.connect(self._later)
            self._bar.closed.connect(self.leave)
        self._bar.render(_offers(self._found.snapshots), _note(self._found.damaged))

    def _take(self, index: int) -> Snapshot:
        snapshots = list(self._found.snapshots)
        snapshot = snapshots.pop(index)
        self._found = Found(tuple(snapshots))
        self._render()
        return snapshot

    def _restore(self, index: int) -> None:
        session = self._context.session
        # Another window, rather than a question about the work in this one.
        open_beside = self._open_beside if session.is_modified else None
        if open_beside is None and not self._context.files.may_discard():
            return
        snapshot = self._take(index)
        origin, autosave = snapshot.origin, self._autosave
        path = origin.path if origin.is_unchanged else None
        if open_beside is not None:
            autosave = open_beside(snapshot.document, path)
        else:
            session.files.restore(snapshot.document, path)
        if autosave is not None and autosave.write_now():
            snapshot.discard()
        else:
            snapshot.leave()  # rather offered twice than lost
        session.say(_told_after(origin.path, is_unchanged=path is not None))

    def _discard(self, index: int) -> None:
        self._take(index).discard()
        self._context.session.say("The unsaved work was deleted.")

    def _later(self, index: int) -> None:
        self._take(index).leave()
        self._context.session.say("It is kept; the next start asks again.")


def _offers(snapshots: Sequence[Snapshot]) -> list[Offer]:
    """Return how the snapshots are shown; those of one name are told apart."""
    offers = [_offer(each) for each in snapshots]
    places = {name: {each.tip for each in offers if each.name == name} for name in {o.name for o in offers}}
    # Files of one name in several folders …
    offers = [
        replace(each, name=os.path.join(*Path(each.tip).parts[-2:]))  # noqa: PTH118 - as it is written
        if each.tip and len(places[each.name]) > 1
        else each
        for each in offers
    ]
    # … and several windows of one file.
    total, seen = Counter((each.name, each.tip) for each in offers), Counter[tuple[str, str]]()
    for index, (offer, snapshot) in enumerate(zip(offers, snapshots, strict=True)):
        key = (offer.name, offer.tip)
        seen[key] += 1
        if total[key] > 1:
            name = f"{offer.name} ({seen[key]} of {total[key]})"
            offers[index] = replace(offer, name=name, told=f"{_contents(snapshot)} · {offer.told}")
    return offers


def _contents(snapshot: Snapshot) -> str:
    """Return when it was kept, to the second, and how much it holds."""
    from app.document.words import count_of  # noqa: PLC0415

    curves = snapshot.document.curves
    points = count_of(sum(len(each.nodes) for each in curves), "point")
    moment = time.strftime("%H:%M:%S", time.localtime(snapshot.written))
    return f"{moment} · {count_of(len(curves), 'curve')}, {points}"


def _offer(snapshot: Snapshot) -> Offer:
    from app.panels.recovery_bar import Offer, age_in_words  # noqa: PLC0415

    document, path = snapshot.document, snapshot.origin.path
    words = [age_in_words(time.time() - snapshot.written)]
    if path is None:
        words.append("never saved")
    elif not path.exists():
        words.append("file gone")
    elif not snapshot.origin.is_unchanged:
        words.append("file changed since")
    first = document.curves[0].name
    untitled = "Untitled sketch" if first == NEW_NAME else first
    name = _text(path.name) if path is not None else untitled
    return Offer(name, " · ".join(words), _text(path) if path is not None else "", document)


def _note(damaged: tuple[Path, ...]) -> str:
    if not damaged:
        return ""
    if len(damaged) == 1:
        return f"⚠ A damaged backup cannot be read; it was set aside as {_text(damaged[0].name)}."
    return (
        f"⚠ {len(damaged)} damaged backups cannot be read; they were set aside in {_text(damaged[0].parent)}."
    )


def _told_after(path: Path | None, *, is_unchanged: bool) -> str:
    if path is None:
        return "Restored; it has no file yet."
    if is_unchanged:
        return f"Restored; {_text(path.name)} does not hold these changes until you save."
    if not path.exists():
        return f"{_text(path.name)} is gone; your work was restored as a new document."
    return f"{_text(path.name)} has changed since; your work was restored as a new document."


def _text(path: Path | str) -> str:
    """Return a path as it may stand in a sentence, whatever bytes it holds."""
    text = str(path).encode("utf-8", "replace").decode()
    return "".join(character if character.isprintable() else "�" for character in text)
