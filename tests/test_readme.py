"""README and manual: examples run as they stand, tables are those of the registries, links lead to files.

The example that drives the editor runs in `test_wheel`; the manual in the window is in `gui/test_manual`.
"""

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
FILES = "resources/manual/07_files.md"
COMMAND_LINE = "resources/manual/08_command_line.md"


def text_of(name: str) -> str:
    return (ROOT / name).read_text(encoding="utf-8")


def blocks(section: str) -> list[str]:
    """Return the Python blocks of a section of the README."""
    text = text_of("README.md")
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
    ("name", "head", "rows"),
    [
        (FILES, "| ends in | | read | written |\n| --- | --- | --- | --- |\n", FORMAT_ROWS),
        ("README.md", "| family | its curves |\n| --- | --- |\n", FAMILY_ROWS),
    ],
    ids=["formats", "families"],
)
def test_a_table_is_that_of_the_registry(name, head, rows):
    """Where they differ, put the rows into the file as the failure shows them."""
    assert text_of(name).partition(head)[2].partition("\n\n")[0].split("\n") == rows


def test_the_manual_has_every_option_of_the_command_line_and_no_other(capsys):
    block = text_of(COMMAND_LINE).partition("```text\n")[2].partition("```")[0]
    named, known = set(re.findall(r"--[a-z-]+", block)), {"--help", "--output", "--no-points"}
    for command in ("render", "convert", "info", "lesson"):
        assert f"curvebench {command}" in block
        with pytest.raises(SystemExit):
            main([command, "--help"])
        options = set(re.findall(r"^ +(?:-\w[^-]*)?(--[a-z-]+)", capsys.readouterr().out, re.MULTILINE))
        assert options - named - known == set(), command
        known |= options
    assert named - known == set()
    short = text_of("README.md").partition("```text\n")[2].partition("```")[0]
    assert set(re.findall(r"--[a-z-]+", short)) - known == set()
    assert set(re.findall(r"curvebench \w+", short)) == set(re.findall(r"curvebench \w+", block))


def test_keys_and_menus_of_the_readme_are_those_of_the_actions():
    text = text_of("README.md")
    keys = {key for each in all_actions() for key in each.key.split(", ")}
    quoted = set(re.findall("<kbd>(.*?)</kbd>", text))
    assert len(quoted) > 5
    assert quoted - keys == {"Enter"}
    entries = {
        " › ".join(filter(None, (each.section.menu.title, each.section.submenu, each.text))): each.key
        for each in all_actions()
    }
    menus = {entry.rpartition(" › ")[0] for entry in entries}
    paths = re.findall(r"\*([^*\n]+ [›>] [^*\n]+)\*(?:\s\(<kbd>(.+?)</kbd>\))?", text)
    assert len(paths) > 4
    assert {path for path, _key in paths} - entries.keys() - menus == set()
    assert all(key in ("", *entries[path].split(", ")) for path, key in paths if path in entries)


def test_every_link_of_readme_and_contributing_leads_to_a_file():
    for name in ("README.md", "CONTRIBUTING.md"):
        for link in re.findall(r"\]\(([^)#]+)", text_of(name)):
            assert (ROOT / link).exists(), f"{link} in {name}"


def test_the_readme_lists_the_pages_of_the_manual():
    pages = {path.name: path.read_text("utf-8") for path in sorted((ROOT / "resources/manual").iterdir())}
    titles = {name: text.partition("\n")[0].removeprefix("# ") for name, text in pages.items()}
    listed = re.findall(r"\[([^\]]+)\]\(resources/manual/(\w+\.md)\)", text_of("README.md"))
    assert [(title, name) for name, title in titles.items()] == listed


@pytest.mark.parametrize("name", ["README.md", "CONTRIBUTING.md"])
def test_a_page_is_at_most_9000_bytes_long(name):
    assert len(text_of(name).encode()) <= 9000


def test_the_vocabulary_has_forty_distinct_words():
    rows = text_of("CONTRIBUTING.md").partition("| word | meaning |\n| --- | --- |\n")[2].partition("\n\n")[0]
    words = [word.strip() for row in rows.split("\n") for word in row.split("|")[1].split(",")]
    assert len(words) == len(set(words))
    assert 20 < len(words) <= 40


def test_files_and_names_in_contributing_exist():
    text = text_of("CONTRIBUTING.md")
    quotes = {quote for quote in re.findall("`([^`\n]+)`", text) if "NAME" not in quote and "…" not in quote}
    paths = {quote for quote in quotes if re.match(r"(app|curvecore|tests|resources)/", quote)}
    assert len(paths) > 20
    assert {
        path for path in paths if not list(ROOT.glob(path.replace("NN_name", "05_*").rstrip("/")))
    } == set()
    sources = [
        path.read_text("utf-8") for path in [*ROOT.glob("app/**/*.py"), *ROOT.glob("curvecore/**/*.py")]
    ]
    defined = set(re.findall(r"\b(?:class|def) (\w+)", "\n".join(sources)))
    (walk,) = re.findall(r"```text\n(press.*?)```", text, re.DOTALL)
    is_name = re.compile(r"[A-Z][a-z]\w+(?:\.[a-z]\w+)?|\w+\(.*\)")
    names = {quote.partition("(")[0] for quote in quotes if is_name.fullmatch(quote)}
    names |= set(re.findall(r"\b[A-Z][a-z]\w+(?:\.\w+)?", walk)) - {"Escape"}
    assert len(set(re.findall(r"\b[A-Z][a-z]\w+", walk)) - {"Escape"}) <= 9
    for name in names:
        assert set(name.split(".")) <= defined, name


def test_test_files_that_docstrings_name_exist():
    files = {path.name for path in ROOT.glob("tests/**/*.py")}
    for path in [*ROOT.glob("app/**/*.py"), *ROOT.glob("curvecore/**/*.py")]:
        text = path.read_text("utf-8")
        assert set(re.findall(r"\btest_\w+\.py\b", text)) <= files, path
        assert all((ROOT / name).exists() for name in re.findall(r"\btests/[\w/]+\.py\b", text)), path


def test_the_core_example_prints_the_stated_sum(tmp_path):
    (example,) = blocks("Library")
    result = run("-W", "error", "-c", example, cwd=tmp_path)
    assert result.returncode == 0, result.stderr
    # The position functions sum to one, to a few roundings.
    assert abs(float(result.stdout.split()[-1]) - 1) < 1e-14
