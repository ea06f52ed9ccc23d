"""Unsaved work that was found, in the words of the panel that offers it."""

from __future__ import annotations

import os
import time
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from PySide6.QtCore import QDateTime, QLocale

from ...document.groups import counted_shapes
from ...document.model import Document
from ...document.words import count_of
from ...storage.files import printable_path
from ...storage.recovery import Snapshot, SnapshotOrigin
from ...workbench.document_files import NEW_NAME

_MINUTE, _HOUR, _DAY = 60.0, 3600.0, 86400.0


@dataclass(frozen=True)
class Offer:
    """Unsaved work as the panel shows it.

    Attributes
    ----------
    name
        What the document is called.
    told
        When it was kept, and what there is to know.
    tip
        Where its file is; empty where it has none.
    document
        The work itself, for the picture.
    """

    name: str
    told: str
    tip: str
    document: Document


def offers_of(snapshots: Sequence[Snapshot]) -> list[Offer]:
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
    curves = snapshot.document.curves
    points = count_of(sum(len(each.points) for each in curves), "point")
    moment = time.strftime("%H:%M:%S", time.localtime(snapshot.written))
    return f"{moment} · {counted_shapes(curves)}, {points}"


def _offer(snapshot: Snapshot) -> Offer:
    document, origin, file = snapshot.document, snapshot.origin, snapshot.origin.path
    words = [age_in_words(time.time() - snapshot.written)]
    if file is None:
        words.append("never saved")
    elif not file.exists():
        words.append("file gone")
    elif not origin.is_unchanged:
        words.append("file changed since")
    first = document.curves[0].name
    untitled = origin.title or ("Untitled sketch" if first == NEW_NAME else first)
    name = printable_path(file.name) if file is not None else untitled
    return Offer(name, " · ".join(words), printable_path(file) if file is not None else "", document)


def note_about(damaged: tuple[Path, ...]) -> str:
    """Return what to say of backups that cannot be read."""
    if not damaged:
        return ""
    if len(damaged) == 1:
        return f"⚠ A damaged backup cannot be read; it was set aside as {printable_path(damaged[0].name)}."
    folder = printable_path(damaged[0].parent)
    return f"⚠ {len(damaged)} damaged backups cannot be read; they were set aside in {folder}."


def told_after(origin: SnapshotOrigin, *, is_unchanged: bool) -> str:
    """Return what to say of work that was restored, by the file it came from."""
    if origin.path is None:
        return "Restored; it has no file yet."
    name = printable_path(origin.path.name)
    if is_unchanged:
        return f"Restored; {name} does not hold these changes until you save."
    if not origin.path.exists():
        return f"{name} is gone; your work was restored as a new document."
    return f"{name} has changed since; your work was restored as a new document."


def age_in_words(seconds: float) -> str:
    """Return how long ago something was, as people say it; of more than a month the date."""
    if seconds < 45:  # also where the clock was set back
        return "a moment ago"
    if seconds > 30 * _DAY:
        then = QDateTime.fromSecsSinceEpoch(round(time.time() - seconds))
        return "on " + QLocale().toString(then.date(), QLocale.FormatType.ShortFormat)
    for unit, name, one in (
        (_DAY, "day", "a day"),
        (_HOUR, "hour", "an hour"),
        (_MINUTE, "minute", "a minute"),
    ):
        if seconds >= 0.75 * unit:
            number = max(round(seconds / unit), 1)
            return f"{one} ago" if number == 1 else f"{number} {name}s ago"
    return "a moment ago"
