"""Size and words of the program: files, lines, classes, docstrings that are riddles, names that say nothing.

    python -m tests.count_house [--by-package] [--list docstrings|names [PACKAGE]]

Counted are `app` and `curvecore`. A line of code is one that is left without blanks, comments, docstrings and
imports. The words are a symptom, not a limit: no test compares these numbers with anything.
"""

from __future__ import annotations

import argparse
import ast
import io
import re
import tokenize
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

_ROOT = Path(__file__).parents[1]
_PACKAGES = ("curvecore", "app")

VAGUE = frozenset(
    {"place", "places", "told", "shown", "seen", "found", "taken", "kept", "own", "meant", "each", "way"}
    | {"ways", "chosen", "edited", "lit", "made", "said"}
)
"""Words that name nothing when a variable, parameter or function is called by them."""

_HEADLESS = re.compile(r"\bwhat\b", re.IGNORECASE)
_RIDDLE = re.compile(
    r"^(What|Whose|Who|Where|How|When|Of|That of|Those|Whether (it|they|that|this|there|one))\b"
    r"|^(Return|Yield|Tell|Say|Have|Give|Take) (what|where|who|whose|how|that of|those)\b"
    r"|\btoo\.$"
)


class Docstring(NamedTuple):
    """The first line of a docstring, with the file and line of its owner."""

    file: str
    line: int
    text: str

    @property
    def is_headless(self) -> bool:
        """Whether “what” stands in it where a noun should."""
        return _HEADLESS.search(self.text) is not None

    @property
    def is_riddle(self) -> bool:
        """Whether it begins with a relative clause or a pronoun, or ends with “too”."""
        return _RIDDLE.search(self.text) is not None


class Name(NamedTuple):
    """A name that some code binds, with its file and line."""

    file: str
    line: int
    text: str

    @property
    def is_vague(self) -> bool:
        """Whether one of its words is in `VAGUE`."""
        return not VAGUE.isdisjoint(self.text.lower().split("_"))


class Module(NamedTuple):
    """A file of the program and what was counted in it."""

    file: str
    lines: int
    code: int
    classes: int
    docstrings: list[Docstring]
    names: list[Name]

    @property
    def package(self) -> str:
        """The package: `curvecore`, or one of those in `app`, its features one by one."""
        parts = self.file.split("/")[:-1]
        return "/".join(parts[: 3 if parts[1:2] == ["features"] else 2 if parts[0] == "app" else 1])


class Total(NamedTuple):
    """Sums over modules."""

    files: int
    lines: int
    code: int
    classes: int
    headless: int
    riddles: int
    vague: int


def modules() -> Iterator[Module]:
    """Yield the modules of the program."""
    for package in _PACKAGES:
        for path in sorted((_ROOT / package).rglob("*.py")):
            yield _module(path)


def _module(path: Path) -> Module:
    source, file = path.read_text(encoding="utf-8"), path.relative_to(_ROOT).as_posix()
    tree = ast.parse(source)
    return Module(
        file,
        source.count("\n"),
        _code_lines(source, tree),
        sum(isinstance(node, ast.ClassDef) for node in ast.walk(tree)),
        [Docstring(file, line, text) for line, text in _docstrings(tree)],
        [Name(file, line, text) for line, text in _names(tree)],
    )


def _docstrings(tree: ast.Module) -> Iterator[tuple[int, str]]:
    for node in ast.walk(tree):
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef):
            text = ast.get_docstring(node)
            if text:
                yield getattr(node, "lineno", 1), text.partition("\n")[0]


def _names(tree: ast.Module) -> Iterator[tuple[int, str]]:
    """Yield the names of functions, parameters, variables and attributes where they are bound."""
    for node in ast.walk(tree):
        match node:
            case ast.FunctionDef(name=text) | ast.ClassDef(name=text) | ast.arg(arg=text):
                yield node.lineno, text
            case ast.Name(id=text, ctx=ast.Store()) | ast.Attribute(attr=text, ctx=ast.Store()):
                yield node.lineno, text
            case ast.AsyncFunctionDef(name=text):
                yield node.lineno, text


def _code_lines(source: str, tree: ast.Module) -> int:
    left_out: set[int] = set()
    for node in ast.walk(tree):
        is_text = (
            isinstance(node, ast.Expr)
            and isinstance(node.value, ast.Constant)
            and isinstance(node.value.value, str)
        )
        if is_text or isinstance(node, ast.Import | ast.ImportFrom):
            left_out.update(range(node.lineno, (node.end_lineno or node.lineno) + 1))
    lines: set[int] = set()
    for token in tokenize.generate_tokens(io.StringIO(source).readline):
        if token.type not in _NO_CODE:
            lines.update(range(token.start[0], token.end[0] + 1))
    return len(lines - left_out)


_NO_CODE = {
    tokenize.COMMENT,
    tokenize.NL,
    tokenize.NEWLINE,
    tokenize.INDENT,
    tokenize.DEDENT,
    tokenize.ENDMARKER,
}


def total(counted: list[Module]) -> Total:
    """Return the sums over modules."""
    docstrings = [text for module in counted for text in module.docstrings]
    return Total(
        len(counted),
        sum(module.lines for module in counted),
        sum(module.code for module in counted),
        sum(module.classes for module in counted),
        sum(text.is_headless for text in docstrings),
        sum(text.is_riddle for text in docstrings),
        sum(name.is_vague for module in counted for name in module.names),
    )


def _row(name: str, sums: Total) -> str:
    return f"{name:32}" + "".join(f"{number:9}" for number in sums)


def main() -> None:
    """Count and print."""
    parser = argparse.ArgumentParser(description="Count the size and the words of the program.")
    parser.add_argument("--by-package", action="store_true", help="print a row for each package")
    parser.add_argument("--list", choices=("docstrings", "names"), help="print those that are counted")
    parser.add_argument("package", nargs="?", default="", help="only packages that begin with this")
    arguments = parser.parse_args()
    counted = [module for module in modules() if module.package.startswith(arguments.package)]
    if arguments.list == "docstrings":
        for text in (text for module in counted for text in module.docstrings):
            if text.is_headless or text.is_riddle:
                print(f"{text.file}:{text.line}: {text.text}")
    if arguments.list == "names":
        for name in (name for module in counted for name in module.names if name.is_vague):
            print(f"{name.file}:{name.line}: {name.text}")
    print(" " * 32 + "".join(f"{field:>9}" for field in Total._fields))
    if arguments.by_package:
        packages = {module.package for module in counted}
        for package in sorted(packages):
            print(_row(package, total([module for module in counted if module.package == package])))
    print(_row("all", total(counted)))
    words = Counter(
        word
        for module in counted
        for name in module.names
        for word in name.text.lower().split("_")
        if word in VAGUE
    )
    print("names with", ", ".join(f"{word} {number}" for word, number in words.most_common()))


if __name__ == "__main__":
    main()
