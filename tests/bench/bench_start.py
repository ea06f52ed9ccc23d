"""From the start of the interpreter's work to the first painted frame, beside a bare pyqtgraph window.

    python -m pytest tests/bench/bench_start.py

Both run in processes of their own, in turn, with their bytecode cached beforehand; medians are compared.
"""

from __future__ import annotations

import os
import statistics
import subprocess
import sys
from pathlib import Path

import targets

ROOT = Path(__file__).resolve().parents[2]
ROUNDS = 9

_BEGIN = "import time; began = time.perf_counter()\n"
_END = """
def done():
    # Of this program alone: getrusage counts what the parent had at the fork.
    lines = open("/proc/self/status").read().splitlines()
    peak = next(int(line.split()[1]) for line in lines if line.startswith("VmHWM")) / 1024
    print(1e3 * (time.perf_counter() - began), peak, flush=True)
    os._exit(0)
"""
BARE = (
    _BEGIN
    + """
import os
from PySide6 import QtCore, QtGui, QtWidgets
import numpy as np, pyqtgraph as pg
pg.mkQApp()
class Window(pg.PlotWidget):
    def paintEvent(self, event):
        super().paintEvent(event)
        QtCore.QTimer.singleShot(0, done)
window = Window()
x = np.linspace(0, 1, 500)
window.plot(x, np.sin(7 * x))
"""
    + _END
    + "window.resize(600, 400); window.show(); pg.exec()\n"
)
OURS = (
    _BEGIN
    + """
import app.cli.start
app.cli.start.has_display = lambda: True
make_application = app.cli.start._application
def make_and_watch():
    application = make_application()
    import app.cli.windows
    open_windows = app.cli.windows.open_windows
    def open_and_watch(*what):
        from PySide6.QtCore import QTimer
        (window,) = open_windows(*what)
        window.canvas.painted.connect(lambda: QTimer.singleShot(0, done))
        return [window]
    app.cli.windows.open_windows = open_and_watch
    return application
app.cli.start._application = make_and_watch
import os
"""
    + _END
    + "app.cli.main([])\n"
)


def run(code: str, home: Path) -> tuple[float, float]:
    """Return milliseconds and the peak of memory in megabytes."""
    environment = {
        key: value for key, value in os.environ.items() if key not in ("PYTHONDONTWRITEBYTECODE", "DISPLAY")
    }
    environment |= {"PYTHONPYCACHEPREFIX": str(home / "bytecode"), "QT_QPA_PLATFORM": "offscreen"}
    environment |= {"PYTHONPATH": str(ROOT), "HOME": str(home), "XDG_CONFIG_HOME": str(home)}
    done = subprocess.run(
        [sys.executable, "-c", code], env=environment, cwd=home, capture_output=True, text=True, check=True
    )
    milliseconds, megabytes = done.stdout.split()
    return float(milliseconds), float(megabytes)


def test_start_and_memory(tmp_path):
    codes = {"bare": BARE, "ours": OURS}
    for code in codes.values():
        run(code, tmp_path)
    figures: dict[str, list[tuple[float, float]]] = {name: [] for name in codes}
    for _ in range(ROUNDS):
        for name, code in codes.items():
            figures[name].append(run(code, tmp_path))
    times, peaks = (
        {name: statistics.median(row[column] for row in rows) for name, rows in figures.items()}
        for column in (0, 1)
    )
    what = f"first frame {times['ours']:.0f} ms over a pyqtgraph window's {times['bare']:.0f}"
    fast = targets.at_most(what, times["ours"] / times["bare"], 1.3, "times")
    what = f"peak memory {peaks['ours']:.0f} MB over its {peaks['bare']:.0f}"
    assert targets.at_most(what, peaks["ours"] / peaks["bare"], 1.4, "times")
    assert fast
