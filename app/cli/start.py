"""The start of the editor, with the documents of the command line."""

from __future__ import annotations

import gc
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from .. import cli
from ..families import FAMILIES
from ..storage.files import StorageError
from ..storage.open_file import is_large
from ..window.given_files import given_files
from .display import NO_DISPLAY, has_display, missing_library
from .documents import load_document
from .output import RefusalError

if TYPE_CHECKING:
    from PySide6.QtWidgets import QApplication

_YOUNG = 10_000
"""New values after which garbage is sought among them. Thousands of curves make tens of thousands at every
move of a drag: sought as often as Python does, all there is was gone through at every third, for 30 ms."""

_WITHOUT = "“curvebench render” and “curvebench info” need no display."


def edit(files: Sequence[str], lesson: str = "") -> int:
    """Open a window for every document, or one with the first sketch; return when the last is closed.

    Other files are imported or traced in the first window, which also warns of unreadable ones.
    """
    problems = _problems_of(files)
    able = [path for path in files if path not in problems]
    if problems and not able:
        raise next(iter(problems.values()))  # before any window opens
    if not has_display():
        raise RefusalError(f"{NO_DISPLAY} {_WITHOUT}")
    with no_garbage_sought():
        application = _application()
        sentences = [
            *FAMILIES.problems,
            *(f"{str(problem).removesuffix('.')}." for problem in problems.values()),
        ]
        windows = cli.windows.open_windows(able, sentences, lesson)
    return cli.windows.run(application, windows)


def _problems_of(files: Sequence[str]) -> dict[str, RefusalError | StorageError]:
    """Return the problems of files that cannot be opened, imported or traced.

    A large document is read once, beside its window, which reports its problem.
    """
    documents = given_files(map(Path, files)).documents
    problems: dict[str, RefusalError | StorageError] = {}
    for path in files:
        is_document = Path(path) in documents and not is_large(Path(path))
        if is_document or not Path(path).is_file():
            try:
                load_document(path)
            except (RefusalError, StorageError) as problem:
                problems[path] = problem
    return problems


def _application() -> QApplication:
    try:
        return cli.application.qt_application(_WITHOUT)
    except ImportError as problem:
        if sentence := missing_library(str(problem)):
            raise RefusalError(sentence) from problem
        raise


@contextmanager
def no_garbage_sought() -> Iterator[None]:
    """Exempt all objects that are created within from garbage collection, for good.

    This saves some 8 % of the start, and makes later collections shorter and rarer. Where Qt runs
    already, nothing happens.
    """
    if "PySide6.QtWidgets" in sys.modules:
        yield
        return
    gc.disable()
    try:
        yield
    finally:
        gc.freeze()
        gc.set_threshold(_YOUNG, *gc.get_threshold()[1:])
        gc.enable()
