"""The README's examples run as they stand; the one that drives the editor in `test_wheel`."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from app.cli.command_line import main
from app.exchange.formats import FORMATS
from app.families import FAMILIES
from app.window.connect import all_actions

ROOT = Path(__file__).parents[1]


def blocks(section: str) -> list[str]:
    """Return the Python blocks of a section."""
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    body = text.split(f"## {section}\n", 1)[1].split("\n## ", 1)[0]
    return re.findall(r"```python\n(.*?)```", body, re.DOTALL)


def run(*command: str, cwd: Path) -> subprocess.CompletedProcess[str]:
    """Run Python in `cwd` with this checkout on its path."""
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    return subprocess.run(
        [sys.executable, *command], cwd=cwd, env=environment, capture_output=True, text=True, check=False
    )


FORMAT_ROWS = [
    f"| {', '.join(f'`{ending}`' for ending in each.endings)} | {each.title} "
    f"| {'yes' if each.kind else ''} | {'yes' if each.write else ''} |"
    for each in FORMATS
]
FAMILY_ROWS = [
    f"| {each.full_title[:1].upper()}{each.full_title[1:]} | {each.tip} |"
    for each in FAMILIES
    if each.is_built_in
]


@pytest.mark.parametrize(
    ("head", "rows"),
    [
        ("| ends in | | read | written |\n| --- | --- | --- | --- |\n", FORMAT_ROWS),
        ("| family | its curves |\n| --- | --- |\n", FAMILY_ROWS),
    ],
    ids=["formats", "families"],
)
def test_a_table_is_that_of_the_registry(head, rows):
    """Where they differ, put the rows into the README as the failure shows them."""
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    assert text.partition(head)[2].partition("\n\n")[0].split("\n") == rows


def test_every_option_of_the_command_line_is_named_and_no_other(capsys):
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    block = text.partition("```text\n")[2].partition("```")[0]
    named, known = set(re.findall(r"--[a-z-]+", block)), {"--help", "--output", "--no-points"}
    for command in ("render", "convert", "info", "lesson"):
        assert f"curvebench {command}" in block
        with pytest.raises(SystemExit):
            main([command, "--help"])
        options = set(re.findall(r"^ +(?:-\w[^-]*)?(--[a-z-]+)", capsys.readouterr().out, re.MULTILINE))
        assert options - named - known == set(), command
        known |= options
    assert named - known == set()


def test_keys_and_menus_are_those_of_the_actions():
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    known = {(key, each.text.removesuffix("…")) for each in all_actions() for key in each.key.split(", ")}
    rows = re.findall(r"^\| (<kbd>.*) \| (.*) \|$", text, re.MULTILINE)
    assert len(rows) > 5
    for keys, names in rows:
        pairs = zip(re.findall("<kbd>(.*?)</kbd>", keys), names.split(", "), strict=True)
        assert set(pairs) - known == set()
    entries = {
        " › ".join(filter(None, (each.section.menu.title, each.section.submenu, each.text)))
        for each in all_actions()
    }
    menus = {entry.rpartition(" › ")[0] for entry in entries}
    paths = set(re.findall(r"\*((?:File|Edit|Curve|Points|Arrange|Analysis|View|Help) [›>] [^*]+)\*", text))
    assert len(paths) > 4
    assert paths - entries - menus == set()


def test_the_core_example_prints_what_it_says(tmp_path):
    (example,) = blocks("The core as a library")
    result = run("-W", "error", "-c", example, cwd=tmp_path)
    assert result.returncode == 0, result.stderr
    # The position functions sum to one, to a few roundings.
    assert abs(float(result.stdout.split()[-1]) - 1) < 1e-14
