"""The last export of a document: kept with it for the next time."""

from __future__ import annotations

from typing import Annotated, Final

from .fields import Requirement, few, printed
from .value import Value

LONGEST_NAME: Final = 255
LONGEST_OPTION: Final = 1000
MOST_OPTIONS: Final = 64

_NAME = Requirement(
    lambda name: len(name) <= LONGEST_NAME and name.isprintable() and not {"/", "\\"} & {*name},
    "be the name of a file without its folder",
)
_OPTIONS = few(MOST_OPTIONS, f"be at most {MOST_OPTIONS}")
_OPTION = Requirement(
    lambda texts: all(len(text) <= LONGEST_OPTION and text.isprintable() for text in texts),
    f"be printable texts of at most {LONGEST_OPTION} characters",
)


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

    ending: Annotated[str, printed(LONGEST_NAME, "be the end of a name")] = ""
    name: Annotated[str, _NAME] = ""
    options: Annotated[tuple[tuple[str, str], ...], _OPTIONS, _OPTION] = ()


NEVER_EXPORTED: Final = Export()
