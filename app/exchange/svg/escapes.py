"""Text as XML may hold it."""

from __future__ import annotations

import re

# XML 1.0 has no way at all to write these.
_NOT_IN_XML = "[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]"


def quoted(text: str) -> str:
    """Return text as an attribute in quotation marks may hold it."""
    return escaped(" ".join(text.splitlines())).replace('"', "&quot;")


def escaped(text: str) -> str:
    """Return text as XML may hold it."""
    # Compiled here, and kept by `re`: that takes longer than importing this module.
    text = re.sub(_NOT_IN_XML, "\ufffd", text)
    # What xml.sax.saxutils does, without the network modules that it imports.
    return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
