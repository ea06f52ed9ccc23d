"""A process in which the editor was used ends as every other does."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

APP = Path(__file__).parents[2] / "app"

_COPIES = """
from PySide6.QtCore import QMimeData
from PySide6.QtWidgets import QApplication
from app.workbench.clipboard import put_on_clipboard
application = QApplication([])
data = QMimeData()
data.setText("1 2")
put_on_clipboard(data)
assert application.clipboard().text() == "1 2"
"""


def test_copied_data_does_not_end_the_process_with_a_fault():
    """Qt destroyed it after the interpreter had gone: a segmentation fault, exit code −11."""
    assert subprocess.run([sys.executable, "-c", _COPIES], check=False).returncode == 0


def test_only_clipboard_code_sets_data_on_the_clipboard():
    texts = {path: path.read_text(encoding="utf-8") for path in APP.rglob("*.py")}
    assert [path.name for path in texts if ".setMimeData(" in texts[path]] == ["clipboard.py"]
