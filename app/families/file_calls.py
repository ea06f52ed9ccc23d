"""Calls of the functions of a family's file: each ends in time, and its mistakes name their line.

A window is not to wait for functions of which nobody knows whether they end. There they have a moment; a call
that takes longer is stopped, is made in a process of its own (`Patience.overdue` sees to that), and from then
on functions of so many points have the time that they took there, or are refused for good.
"""

from __future__ import annotations

import inspect
import traceback
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

import msgspec
import numpy as np
import numpy.typing as npt
from msgspec.structs import replace

from curvecore import CurveError
from curvecore.arrays import FloatArray
from curvecore.families.setting import SettingValue

from .family import OverdueCallError
from .time_limit import OverdueError, stopped_after

CALL_SECONDS = 5.0
"""Seconds that functions of a file may take at a time where nobody waits for a window."""

ARGUMENTS = ("t", "parameters", "order")
"""The arguments of a file's functions that are no settings."""

_MOST_KNOWN = 100

Function = Callable[..., npt.ArrayLike]

Kind = tuple[int, frozenset[tuple[str, SettingValue]]]
"""The number of points, and values of settings."""


class Call(msgspec.Struct, frozen=True, eq=False):
    """A call of a function of a file.

    Attributes
    ----------
    calls
        The others of the same family.
    parameters, settings
        Of the curve that it is made for.
    words
        That it took too long, and where; empty until it has.
    """

    calls: FileCalls
    parameters: FloatArray
    settings: dict[str, SettingValue]
    words: str = ""

    @property
    def kind(self) -> Kind:
        """The calls that end if this one does, as far as anybody knows."""
        return len(self.parameters), frozenset(self.settings.items())


class Patience:
    """Time that this process has for functions of files.

    Attributes
    ----------
    seconds
        That a call may take.
    overdue
        Called with each call that another process has to make; None where there is no such process.
    """

    def __init__(self) -> None:
        self.seconds = CALL_SECONDS
        self.overdue: Callable[[Call], object] | None = None

    def of_a_window(self, seconds: float, overdue: Callable[[Call], object]) -> None:
        """Have so many seconds, and another process for what takes longer."""
        self.seconds, self.overdue = seconds, overdue

    def of_no_window(self) -> None:
        """Have the time of a process without windows."""
        self.seconds, self.overdue = CALL_SECONDS, None

    @contextmanager
    def as_at_the_start(self) -> Iterator[None]:
        """Have the time of a process without windows for a while, for what has ended in such a one."""
        before = self.seconds, self.overdue
        self.of_no_window()
        try:
            yield
        finally:
            self.seconds, self.overdue = before


PATIENCE = Patience()


class FileCalls:
    """The calls of one family's functions in a file.

    Attributes
    ----------
    path
        The file.
    name, title
        Of the family, for documents and for people.
    """

    def __init__(self, path: Path, name: str, title: str) -> None:
        self.path, self.name, self.title = path, name, title
        # Seconds that are known to do, and why there is no curve.
        self._seconds: dict[Kind, float] = {}
        self._refusals: dict[Kind, OverdueCallError] = {}
        # What was answered, of late: where it is asked again, that ends as well.
        self._answered: dict[tuple[Kind, bytes], None] = {}

    def told(self, function: Function) -> Function:
        """Return a function of the file whose errors are refusals that name their line.

        It takes t, parameters and order, or parameters alone, in this order, and settings by their names.
        """
        takes = inspect.signature(function).parameters

        def told(*arguments: object, **settings: SettingValue) -> npt.ArrayLike:
            # By their names: who writes the function orders them as it suits.
            named: dict[str, object] = {name: settings[name] for name in settings if name in takes}
            named |= zip(ARGUMENTS[2:], arguments[2:], strict=False)
            parameters = np.asarray(arguments[min(len(arguments) - 1, 1)], dtype=float)
            call = Call(self, parameters, settings)
            return self._made(call, lambda: function(*arguments[:2], **named))

        return told

    def _made(self, call: Call, make: Callable[[], npt.ArrayLike]) -> npt.ArrayLike:
        kind = call.kind
        key = kind, call.parameters.tobytes()
        if kind in self._refusals and key not in self._answered:
            # Once is enough to wait for: it is asked again for every frame.
            raise self._refusals[kind]
        # What is asked next most likely is what was asked last.
        self._answered.pop(key, None)
        seconds = max(self._seconds.get(kind, 0.0), PATIENCE.seconds)
        try:
            with stopped_after(seconds):
                found = make()
        except OverdueError as problem:
            raise self._refuse_overdue(call, problem, seconds) from problem
        except BaseException as problem:  # sys.exit, too, is a mistake there
            raise CurveError(f"{self._place(problem)}: {words(problem)}") from problem
        self._answered[key] = None
        if len(self._answered) > _MOST_KNOWN:
            del self._answered[next(iter(self._answered))]
        return found

    def _refuse_overdue(self, call: Call, problem: OverdueError, seconds: float) -> OverdueCallError:
        """Return the refusal of such curves, for good or until another process has answered."""
        asks = PATIENCE.overdue if call.kind not in self._seconds else None
        which = f"{self._place(problem)}: the family “{self.title}”"
        points = f"for {len(call.parameters)} points"
        if asks is None:
            self.refuse(call.kind, f"{which} ran for longer than {seconds:g} s {points} and was stopped")
        else:
            call = replace(call, words=f"{which} takes long {points}")
            self.refuse(call.kind, f"{call.words} and is tried beside the window")
            asks(call)
        return self._refusals[call.kind]

    def _place(self, problem: BaseException) -> str:
        return f"“{self.path.name}”{line_of(problem, self.path)}"

    def allow(self, kind: Kind, seconds: float) -> None:
        """Give such calls the time that one took elsewhere."""
        self._refusals.pop(kind, None)
        self._seconds[kind] = min(seconds, CALL_SECONDS)

    def refuse(self, kind: Kind, text: str) -> None:
        """Make no such curves any more; `text` says why."""
        self._refusals[kind] = OverdueCallError(text)


def line_of(problem: BaseException, path: Path) -> str:
    """Return the last line of the file that an error came through."""
    frames = traceback.extract_tb(problem.__traceback__)
    lines = [frame.lineno for frame in frames if frame.filename == str(path)]
    return f", line {lines[-1]}" if lines else ""


def words(problem: BaseException) -> str:
    """Return what is wrong, as a clause."""
    text = str(problem).rstrip(".")
    if isinstance(problem, (CurveError, OverdueError)):
        return text
    return f"{type(problem).__name__}: {text}" if text else type(problem).__name__
