"""Docstrings of all public names: their sections, and their examples run."""

import ast
import doctest
import inspect
import re
from functools import cache
from importlib import import_module
from pathlib import Path

import pytest

import curvecore
from curvecore import calculus
from tests.rows import each_row

OBJECTS = {name: getattr(curvecore, name) for name in curvecore.__all__}
NAMES = {name: each for name, each in OBJECTS.items() if inspect.isclass(each) or inspect.isfunction(each)}


def methods_of(cls):
    """The public methods that a class brings; one that overrides another says what is different."""
    inherited = {name for base in cls.__mro__[1:] for name in vars(base)}
    for name, value in vars(cls).items():
        function = getattr(value, "__func__", value)
        if not name.startswith("_") and name not in inherited and inspect.isfunction(function):
            yield f"{cls.__name__}.{name}", function


DESCRIBED = {
    **NAMES,
    **{
        name: each
        for base in dict.fromkeys(
            base for cls in NAMES.values() if inspect.isclass(cls) for base in cls.__mro__
        )
        if base.__module__.startswith("curvecore")
        for name, each in methods_of(base)
    },
}


@cache
def sections_of(thing):
    """The sections of a numpydoc docstring by their titles; the first one's is empty."""
    parts = re.split(r"^([A-Z][A-Za-z ]+)\n-{3,}\n", inspect.getdoc(thing), flags=re.MULTILINE)
    return dict(zip(["", *parts[1::2]], parts[::2], strict=True))


def parameters_of(thing):
    """The names of the parameters of a function, or of the constructor of a class."""
    if not inspect.isclass(thing):
        return [name for name in inspect.signature(thing).parameters if name not in ("self", "cls")]
    if hasattr(thing, "_fields") or "__init__" not in vars(thing):
        return []
    return [name for name in inspect.signature(thing.__init__).parameters if name != "self"]


def described_in(section):
    """The names of which a section of parameters says something."""
    heads = re.findall(r"^\*{0,2}(\w[\w, *]*?)(?: : .*)?$", section, flags=re.MULTILINE)
    return {name.strip(" *") for head in heads for name in head.split(",")}


@pytest.mark.parametrize("package", [curvecore, calculus], ids=lambda each: each.__name__)
def test_the_exported_names_match_the_stub(package):
    """They are read from its lines, as one statement each."""
    stub = ast.parse(Path(package.__file__).with_suffix(".pyi").read_text(encoding="utf-8"))
    statements = [each for each in stub.body if isinstance(each, ast.ImportFrom)]
    assert sorted(alias.asname for each in statements for alias in each.names) == package.__all__
    for each in statements:
        (alias,) = each.names
        assert getattr(package, alias.name) is getattr(import_module(each.module), alias.name)


@each_row("name", NAMES)
def test_a_public_name_has_an_example_and_a_see_also(name):
    sections = sections_of(OBJECTS[name])
    assert ">>> " in sections.get("Examples", ""), "no example"
    assert sections.get("See Also"), "no See Also"


@each_row("name", DESCRIBED)
def test_arguments_and_results_are_described(name):
    thing = DESCRIBED[name]
    sections = sections_of(thing)
    missing = set(parameters_of(thing)) - described_in(sections.get("Parameters", ""))
    assert not missing, f"not in Parameters: {sorted(missing)}"
    assert " As for " not in sections.get("Parameters", ""), "described elsewhere"
    if inspect.isfunction(thing) and inspect.signature(thing).return_annotation not in (None, "None"):
        assert sections.get("Returns") or sections.get("Yields"), "no Returns"
    if hasattr(thing, "_fields"):
        assert set(thing._fields) <= described_in(sections.get("Attributes", "")), "not in Attributes"


@each_row("name", [*DESCRIBED, "curvecore"])
def test_examples_run(name):
    # A finder would look for the thing's module among all that are imported.
    text = DESCRIBED.get(name, curvecore).__doc__
    examples = doctest.DocTestParser().get_doctest(text, {}, name, filename=None, lineno=0)
    told = []
    failed, _ = doctest.DocTestRunner().run(examples, out=told.append)
    assert not failed, "".join(told)


@each_row("name", NAMES)
def test_names_in_docstrings_exist(name):
    """Names in See Also lines and in single quotes of `curvecore` itself."""
    section = sections_of(OBJECTS[name]).get("See Also", "")
    named = [
        each.strip()
        for head in re.findall(r"^(\w[\w., ]*?)(?: : .*)?$", section, re.MULTILINE)
        for each in head.split(",")
    ]
    assert named
    for each in named:
        first, *rest = each.split(".")
        thing = OBJECTS.get(first, getattr(OBJECTS[name], first, None))
        for part in rest:
            thing = getattr(thing, part, None)
        assert thing is not None, f"{each} is nowhere"
