"""The README's examples run as they stand."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

from app.exchange.formats import FORMATS

ROOT = Path(__file__).parents[1]


def blocks(section: str) -> list[str]:
    """Return the Python blocks of a section."""
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    body = text.split(f"## {section}\n", 1)[1].split("\n## ", 1)[0]
    return re.findall(r"```python\n(.*?)```", body, re.DOTALL)


def run(*command: str, cwd: Path) -> subprocess.CompletedProcess[str]:
    """Run Python in `cwd` with this checkout on its path, without a display or a hint for Qt.

    There the pytest-qt example was aborted by Qt.
    """
    hidden = {"DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"}
    environment = {key: value for key, value in os.environ.items() if key not in hidden}
    environment["PYTHONPATH"] = str(ROOT)
    # With pytest-qt alone: what other plugins of pytest are installed here, nobody else needs to have.
    environment |= {"PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1", "PYTEST_PLUGINS": "pytestqt.plugin"}
    return subprocess.run(
        [sys.executable, *command], cwd=cwd, env=environment, capture_output=True, text=True, check=False
    )


def test_the_table_of_formats_is_that_of_the_registry():
    """Where they differ, put the rows into the README as the failure shows them."""
    head = "| ends in | | read | written |\n| --- | --- | --- | --- |\n"
    rows = "".join(
        f"| {', '.join(f'`{ending}`' for ending in each.endings)} | {each.title} "
        f"| {'yes' if each.kind else ''} | {'yes' if each.write else ''} |\n"
        for each in FORMATS
    )
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    assert text.partition(head)[2].partition("\n\n")[0] + "\n" == rows


def test_the_core_example_prints_what_it_says(tmp_path):
    (example,) = blocks("The core as a library")
    result = run("-W", "error", "-c", example, cwd=tmp_path)
    assert result.returncode == 0, result.stderr
    # The position functions sum to one, to a few roundings.
    assert abs(float(result.stdout.split()[-1]) - 1) < 1e-14


def test_the_pytest_qt_example_is_a_test_that_passes(tmp_path):
    conftest, test = blocks("Driving the editor from pytest-qt")
    (tmp_path / "conftest.py").write_text(conftest, encoding="utf-8")
    (tmp_path / "test_example.py").write_text(test, encoding="utf-8")
    result = run("-m", "pytest", "-q", "-p", "no:cacheprovider", cwd=tmp_path)
    assert "1 passed" in result.stdout, result.stdout + result.stderr
