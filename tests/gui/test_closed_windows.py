"""A window that is closed goes, with everything that belongs to it."""

from __future__ import annotations

import gc
import weakref
from collections import Counter

from PySide6.QtCore import QCoreApplication, QEvent, QObject, QTimer

from app.cli.windows import Lifecycle, open_windows
from app.session import DocumentOrigin, Session
from app.storage.files import save
from app.testing import Editor


def deliver_deletions(qapp):
    for _ in range(2):
        qapp.processEvents()
        QCoreApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)


def living():
    """How many objects there are of Qt's timers, and of our classes derived from QObject."""
    gc.collect()
    kinds = Counter(type(each) for each in gc.get_objects())
    return Counter(
        {
            kind.__name__: count
            for kind, count in kinds.items()
            if kind is QTimer or (issubclass(kind, QObject) and kind.__module__.startswith("app."))
        }
    )


def use(window):
    """Build what is built late, and change something."""
    editor = Editor.on(window)
    editor.drag_point(1, to=(1, 3))
    editor.find_command("fit")
    editor.escape()
    for name in ("preferences", "showShortcuts"):
        editor.trigger(name)
    for dock in window.context.docks.side:
        dock.show()
    window.session.undo_stack.setClean()


def test_closed_windows_leave_no_objects(qapp, tmp_path):
    # Of 50 that were opened and closed, 51 windows and 1,123 timers were left, in 101 MB.
    paths = [tmp_path / f"{number}.curve.json" for number in range(2)]
    for path in paths:
        save(path, Session().document)
    before = living()
    windows = open_windows([str(path) for path in paths])
    lifecycle = Lifecycle(qapp, windows)
    lifecycle.start()
    deliver_deletions(qapp)
    lifecycle._open_beside(Session().document, None, DocumentOrigin())
    windows = list(lifecycle._autosaves)
    assert len(windows) == len(paths) + 1
    use(windows[0])
    gone = [weakref.ref(each) for window in windows for each in (window, window.session, window.canvas)]
    for window in windows:
        window.asks_before_closing = False
        window.close()
    windows.clear()
    del window
    deliver_deletions(qapp)
    after = living()
    assert [each() for each in gone if each() is not None] == []
    # A timer belongs to each of Lifecycle (a call that opens the log), CrashHandler and _Keeper. The last is
    # made with the first task, and is one for the program.
    # FamilyFiles, too, is one for the program.
    kept = Counter(
        FamilyFiles=1, Lifecycle=1, CrashHandler=1, SignalWatch=1, _SystemFollower=1, _Keeper=1
    ) + Counter(DelayedCall=1, QTimer=2)
    assert after - before - kept == Counter(), "of the program's own there are these"
    lifecycle.stop()
