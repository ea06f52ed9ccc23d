"""What a document had in the file that it was opened from, and pictures of it have not."""

from __future__ import annotations

from .. import exchange
from ..document.model import Document
from ..session import Session
from ..storage.reasons import shown


def words_about_undrawn(session: Session, document: Document) -> str:
    """Return the sentence to say before a document, or a part of it, is exported; or none."""
    foreign = session.files.foreign
    if foreign is None:
        return ""
    words = [each.words for each in foreign.still_missed(document)]
    return exchange.missed.words_about_undrawn(words, shown(foreign.path.name))
