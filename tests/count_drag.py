"""Work of one drag: the functions, files and calls between the press on a point and the undo step.

    python -m tests.count_drag

The second drag of a point in a sketch of one curve of four points, in a new window, without a display.
Counted are Python calls into `app` and `curvecore`, those of the driver in `app.testing` left out; a function
is a file, a name and a line. With `--list` the functions are printed, those called most often first.
"""

from __future__ import annotations

import argparse
import os
import tempfile
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from types import CodeType, FrameType
from typing import TYPE_CHECKING, NamedTuple

from tests.effort import profile

if TYPE_CHECKING:
    from PySide6.QtWidgets import QWidget

    from app.testing import Editor

_ROOT = Path(__file__).parents[1]
_PACKAGES = tuple(f"{_ROOT / name}{os.sep}" for name in ("app", "curvecore"))
_DRIVER = f"{_ROOT / 'app' / 'testing'}{os.sep}"

POINTS = ((0.0, 0.0), (1.0, 1.0), (2.0, 0.0), (3.0, 1.0))


class Function(NamedTuple):
    """A function, by where it is written."""

    file: str
    name: str
    line: int


class Count(NamedTuple):
    """Functions, files and calls of some work."""

    functions: int
    files: int
    calls: int


def codes_called(work: Callable[[], object]) -> Counter[CodeType]:
    """Return how often `work` calls each function that is written in Python."""
    codes: Counter[CodeType] = Counter()

    def note(frame: FrameType, event: str, _argument: object) -> None:
        if event == "call":
            codes[frame.f_code] += 1

    profile(work, note)
    return codes


def calls_by_function(work: Callable[[], object]) -> Counter[Function]:
    """Return how often `work` calls each function of the program."""
    calls: Counter[Function] = Counter()
    for code, number in codes_called(work).items():
        if code.co_filename.startswith(_PACKAGES) and not code.co_filename.startswith(_DRIVER):
            file = str(Path(code.co_filename).relative_to(_ROOT))
            calls[Function(file, code.co_qualname, code.co_firstlineno)] += number
    return calls


def second_drag(editor: Editor) -> Counter[Function]:
    """Return the calls of the second drag of a point, in the new window of `editor`."""
    editor.new()
    for x, y in POINTS:
        editor.add_point(x, y)
    editor.fit()
    editor.drag_point(2, (2.2, 0.3))
    return calls_by_function(lambda: editor.drag_point(1, (1.3, 0.7)))


def total(calls: Counter[Function]) -> Count:
    """Return the sums over all functions."""
    return Count(len(calls), len({function.file for function in calls}), calls.total())


class _Bot:
    """What `Editor` needs of pytest-qt."""

    def __init__(self) -> None:
        self._before_close: list[Callable[[], None]] = []

    def addWidget(
        self, widget: QWidget, *, before_close_func: Callable[[QWidget], None] | None = None
    ) -> None:
        def close() -> None:
            if before_close_func is not None:
                before_close_func(widget)
            widget.close()

        self._before_close.append(close)

    @contextmanager
    def waitExposed(self, widget: QWidget) -> Iterator[None]:
        from PySide6.QtTest import QTest

        yield
        QTest.qWaitForWindowExposed(widget)

    def close(self) -> None:
        """Close the windows."""
        for close in self._before_close:
            close()


def main() -> None:
    """Count the drag and print it."""
    parser = argparse.ArgumentParser(description="Count the work of one drag.")
    parser.add_argument("--list", action="store_true", help="print the functions, too")
    is_listed = parser.parse_args().list
    os.environ["QT_QPA_PLATFORM"] = "offscreen"
    with tempfile.TemporaryDirectory() as home:
        os.environ.update(dict.fromkeys(("HOME", "XDG_CONFIG_HOME", "XDG_DATA_HOME", "XDG_STATE_HOME"), home))
        from PySide6.QtWidgets import QApplication

        from app.testing import Editor

        application, bot = QApplication([]), _Bot()
        calls = second_drag(Editor(bot))
        bot.close()
        application.processEvents()
    if is_listed:
        for function, number in calls.most_common():
            print(f"{number:6} {function.file}:{function.line} {function.name}")
    count = total(calls)
    print(f"{count.functions} functions in {count.files} files, {count.calls} calls")


if __name__ == "__main__":
    main()
