"""Crash report for the makers, without the names of files and folders."""

from __future__ import annotations

import platform
import re
import sys
import traceback
from collections.abc import Collection
from pathlib import Path

from .. import __version__
from .log import last_lines

_LIBRARIES = ("PySide6", "pyqtgraph", "numpy", "msgspec")
_PACKAGES = re.compile(r".*[\\/](?:site-packages|dist-packages|python3\.\d+|Lib)[\\/]")
_FILE = re.compile(r'(?<=File ")([^"\n]+)(?=", line)')
_PATH = re.compile(r"(?<![\w.])(?:[A-Za-z]:)?(?:[\\/][^\s\\/'\"“”<>|:]+){2,}")
_QUOTED = re.compile("“[^”]*”")
"""Files and curves as the sentences of this program name them."""

_PROGRAM = Path(__file__).resolve().parents[1]
_ROOT = _PROGRAM.parent
_SHORTEST_NAME = 3
_LONGEST = 20_000


def report_of(problem: BaseException, private: Collection[str] = ()) -> str:
    """Return the report about an exception.

    Parameters
    ----------
    problem
        What was raised.
    private
        Words that must not appear: the names of open files, for instance.
    """
    trace = "".join(traceback.format_exception(problem))
    text = without_names(shortened(trace), private)
    if len(text) > _LONGEST:  # endless recursion
        text = f"{text[: _LONGEST // 2]}\n…\n{text[-_LONGEST // 2 :]}"
    lines = without_names("\n".join(last_lines()), private)
    return f"{versions()}\n\n{text.rstrip()}\n\n{lines}".rstrip() + "\n"


def signature_of(problem: BaseException) -> str:
    """Return what two reports about the same fault have in common: what was raised, and where."""
    place = "".join(f"{file}:{line}" for file, line in _lines_of(problem)[-1:])
    return f"{type(problem).__qualname__} {place}"


def place_of(problem: BaseException) -> str:
    """Return the line of this program in which something was raised; no other file is named."""
    own = [
        f"{_short(file)}:{line}" for file, line in _lines_of(problem) if Path(file).is_relative_to(_PROGRAM)
    ]
    return own[-1] if own else "no line of its own"


def _lines_of(problem: BaseException) -> list[tuple[str, int]]:
    """Return the files and lines of a traceback, the one that raised last."""
    return [(frame.f_code.co_filename, line) for frame, line in traceback.walk_tb(problem.__traceback__)]


def versions() -> str:
    """Return the versions of everything that takes part, one per line."""
    rows = [f"Curvebench {__version__}", f"Python {platform.python_version()}"]
    rows += [f"{name} {_version(name)}" for name in _LIBRARIES]
    core = sys.modules.get("PySide6.QtCore")
    if core is not None:
        rows.append(f"Qt {core.qVersion()}, {_platform_plugin()}")
    rows.append(f"{platform.system()} {platform.release()}, {platform.machine()}")
    return "\n".join(rows)


def _version(name: str) -> str:
    return str(getattr(sys.modules.get(name), "__version__", "(not loaded)"))


def _platform_plugin() -> str:
    gui = sys.modules.get("PySide6.QtGui")
    application = gui.QGuiApplication.instance() if gui is not None else None
    return str(application.platformName()) if application is not None else "no window system"


def shortened(trace: str) -> str:
    """Return a traceback whose files are named from their package on."""
    return _FILE.sub(lambda match: _short(match[1]), trace)


def _short(file: str) -> str:
    path = Path(file)
    if path.is_relative_to(_ROOT):
        inside = path.relative_to(_ROOT).as_posix()
        if not _PACKAGES.match(inside):  # an environment may lie within the working copy
            return inside
    if _PACKAGES.match(file):
        return _PACKAGES.sub("", file).replace("\\", "/")
    return re.split(r"[\\/]", file)[-1]


def without_names(text: str, private: Collection[str]) -> str:
    """Return `text` without paths, quoted names, the home folder and the words in `private`."""
    try:
        home = str(Path.home())
    except RuntimeError:  # there is none
        home = ""
    # The longest first: a file's name is a part of its path.
    for word in sorted({home, *private}, key=len, reverse=True):
        if len(word) >= _SHORTEST_NAME:
            text = text.replace(word, "…").replace(repr(word)[1:-1], "…")
    return _PATH.sub("…", _QUOTED.sub("“…”", text))
