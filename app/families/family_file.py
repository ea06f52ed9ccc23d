"""Curve families that a person wrote in a file of Python, checked before they are used.

The least that such a file defines::

    name = "gaussian"                  # what documents store

    def basis(t, parameters):          # t (m,), parameters (n,) ascending -> (m, n)
        ...

Where `B_i(t_j)` is not 1 for i = j and 0 else, the curve misses its points; that is measured and reported,
unless the file says so itself. It may define more:

- ``title``, the name that people read; a docstring, whose first line says what its curves are;
- ``basis(t, parameters, order)`` for derivatives, which are differences without it;
- ``breaks(parameters)``: the parameters at which derivatives jump;
- ``interpolates = False``, where the curve passes beside its points on purpose;
- ``can_close = True``, where a curve whose last point is its first is smooth there;
- ``settings``, a list of `FamilySetting`: functions get the values by name: ``basis(t, parameters, width)``.

Classes derived from `curvecore.ParametricCurve` with a name are families as well.
"""

from __future__ import annotations

import inspect
import signal
import sys
import threading
import time
import traceback
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from types import FrameType, ModuleType, TracebackType
from typing import Any

import msgspec
import numpy as np
import numpy.typing as npt
from msgspec.structs import replace

from curvecore import (
    BasisCurve,
    CurveError,
    FamilySetting,
    ParametricCurve,
    Scheme,
    cardinal_defect,
    chebyshev,
    uniform,
)
from curvecore.arrays import FloatArray
from curvecore.families.setting import SettingValue

from .family import Family, OverdueCallError, families_of_module, may_be_name
from .registry import Families

_MODULE = "curvebench_families_of_a_file"
_COUNTS = (2, 3, 4, 7)

RUN_SECONDS = 8.0
"""Seconds that a file may run."""

_FACTS = {"title": str, "interpolates": bool, "can_close": bool}
"""The names that a file may define beside its functions, and their types."""


class FamilyFileError(ValueError):
    """A file holds no family that works; the text names the file, the line and the mistake."""


@contextmanager
def families_of_files(families: Families, paths: Sequence[str]) -> Iterator[None]:
    """Context in which the families of files are available: all of them, or none if one is refused.

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
    """Run a file, replace its earlier families by the new ones, and return all of both.

    Curves of a family that it has no longer go on with the functions that there were.

    Raises
    ------
    FamilyFileError
        If it cannot be read or run, or what it says makes no curve; everything is as it was then.
    """
    new, before = families_in(path), families.files.get(path.absolute(), ())
    duplicates = [
        family for family in new if (family in families and family not in before) or new.count(family) > 1
    ]
    if duplicates:
        raise FamilyFileError(f"“{path}”: a family named “{duplicates[0].name}” already exists.")
    for family in before:
        if family in families:
            families.remove(family)
    for family in new:
        families.add(family)
    mine = dict.fromkeys((*before, *new))
    families.files[path.absolute()] = tuple(families.named(family.name) for family in mine)
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
    defined = vars(module)
    basis_of = {curve_class: curve_class.basis for curve_class in families_of_module(module)}
    if "basis" in defined:
        basis_of[_class_of(defined, path)] = defined["basis"]
    if not basis_of:
        raise FamilyFileError(
            f"“{path}” defines no family: it needs a name and a function basis(t, parameters)."
        )
    with PATIENCE.as_at_the_start():
        return [_tried(curve_class, path, _first_line(basis)) for curve_class, basis in basis_of.items()]


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
        raise FamilyFileError(f"“{path}”{line_of(problem, path)}: {mistake_text(problem)}.") from None
    finally:
        del sys.modules[_MODULE]
    return module


def _class_of(defined: dict[str, Any], path: Path) -> type[ParametricCurve]:
    """Return the curve class of a file's functions."""
    name, basis, breaks = defined.get("name"), defined["basis"], defined.get("breaks")
    if not (isinstance(name, str) and may_be_name(name)):
        raise FamilyFileError(f"“{path}” must define its name, a short word as in name = “gaussian”.")
    for what, value in (("basis", basis), *([("breaks", breaks)] if breaks is not None else [])):
        if not callable(value):
            raise FamilyFileError(f"“{path}”: {what} must be a function, not {value!r}.")
    for what, kind in _FACTS.items():
        if what in defined and not isinstance(defined[what], kind):
            raise FamilyFileError(f"“{path}”: {what} must be {kind.__name__}, not {defined[what]!r}.")
    has_orders = "order" in inspect.signature(basis).parameters
    settings = _settings_of(defined, [basis, *([breaks] if breaks is not None else [])], path)
    facts = {what: defined[what] for what in _FACTS if what in defined}
    calls = FileCalls(path, name, str(facts.get("title", name)))
    scheme = Scheme(name, calls.checked(basis), calls.checked(breaks) if breaks else None, has_orders)
    doc = inspect.getdoc(basis) if defined.get("__doc__") is None else inspect.cleandoc(defined["__doc__"])
    attributes = {"name": name, "settings": settings, "scheme": scheme, "__slots__": (), "__doc__": doc}
    return type("FileCurve", (BasisCurve,), {"title": name, **facts, **attributes})


def _settings_of(
    defined: dict[str, Any], functions: Sequence[Function], path: Path
) -> tuple[FamilySetting, ...]:
    """Return the settings that a file lists, each of which one of its functions takes."""
    listed = defined.get("settings", ())
    settings = tuple(listed) if isinstance(listed, list | tuple) else (listed,)
    arguments = {name for function in functions for name in inspect.signature(function).parameters}
    for setting in settings:
        if not isinstance(setting, FamilySetting):
            raise FamilyFileError(f"“{path}”: settings must be a list of FamilySetting, not of {setting!r}.")
        if not setting.allows(setting.default):
            needed, default = setting.requirement, setting.default
            raise FamilyFileError(
                f"“{path}”: the default of the setting “{setting.name}” must be {needed}, not {default!r}."
            )
        if setting.name not in arguments or setting.name in ARGUMENTS:
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
        samples = np.linspace(parameters[0], parameters[-1], 12 * len(parameters))
        try:
            curve = curve_class.from_jets(jets, parameters)
            evaluated = [curve.evaluate(samples, order) for order in (0, 1, 2)]
        except BaseException as problem:
            cause = problem.__cause__ or problem
            at = ", ".join(f"{t:g}" for t in parameters)
            raise FamilyFileError(
                f"“{path}”{line_of(cause, path) or line}: {mistake_text(cause)} (with the parameters {at})."
            ) from None
        if not all(np.isfinite(values).all() for values in evaluated):
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


# Calls of a file's functions
#
# A window does not wait for functions of which nobody knows whether they end. They have a moment; a call that
# takes longer is stopped and made in another process (`Patience.overdue`). From then on functions of so many
# points have the time that they took there, or are refused for good.

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
    message
        That it took too long, and where; empty until it has.
    """

    calls: FileCalls
    parameters: FloatArray
    settings: dict[str, SettingValue]
    message: str = ""

    @property
    def kind(self) -> Kind:
        """The number of points and the settings: calls of one kind take about as long."""
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
        """Allow calls so many seconds, and another process for longer ones."""
        self.seconds, self.overdue = seconds, overdue

    def of_no_window(self) -> None:
        """Allow calls the time of a process without windows."""
        self.seconds, self.overdue = CALL_SECONDS, None

    @contextmanager
    def as_at_the_start(self) -> Iterator[None]:
        """Allow the time of a process without windows for a while: the call has ended in such a process."""
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

    def checked(self, function: Function) -> Function:
        """Return a function of the file whose errors are refusals that name their line.

        It takes t, parameters and order, or parameters alone, in this order, and settings by their names.
        """
        takes = inspect.signature(function).parameters

        def checked(*arguments: object, **settings: SettingValue) -> npt.ArrayLike:
            # By their names: who writes the function orders them as it suits.
            named: dict[str, object] = {name: settings[name] for name in settings if name in takes}
            named |= zip(ARGUMENTS[2:], arguments[2:], strict=False)
            parameters = np.asarray(arguments[min(len(arguments) - 1, 1)], dtype=float)
            call = Call(self, parameters, settings)
            return self._result_of(call, lambda: function(*arguments[:2], **named))

        return checked

    def _result_of(self, call: Call, make: Callable[[], npt.ArrayLike]) -> npt.ArrayLike:
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
                result = make()
        except OverdueError as problem:
            raise self._refuse_overdue(call, problem, seconds) from problem
        except BaseException as problem:  # sys.exit, too, is a mistake there
            raise CurveError(f"{self._position(problem)}: {mistake_text(problem)}") from problem
        self._answered[key] = None
        if len(self._answered) > _MOST_KNOWN:
            del self._answered[next(iter(self._answered))]
        return result

    def _refuse_overdue(self, call: Call, problem: OverdueError, seconds: float) -> OverdueCallError:
        """Return the refusal of such curves, for good or until another process has answered."""
        asks = PATIENCE.overdue if call.kind not in self._seconds else None
        which = f"{self._position(problem)}: the family “{self.title}”"
        points = f"for {len(call.parameters)} points"
        if asks is None:
            self.refuse(call.kind, f"{which} ran for longer than {seconds:g} s {points} and was stopped")
        else:
            call = replace(call, message=f"{which} takes long {points}")
            self.refuse(call.kind, f"{call.message} and is tried in the background")
            asks(call)
        return self._refusals[call.kind]

    def _position(self, problem: BaseException) -> str:
        return f"“{self.path.name}”{line_of(problem, self.path)}"

    def allow(self, kind: Kind, seconds: float) -> None:
        """Allow such calls the time that one took in another process."""
        self._refusals.pop(kind, None)
        self._seconds[kind] = min(seconds, CALL_SECONDS)

    def refuse(self, kind: Kind, text: str) -> None:
        """Refuse such curves from now on; `text` says why."""
        self._refusals[kind] = OverdueCallError(text)


def line_of(problem: BaseException, path: Path) -> str:
    """Return the last line of the file that an error came through."""
    frames = traceback.extract_tb(problem.__traceback__)
    lines = [frame.lineno for frame in frames if frame.filename == str(path)]
    return f", line {lines[-1]}" if lines else ""


def mistake_text(problem: BaseException) -> str:
    """Return the mistake as a clause."""
    text = str(problem).rstrip(".")
    if isinstance(problem, (CurveError, OverdueError)):
        return text
    return f"{type(problem).__name__}: {text}" if text else type(problem).__name__


# The limit of time

_AGAIN_S = 0.02
"""Seconds between alarms from the first one on: code may catch what an alarm raises."""

_BUSY = 0.8
"""Share of the limit that must have gone by at work, not waiting for other programs."""


def _longest_wait(seconds: float) -> float:
    """Return the seconds of the clock after which waiting code is stopped.

    A busy machine may take several to give a program a tenth of a second.
    """
    return 5.0 + 10.0 * seconds


class OverdueError(BaseException):
    """Code ran for longer than it may; its traceback ends where it was.

    No `Exception`: code that passes over all mistakes shall end, too.
    """


class _Clock:
    """The alarm of this process, with its earlier handler."""

    def __init__(self) -> None:
        self._seconds: float | None = None
        self._began = self._worked = 0.0
        self._before: object = None
        self._theirs = (0.0, 0.0)

    @property
    def is_free(self) -> bool:
        """Whether the system has an alarm that this thread receives and that is not set yet."""
        is_main = threading.current_thread() is threading.main_thread()
        return hasattr(signal, "setitimer") and is_main and self._seconds is None

    def start(self, seconds: float) -> None:
        """Set the alarm: after so many seconds, and then again and again."""
        if signal.getsignal(signal.SIGALRM) != self._ring:
            # Never put back: one that comes a moment too late must find somebody who lets it pass.
            self._before = signal.signal(signal.SIGALRM, self._ring)
        self._began, self._worked, self._seconds = time.monotonic(), time.thread_time(), seconds
        self._theirs = signal.setitimer(signal.ITIMER_REAL, seconds, _AGAIN_S)

    def stop(self) -> None:
        """Clear the alarm; an earlier one goes on with the rest of its time."""
        self._seconds = None
        theirs, interval = self._theirs
        left = max(theirs - (time.monotonic() - self._began), 1e-3) if theirs else 0.0
        signal.setitimer(signal.ITIMER_REAL, left, interval)

    def _ring(self, number: int, frame: FrameType | None) -> None:
        if self._seconds is None:
            if callable(self._before):
                self._before(number, frame)
        elif self._is_over(self._seconds) and (frame is None or frame.f_code.co_filename != __file__):
            # In this file it is just being stopped.
            raise OverdueError

    def _is_over(self, seconds: float) -> bool:
        worked = time.thread_time() - self._worked
        return worked >= _BUSY * seconds or time.monotonic() - self._began >= _longest_wait(seconds)


_clock = _Clock()


class stopped_after:  # noqa: N801 - reads as a word of the language
    """Context that raises `OverdueError` in its body when the time is over.

    That bounds every loop of Python's; one in C is bounded by the size of its arrays. Time that the machine
    gives to other programs does not count, up to `_longest_wait`.
    """

    def __init__(self, seconds: float) -> None:
        self._seconds, self._is_set = seconds, False

    def __enter__(self) -> None:
        if _clock.is_free:
            self._is_set = True
            _clock.start(self._seconds)

    def __exit__(
        self, kind: type[BaseException] | None, problem: BaseException | None, trace: TracebackType | None
    ) -> None:
        if not self._is_set:
            return
        _clock.stop()
        if isinstance(problem, OverdueError):
            text = f"it ran for longer than {self._seconds:g} s and was stopped"
            raise OverdueError(text).with_traceback(trace) from None
