"""The last export of a document: kept with it for the next time."""

from __future__ import annotations

from typing import Final

from .value import Value


class Export(Value, frozen=True):
    """A format, a file and the options of an export.

    Attributes
    ----------
    ending
        Of the files of the format, such as ".png"; empty where the document was never exported.
    name
        Of the file, without its folder.
    options
        Options that are not at their defaults: their names, and their values as JSON.
    """

    ending: str = ""
    name: str = ""
    options: tuple[tuple[str, str], ...] = ()


NEVER_EXPORTED: Final = Export()
