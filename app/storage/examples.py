"""The curve that the first window shows, and the examples that come with the program.

To add an example: save a document in ``resources/examples``. File > Examples lists the folder.
"""

from __future__ import annotations

from pathlib import Path

from ..document.model import Document, make_curve
from .files import StorageError, load
from .format_error import FormatError
from .resources import resource

_S_SKETCH = (
    (3.03, 3.34), (2.65, 3.81), (1.39, 3.83), (1.14, 2.38),
    (2.95, 1.62), (2.67, 0.17), (1.29, 0.19), (0.86, 0.66),
)  # fmt: skip
"""Points that are denser towards the ends, as polynomials need them: the basis functions stay small."""


def first_sketch() -> Document:
    """Return the document of a window without a file: an S-shaped sketch."""
    return Document((make_curve(_S_SKETCH, name="Sketch"),))


def example_paths() -> list[Path]:
    """Return the paths of the documents in File > Examples."""
    return sorted(resource("examples").glob("*.curve.json"))


def example_name(path: Path) -> str:
    """Return the name of the first curve of the document at `path`; the file name if it cannot be read."""
    try:
        return load(path).curves[0].name
    except (FormatError, StorageError):
        return path.name


def template_title(path: Path, document: Document) -> str:
    """Return the title of an unsaved copy of the example or lesson at `path`."""
    if path.parent.parent.name == "lessons":
        number, _, words = path.parent.name.partition("_")
        return f"Lesson {int(number)} ({words.replace('_', ' ')})" if number.isdecimal() else "Lesson"
    return f"{document.curves[0].name} (example)"
