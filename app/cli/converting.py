"""The command ``convert``: one file into another, or many into a folder."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from msgspec.structs import replace

from .. import exchange
from ..document.limits import EditError
from ..document.words import rounded_up
from ..exchange.errors import ExchangeError
from ..exchange.files import ImportOptions, begin_import, export, import_file
from ..exchange.formats import FORMATS, ContentKind, ending_in, format_of
from ..exchange.options import TOLERANCE, automatic_tolerance
from ..exchange.table.columns import FamilyCell, read_family_cell
from ..families import HERMITE
from ..storage.files import StorageError
from ..tasks.progress import Report, part
from ..view_model.curve.curve_view import view_of
from ..view_model.fit import Fitted, fitted_to_curve
from .options import columns_to_read, options_of_formats, picture_options
from .output import RefusalError, TerminalProgress, one_line, print_json, print_remarks, print_text, reason_of

if TYPE_CHECKING:
    from ..document.model import Document
    from ..exchange.cubics_in import ImportResult
    from ..exchange.reader_process import ReaderProcess

_MANY_CURVES = 20
"""Curves beyond which it is said how to take some of them."""

_BYTES_A_PROCESS = 2**18
"""Bytes to read for each process, unless -j says how many there are: to start one takes as long as these."""

_IGNORES_CASE = sys.platform in ("win32", "darwin")


@dataclass(frozen=True)
class _Conversion:
    """A file to read and the one to write."""

    source: str
    target: str


@dataclass(frozen=True)
class _Converted:
    """Result of a conversion: largest deviation from the true curves, whether that is a bound, remarks.

    `automatic` is the tolerance where the format has one that nobody set.
    """

    deviation: float | None
    is_bound: bool
    remarks: list[str]
    automatic: float | None = None


def convert(options: argparse.Namespace) -> int:
    """Convert one file, or many, and return the exit code."""
    if options.to is not None:
        return _convert_many(options)
    source, target = options.files
    with TerminalProgress() as report:
        result = _converted(options, _Conversion(source, target), report)
    if options.json:
        print_json({"output": target} | _facts(result))
    else:
        print_remarks(result.remarks)
        print_text(_result(target, result))
    return 0


def _facts(result: _Converted) -> dict[str, Any]:
    facts = {"deviation": result.deviation, "deviation_is_bound": result.is_bound, "remarks": result.remarks}
    return facts if result.automatic is None else facts | {"automatic_tolerance": result.automatic}


def _result(target: str, result: _Converted) -> str:
    if result.deviation is None:
        return one_line(target)
    deviation = exchange.exported_curves.deviation_text(result.deviation, result.is_bound)
    allowed = "" if result.automatic is None else f" (automatic tolerance {result.automatic:g})"
    return f"{one_line(target)}: largest deviation from the true curves {deviation}{allowed}"


def _convert_many(options: argparse.Namespace) -> int:
    _family_of(options)  # a problem of the options is reported once
    conversions = _planned_conversions(options)
    try:
        Path(options.output).mkdir(parents=True, exist_ok=True)
    except OSError as problem:
        raise RefusalError(
            f"The folder “{options.output}” cannot be created: {reason_of(problem)}."
        ) from None
    count, jobs = len(conversions), _jobs(options)
    results = []
    with TerminalProgress() as progress, ExitStack() as stack:
        # While a file is written here, processes read the next ones, in order.
        readers = [stack.enter_context(exchange.reader_process.ReaderProcess()) for _job in range(jobs)]
        for conversion, reader in zip(conversions[1:], readers[1:], strict=False):
            begin_import(conversion.source, ImportOptions(tolerance=options.tolerance), reader)
        for index, conversion in enumerate(conversions):
            report = _named(
                part(progress, index / count, (index + 1) / count),
                f"{one_line(Path(conversion.source).name)} ({index + 1} of {count})",
            )
            following = conversions[index + jobs].source if index + jobs < count else None
            result = _outcome(options, conversion, report, readers[index % jobs], following)
            progress.clear()
            results.append(_report_outcome(conversion, result, is_quiet=options.json))
    if options.json:
        print_json(results)
    return 1 if any("error" in result for result in results) else 0


def _outcome(
    options: argparse.Namespace,
    conversion: _Conversion,
    report: Report,
    reader: ReaderProcess,
    following: str | None,
) -> _Converted | str:
    """Return the result of a conversion, or the sentence of its error."""
    try:
        return _converted(options, conversion, report, reader, following)
    except (RefusalError, ExchangeError, StorageError) as problem:
        text = str(problem)
    except OSError as problem:
        text = f"{reason_of(problem)}."
    names = (Path(conversion.source).name, Path(conversion.target).name)
    return text if any(name in text for name in names) else f"“{names[0]}”: {text}"


def _report_outcome(conversion: _Conversion, result: _Converted | str, *, is_quiet: bool) -> dict[str, Any]:
    """Print the outcome of a conversion, or only its failure, and return it as plain values."""
    if isinstance(result, str):
        print_remarks([result])
        return {"input": conversion.source, "error": result}
    if not is_quiet:
        print_remarks(f"{conversion.source}: {remark}" for remark in result.remarks)
        print_text(_result(conversion.target, result))
    return {"input": conversion.source, "output": conversion.target} | _facts(result)


def _named(report: Report, name: str) -> Report:
    return lambda share, _word: report(share, name)


def _planned_conversions(options: argparse.Namespace) -> list[_Conversion]:
    """Return the conversions of many files, none of which writes over an input or another's output.

    Raises
    ------
    ExchangeError, RefusalError
        If one would, or if no format has the ending; nothing is written then.
    """
    ending: str = options.to if options.to.startswith(".") else f".{options.to}"
    format_of(f"a{ending}", FORMATS.written)
    folder = Path(options.output)
    if folder.exists() and not folder.is_dir():
        raise RefusalError(f"“{folder}” is not a folder.")
    conversions = [_Conversion(file, str(folder / f"{_stem(file)}{ending}")) for file in options.files]
    sources = {identity: file for file in options.files if (identity := _identity(file))}
    targets: dict[str, str] = {}
    for conversion in conversions:
        key = conversion.target.casefold() if _IGNORES_CASE else conversion.target
        if key in targets:
            raise RefusalError(
                f"“{targets[key]}” and “{conversion.source}” would both be written to “{conversion.target}”. "
                "Convert them into different folders."
            )
        targets[key] = conversion.source
        if (identity := _identity(conversion.target)) in sources and identity is not None:
            raise RefusalError(
                f"“{conversion.source}” would overwrite “{sources[identity]}”, which is also an input. "
                "Choose another folder."
            )
    return conversions


def _stem(path: str) -> str:
    """Return the name of a file without the ending that tells its format."""
    name = Path(path).name
    try:
        ending = ending_in(name, format_of(name, FORMATS.read))
    except ExchangeError:  # reported when its turn comes
        return Path(path).stem
    return name[: -len(ending)] or name


def _identity(path: str) -> tuple[int, int] | None:
    """Return device and inode of a file, which identify it under any name; None for a missing file."""
    try:
        status = Path(path).stat()
    except (OSError, ValueError):
        return None
    return status.st_dev, status.st_ino


def _jobs(options: argparse.Namespace) -> int:
    """Return the number of processes that read drawings."""
    if options.jobs is not None:
        return min(int(options.jobs), len(options.files))
    total = sum(Path(file).stat().st_size for file in options.files if Path(file).is_file())
    return max(1, min(len(options.files), os.cpu_count() or 1, total // _BYTES_A_PROCESS))


def _family_of(options: argparse.Namespace) -> FamilyCell:
    if options.keep_times and not _wants_fit(options):
        raise RefusalError("--keep-times needs --fit or --fit-tolerance.")
    try:
        return read_family_cell(" ".join([options.family or HERMITE.name, *options.setting]))
    except ValueError as problem:
        raise RefusalError(f"--setting must be of {problem}.") from None


def _import_options(options: argparse.Namespace, read: FamilyCell) -> ImportOptions:
    return ImportOptions(
        tolerance=options.tolerance,
        thin=options.thin,
        corners=options.corners,
        family=read.family,
        settings=read.settings,
        columns=columns_to_read(options),
        missing=options.missing,
        only=options.only,
    )


def _converted(
    options: argparse.Namespace,
    conversion: _Conversion,
    report: Report,
    reader: ReaderProcess | None = None,
    following: str | None = None,
) -> _Converted:
    """Convert a file.

    Parameters
    ----------
    reader
        The process that reads drawings; by default one for this file alone.
    following
        The file that the process begins to read while this one is written.
    """
    word = _family_of(options)
    # The fit stays close to the rows in any family; the curve through all rows may not.
    wanted = _import_options(options, FamilyCell(HERMITE) if _wants_fit(options) else word)
    try:
        source = import_file(conversion.source, wanted, report=part(report, 0.0, 0.4), process=reader)
    finally:
        if reader is not None and following is not None:
            begin_import(following, wanted, reader)
    form = format_of(conversion.target, FORMATS.written)
    if form.kind is not ContentKind.DOCUMENT:
        source = source.with_curves()
    document, fits = _fitted(source.document, options, word, part(report, 0.4, 0.7))
    written = export(
        document,
        conversion.target,
        replace(
            picture_options(options, document),
            format_options=options_of_formats(options, FORMATS.written),
            report=part(report, 0.7, 1.0),
        ),
    )
    fitted = [f"“{fit.curve.name}”: {fit.words}" for fit in fits]
    off = max((fit.deviation for fit in fits), default=0.0)
    deviation = written.deviation
    return _Converted(
        None if deviation is None else rounded_up(source.deviation + off + deviation, 3),
        written.is_bound and not fits,
        [*source.remarks, *_on_groups(source, options.only), *fitted, *written.remarks],
        automatic_tolerance(document) if options.tolerance is None and TOLERANCE in form.options else None,
    )


def _wants_fit(options: argparse.Namespace) -> bool:
    return options.fit is not None or options.fit_tolerance is not None


def _fitted(
    document: Document, options: argparse.Namespace, word: FamilyCell, report: Report
) -> tuple[Document, list[Fitted]]:
    """Return the document with the fits that the options ask for, and these fits."""
    if not _wants_fit(options):
        return document, []
    fits = []
    share = 1.0 / len(document.curves)
    for index, curve in enumerate(document.curves):
        model = replace(curve, family=word.family, settings=word.settings) if options.family else curve
        try:
            fit = fitted_to_curve(
                view_of(curve),
                model,
                count=options.fit,
                tolerance=options.fit_tolerance,
                keeps_times=options.keep_times,
                report=part(report, index * share, (index + 1) * share),
            )
        except EditError as problem:
            raise RefusalError(f"“{curve.name}”: {problem}") from None
        if options.fit_tolerance is not None and fit.deviation > options.fit_tolerance:
            raise RefusalError(
                f"“{curve.name}”: no {model.family.title} curve within {options.fit_tolerance:g} was found; "
                f"the nearest has {fit.words} Try another --family, a larger tolerance, "
                f"or --fit {len(fit.curve.points)}."
            )
        fits.append(fit)
    return replace(document, curves=tuple(fit.curve for fit in fits)), fits


def _on_groups(source: ImportResult, only: Sequence[str]) -> tuple[str, ...]:
    """Return a remark on --only where a file has many curves in groups."""
    curves = source.document.curves
    if only or len(curves) <= _MANY_CURVES or not any(curve.groups for curve in curves):
        return ()
    groups = source.contents()
    return (f"The file contains {len(curves)} curves; --only NAME selects those of a group: {groups}.",)
