"""All curve families, in the order of menus."""

from __future__ import annotations

import copyreg
import sys
from collections.abc import Iterable, Iterator, Sequence
from importlib import import_module
from pathlib import Path
from pkgutil import iter_modules
from typing import overload

import curvecore.families
from curvecore import HermiteCurve, LagrangeCurve, QuinticHermiteCurve

from .family import Family, families_of_module, may_be_name

GROUP = "curvebench.families"
"""Entry points under which installed packages bring families: ``name = "package.module:CurveClass"``."""


class Families(Sequence[Family]):
    """The families of the core, then those of installed packages, then those of files.

    All of them are imported when somebody asks for more than the first known ones.

    Parameters
    ----------
    built_in
        The families of the core.
    known
        Those among them that are known without the others.

    Attributes
    ----------
    problems
        A sentence on each family of an installed package that is left out.
    files
        The families that each file has brought since it is in use, those among them that it has no longer.
    """

    def __init__(self, built_in: Iterable[Family], known: Iterable[Family] = ()) -> None:
        self._built_in: Iterable[Family] | None = built_in
        self._families: list[Family] = []
        self._known = {family.name: family for family in known}
        self.problems: list[str] = []
        self.files: dict[Path, tuple[Family, ...]] = {}

    @overload
    def __getitem__(self, index: int) -> Family: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[Family]: ...
    def __getitem__(self, index: int | slice) -> Family | Sequence[Family]:
        return self._all[index]

    def __len__(self) -> int:
        return len(self._all)

    def named(self, name: str) -> Family:
        """Return the family of that name; one that is missing where there is none."""
        if name not in self._known:
            self._complete()
        return self._known.setdefault(name, Family(name, None))

    def called(self, words: str) -> Family | None:
        """Return the family whose name or title these words are, in small or capital letters; else None."""
        wanted = _plain(words)
        for family in self:
            if wanted in map(_plain, (family.name, family.title, family.full_title)):
                return family
        return None

    def add(self, family: Family) -> None:
        """Append a family.

        Raises
        ------
        ValueError
            If there is one of that name, or the name is no short identifier.
        """
        if not may_be_name(family.name):
            raise ValueError(f"“{family.name}” is not a valid name of a family, such as quintic_hermite")
        if family in self:
            raise ValueError(f"a family named “{family.name}” already exists")
        known = self._known.setdefault(family.name, family)
        known.become(family)
        self._all.append(known)

    def remove(self, family: Family) -> None:
        """Remove a family from the offered ones; its curves stay."""
        self._all.remove(family)

    @property
    def _all(self) -> list[Family]:
        self._complete()
        return self._families

    def _complete(self) -> None:
        if self._built_in is not None:
            # Not before somebody asks: a package's curves are written with what imports this.
            self._families = list(self._built_in)
            self._built_in = None
            self._known |= {family.name: family for family in self._families}
            for family in self._installed():
                try:
                    self.add(family)
                except ValueError as problem:
                    self.problems.append(f"A family of an installed package is left out: {problem}.")

    def _installed(self) -> Iterator[Family]:
        if not _any_package_brings_families():
            return
        from importlib.metadata import entry_points  # noqa: PLC0415 - 17 ms, rarely needed

        for entry in entry_points(group=GROUP):
            try:
                yield Family.of(entry.load())
            except Exception as problem:
                self.problems.append(f"The family “{entry.name}” of an installed package failed: {problem}.")


def _plain(words: str) -> str:
    return " ".join(words.casefold().replace("_", " ").replace("-", " ").split())


def _any_package_brings_families() -> bool:
    """Return whether `entry_points` would find any; reading the files is ten times as quick."""
    return any(
        f"[{GROUP}]" in path.read_text(encoding="utf-8", errors="replace")
        for folder in dict.fromkeys(sys.path)
        if folder and Path(folder).is_dir()
        for path in Path(folder).glob("*-info/entry_points.txt")
    )


def _of_the_core() -> Iterator[Family]:
    """Yield the families of the core by rank: each is a file of its own."""
    classes = [
        curve_class
        for file in iter_modules(curvecore.families.__path__)
        for curve_class in families_of_module(import_module(f"curvecore.families.{file.name}"))
    ]
    known = {family.name: family for family in _KNOWN}
    for curve_class in sorted(classes, key=lambda curve_class: (curve_class.rank, curve_class.name)):
        yield known.get(str(curve_class.name)) or Family.of(curve_class)


LAGRANGE, HERMITE, QUINTIC_HERMITE = _KNOWN = tuple(
    Family.of(curve_class) for curve_class in (LagrangeCurve, HermiteCurve, QuinticHermiteCurve)
)
FAMILIES = Families(_of_the_core(), _KNOWN)


def family_named(name: str) -> Family:
    """Return the family of that name; one that is missing where there is none."""
    return FAMILIES.named(name)


def titles(families: Iterable[Family]) -> str:
    """Return families as a list of choices: Lagrange, Hermite or quintic Hermite."""
    *first, last = (family.title for family in families)
    return f"{', '.join(first)} or {last}" if first else last


def titles_with_derivatives() -> str:
    """Return the families whose points carry derivatives, as a list of choices."""
    return titles(family for family in FAMILIES if family.derivatives)


# What comes back from a pickle is the family as it is known there.
copyreg.pickle(Family, lambda family: (family_named, (family.name,)))
