"""Curve families that a person wrote in a file of Python, checked before they are used.

The least that such a file says::

    name = "gaussian"                  # what documents store

    def basis(t, parameters):          # t (m,), parameters (n,) ascending -> (m, n)
        ...

Where `B_i(t_j)` is not 1 for i = j and 0 else, the curve misses its points; that is measured and told, unless
the file says so itself. It may say more: ``title``, what people read; ``basis(t, parameters, order)`` for
derivatives, which else are differences; ``breaks(parameters)``, where they jump; ``interpolates = False``
where the curve is meant to pass its points by, ``can_close = True`` where a curve whose last point is its
first goes on smoothly there; a docstring: its first line says what its curves are; ``settings``, a list of
`FamilySetting`, whose values those functions get by name that take them: ``basis(t, parameters, width)``.
Classes derived from `curvecore.ParametricCurve` with a name are families, too.
"""

from __future__ import annotations

import inspect
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from curvecore import (
    BasisCurve,
    FamilySetting,
    ParametricCurve,
    Scheme,
    cardinal_defect,
    chebyshev,
    uniform,
)
from curvecore.arrays import FloatArray

from .family import Family, families_of_module, may_be_name
from .file_calls import ARGUMENTS, PATIENCE, FileCalls, Function, line_of, words
from .registry import Families
from .time_limit import stopped_after

_MODULE = "curvebench_families_of_a_file"
_COUNTS = (2, 3, 4, 7)

RUN_SECONDS = 8.0
"""Seconds that a file may run."""

_FACTS = {"title": str, "interpolates": bool, "can_close": bool}
"""The names that a file may define beside its functions, and their types."""


class FamilyFileError(ValueError):
    """A file holds no family that works; the text names the file, the line and what is wrong."""


@contextmanager
def families_of_files(families: Families, paths: Sequence[str]) -> Iterator[None]:
    """Have the families of files for a while: all of them or, where one is refused, none.

    Raises
    ------
    FamilyFileError
        If a file cannot be read or run, or what it says makes no curve.
    """
    used = [Path(path) for path in paths]
    try:
        for path in used:
            use_file(families, path)
        yield
    finally:
        for path in used:
            forget_file(families, path)


def use_file(families: Families, path: Path) -> frozenset[Family]:
    """Run a file, have its families in place of those that it had before, and return all of both.

    Curves of a family that it has no longer go on with the functions that there were.

    Raises
    ------
    FamilyFileError
        If it cannot be read or run, or what it says makes no curve; everything is as it was then.
    """
    found, before = families_in(path), families.files.get(path.absolute(), ())
    taken = [each for each in found if (each in families and each not in before) or found.count(each) > 1]
    if taken:
        raise FamilyFileError(f"“{path}”: there is a family “{taken[0].name}” already.")
    for family in before:
        if family in families:
            families.remove(family)
    for family in found:
        families.add(family)
    mine = dict.fromkeys((*before, *found))
    families.files[path.absolute()] = tuple(families.named(each.name) for each in mine)
    return frozenset(mine)


def forget_file(families: Families, path: Path) -> frozenset[Family]:
    """Forget the families of a file, and return them."""
    gone = families.files.pop(path.absolute(), ())
    for family in gone:
        if family in families:
            families.remove(family)
        # Documents that name it have it no longer, either.
        family.become(Family(family.name, None))
    return frozenset(gone)


def families_in(path: Path) -> list[Family]:
    """Return the families that the file at `path` defines, at least one."""
    module = _run(path)
    said = vars(module)
    found = {each: each.basis for each in families_of_module(module)}
    if "basis" in said:
        found[_class_of(said, path)] = said["basis"]
    if not found:
        raise FamilyFileError(
            f"“{path}” defines no family: it needs a name and a function basis(t, parameters)."
        )
    with PATIENCE.as_at_the_start():
        return [_tried(curve_class, path, _first_line(basis)) for curve_class, basis in found.items()]


def _run(path: Path) -> ModuleType:
    """Run the file as a module of its own; no compiled copy is left beside it."""
    module = ModuleType(_MODULE)
    module.__file__ = str(path)
    # Where dataclasses and the like look for the module of a class.
    sys.modules[_MODULE] = module
    try:
        code = compile(path.read_bytes(), str(path), "exec")
        with stopped_after(RUN_SECONDS):
            exec(code, vars(module))
    except OSError as problem:
        raise FamilyFileError(f"“{path}” cannot be read: {problem.strerror}.") from None
    except SyntaxError as problem:
        raise FamilyFileError(f"“{path}”, line {problem.lineno or 1}: {problem.msg}.") from None
    except BaseException as problem:  # sys.exit, too, is a mistake there
        raise FamilyFileError(f"“{path}”{line_of(problem, path)}: {words(problem)}.") from None
    finally:
        del sys.modules[_MODULE]
    return module


def _class_of(said: dict[str, Any], path: Path) -> type[ParametricCurve]:
    """Return the curve class of a file's functions."""
    name, basis, breaks = said.get("name"), said["basis"], said.get("breaks")
    if not (isinstance(name, str) and may_be_name(name)):
        raise FamilyFileError(f"“{path}” must say its name, a short word as in name = “gaussian”.")
    for what, value in (("basis", basis), *([("breaks", breaks)] if breaks is not None else [])):
        if not callable(value):
            raise FamilyFileError(f"“{path}”: {what} must be a function, not {value!r}.")
    for what, kind in _FACTS.items():
        if what in said and not isinstance(said[what], kind):
            raise FamilyFileError(f"“{path}”: {what} must be {kind.__name__}, not {said[what]!r}.")
    has_orders = "order" in inspect.signature(basis).parameters
    settings = _settings_of(said, [basis, *([breaks] if breaks is not None else [])], path)
    facts = {what: said[what] for what in _FACTS if what in said}
    calls = FileCalls(path, name, str(facts.get("title", name)))
    scheme = Scheme(name, calls.told(basis), calls.told(breaks) if breaks else None, has_orders)
    doc = inspect.getdoc(basis) if said.get("__doc__") is None else inspect.cleandoc(said["__doc__"])
    own = {"name": name, "settings": settings, "scheme": scheme, "__slots__": (), "__doc__": doc}
    return type("FileCurve", (BasisCurve,), {"title": name, **facts, **own})


def _settings_of(
    said: dict[str, Any], functions: Sequence[Function], path: Path
) -> tuple[FamilySetting, ...]:
    """Return the settings that a file lists, each of which one of its functions takes."""
    listed = said.get("settings", ())
    settings = tuple(listed) if isinstance(listed, list | tuple) else (listed,)
    taken = {name for function in functions for name in inspect.signature(function).parameters}
    for setting in settings:
        if not isinstance(setting, FamilySetting):
            raise FamilyFileError(f"“{path}”: settings must be a list of FamilySetting, not of {setting!r}.")
        if not setting.allows(setting.default):
            needed, default = setting.requirement, setting.default
            raise FamilyFileError(
                f"“{path}”: the default of the setting “{setting.name}” must be {needed}, not {default!r}."
            )
        if setting.name not in taken or setting.name in ARGUMENTS:
            raise FamilyFileError(
                f"“{path}”: no function takes the setting “{setting.name}”, "
                f"as basis(t, parameters, {setting.name}) would."
            )
    return settings


def _tried(curve_class: type[ParametricCurve], path: Path, line: str) -> Family:
    """Return the family of a class; raise FamilyFileError where it makes a curve that is not finite."""
    misses_points = False
    for parameters in _trials():
        jets = np.zeros((len(parameters), curve_class.derivatives + 1, 2))
        jets[:, 0] = np.stack([np.cos(3.0 * parameters), parameters], axis=1)
        places = np.linspace(parameters[0], parameters[-1], 12 * len(parameters))
        try:
            curve = curve_class.from_jets(jets, parameters)
            found = [curve.evaluate(places, order) for order in (0, 1, 2)]
        except BaseException as problem:
            own = problem.__cause__ or problem
            at = ", ".join(f"{t:g}" for t in parameters)
            raise FamilyFileError(
                f"“{path}”{line_of(own, path) or line}: {words(own)} (with the parameters {at})."
            ) from None
        if not all(np.isfinite(each).all() for each in found):
            raise FamilyFileError(f"“{path}”{line}: {curve_class.name} makes a curve that is not finite.")
        misses_points |= cardinal_defect(curve) is not None
    return Family.of(curve_class, misses_points=misses_points)


def _trials() -> Iterator[FloatArray]:
    for count in _COUNTS:
        yield uniform(count)
        yield 10.0 + 3.0 * chebyshev(count)
    yield np.array([0.0, 0.1, 0.5, 0.6, 1.0])


def _first_line(function: object) -> str:
    code = getattr(inspect.unwrap(function), "__code__", None) if callable(function) else None
    return f", line {code.co_firstlineno}" if code is not None else ""
