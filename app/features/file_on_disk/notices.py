"""Sentences about the document's file, and the actions offered with them."""

from __future__ import annotations

import time
from enum import Enum, auto

import msgspec

from ...storage.files import ChangedOnDiskError, StorageError
from ...storage.lock import Owner
from ...storage.migration import LeftOut
from ...storage.open_file import FileChange, LockedError


class Notice(msgspec.Struct, frozen=True):
    """A sentence, the names of the actions that are offered with it, and whether it is a warning."""

    text: str
    actions: tuple[str, ...]
    warns: bool = True


class Ownership(Enum):
    """Relation of this window to the one that owns the document."""

    OURS = auto()
    OPENED_ELSEWHERE = auto()
    ASKED = auto()
    """The person wants to take it over, and has been told that somebody may be editing it."""
    TAKEN_AWAY = auto()
    FREED = auto()


def about_content(name: str, change: FileChange, *, modified: bool, owner: Owner | None) -> Notice | None:
    """Return what there is to say when the file `name` holds something else than was seen last."""
    if change is FileChange.CHANGED:
        here = ", and here too" if modified else ""
        text = f"“{name}” was changed on the disk by another program{here}."
        if owner is not None:
            here = "; you have changes of your own here" if modified else ""
            text = f"{_who(owner)} saved changes to “{name}”{_where(owner)}{here}."
        return Notice(text, ("reloadFile", "keepMine", "compareWithFile"))
    if change is FileChange.UNREADABLE:
        text = f"“{name}” was changed by another program and holds no document now. Yours is still here."
        return Notice(text, ("keepMine", "saveDocumentAs"))
    if change is FileChange.GONE:
        text = f"“{name}” is gone from its folder: deleted, moved or renamed. Saving writes it anew."
        return Notice(text, ("saveDocument", "saveDocumentAs"))
    return None


def about_lock(name: str, standing: Ownership, owner: Owner | None) -> Notice | None:
    """Return what there is to say about who owns the document `name`."""
    if standing is Ownership.OURS or owner is None:
        return None
    who, have = _who(owner), _have(owner)
    if standing is Ownership.FREED:
        text = f"“{name}” is free again; nobody else has it open now."
        return Notice(text, ("takeOver",), warns=False)
    if standing is Ownership.ASKED:
        text = f"{who} may still be editing “{name}”. If both save, one will have to choose between the two."
        return Notice(text, ("editAnyway", "saveDocumentAs"))
    if standing is Ownership.TAKEN_AWAY:
        text = f"{who} {have} taken “{name}” over{_where(owner)}. Your changes can go to another file."
        return Notice(text, ("saveDocumentAs", "takeOver"))
    old = f" Perhaps {_who(owner, first=False)} forgot it." if owner.may_have_forgotten else ""
    text = f"{who} {have} this open{_where(owner)}, since {_moment(owner.since)}; opened read-only.{old}"
    return Notice(text, ("takeOver", "saveDocumentAs"), warns=False)


def about_left_out(name: str, left_out: LeftOut) -> Notice | None:
    """Return what there is to say when the file `name` of an older version holds more than the document."""
    if not left_out:
        return None
    them = "it" if left_out.is_one else "them"
    text = f"{left_out.sentence(name)} Save writes the file without {them}, and keeps the old one beside it."
    return Notice(text, ("saveDocumentAs",))


def about_refusal(name: str, sentence: str, problem: StorageError, *, own: bool) -> Notice:
    """Return what to say when the document was not saved to the file `name`, its own one or another."""
    if isinstance(problem, ChangedOnDiskError):
        text = f"“{name}” was changed by another program; it was not saved."
        return Notice(text, ("overwriteFile", "saveDocumentAs", "reloadFile", "compareWithFile"))
    if isinstance(problem, LockedError):
        owner = problem.owner
        text = f"{_who(owner)} {_have(owner)} “{name}” open{_where(owner)}; it was not saved."
        return Notice(text, ("saveDocumentAs", "takeOver") if own else ("saveDocumentAs",))
    return Notice(sentence, ("saveDocumentAs",))


def _who(owner: Owner, *, first: bool = True) -> str:
    if owner.is_same_person:
        return "You" if first else "you"
    return owner.user or ("Somebody" if first else "somebody")


def _have(owner: Owner) -> str:
    return "have" if owner.is_same_person else "has"


def _where(owner: Owner) -> str:
    if owner.is_this_process:
        return " in another window"
    if owner.is_same_person:
        return " in another Curvebench"
    return f" on {owner.host}" if owner.host else ""


def _moment(seconds: float) -> str:
    """Return a time of day, with the date where it is not today."""
    try:
        then, now = time.localtime(seconds), time.localtime()
    except (OverflowError, OSError, ValueError):  # whatever somebody wrote into the lock file
        return "some time"
    same_day = then[:3] == now[:3]
    return time.strftime("%H:%M" if same_day else "%Y-%m-%d %H:%M", then)
