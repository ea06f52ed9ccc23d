"""The hostile corpus: every file gives one sentence, soon and without much memory.

Most are refused. Of a drawing with an error in one element all else comes in, and that is said.

All of it runs in one process of its own, by the command line, as a person would; what it says, how long
it takes and how much memory it takes is then looked at case by case.
"""

from __future__ import annotations

import importlib.util
import json
import os
import socket
import subprocess
import sys
from pathlib import Path

import pytest

from app.document.expression import ExpressionError, parse_number
from app.exchange.errors import ExchangeError
from app.exchange.files import import_file
from app.exchange.table.clipboard import TableTextError, read_titled_block
from app.storage.files import StorageError
from tests.rows import each_row

ROOT = Path(__file__).parents[2]
SCRIPT = ROOT / "tests" / "data" / "hostile_files.py"

SECONDS = 4
MEGABYTES = 150
"""Of the whole process: 126 to 130, as its memory lies, and 133 where it is the first to compile."""

_spec = importlib.util.spec_from_file_location("hostile_files", SCRIPT)
hostile = importlib.util.module_from_spec(_spec)
_spec.loader.exec_module(hostile)

RUNNER = """
import contextlib, importlib.util, io, json, os, sys
from pathlib import Path

from app.cli import main
from app.exchange import reader_process

script, folder = sys.argv[1:]
spec = importlib.util.spec_from_file_location("hostile_files", script)
hostile = importlib.util.module_from_spec(spec)
spec.loader.exec_module(hostile)

def largest():
    # Not ru_maxrss, which begins with that of the process that started this one. Children have a limit.
    status = Path("/proc/self/status")
    lines = status.read_text().splitlines() if status.exists() else ["VmHWM: 0"]
    return next(int(line.split()[1]) for line in lines if line.startswith("VmHWM")) // 1024

def spent():
    # Of the processor, children included: other programs may be busy.
    return sum(os.times()[:4])

def at_once(reader, data, tolerance, report):
    return reader(data, tolerance)

# A process for each would take most of the time.
reader_process.read_in_process = at_once

for name, make in hostile.CASES.items():
    path, data = Path(folder, name), make()
    path.write_bytes(data)
    errors, output, before = io.StringIO(), io.StringIO(), spent()
    with contextlib.redirect_stderr(errors), contextlib.redirect_stdout(output):
        code = main(["convert", str(path), str(Path(folder, "out.svg"))])
    report = [name, code, errors.getvalue(), output.getvalue(), spent() - before, largest()]
    print(json.dumps(report), flush=True)
    path.unlink()
    Path(folder, "out.svg").unlink(missing_ok=code != 0)
"""


@pytest.fixture(scope="module")
def reports(tmp_path_factory):
    """What became of every case: code, standard error and output, seconds, megabytes."""
    folder = tmp_path_factory.mktemp("hostile")
    done = subprocess.run(
        [sys.executable, "-W", "error", "-c", RUNNER, str(SCRIPT), str(folder)],
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, "PYTHONPATH": str(ROOT), "PYTHONIOENCODING": "utf-8"},
    )
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    assert list(folder.iterdir()) == []
    return {name: rest for name, *rest in map(json.loads, done.stdout.splitlines())}


TAKEN_IN = {
    "broken_transform.svg": "1 transform not applied: Path 2 “rotate(1 2)”.",
    "numbers_after_z.svg": "1 path imported only up to an error in the data: Path 2 at character 11, “4 4”.",
    "odd_points.svg": "1 polygon imported only up to an error in the data: Polygon 2 at the end.",
}


@each_row("name", hostile.CASES)
def test_a_hostile_file_gives_one_sentence(name, reports):
    code, errors, output, seconds, megabytes = reports[name]
    assert code == (name not in TAKEN_IN)
    assert ("out.svg" in output) == (name in TAKEN_IN)
    assert TAKEN_IN.get(name, "") in errors
    assert errors.startswith("curvebench: ")
    assert errors.count("\n") == 1
    assert len(errors) < 400
    assert "Traceback" not in errors
    assert "Error" not in errors
    assert seconds < SECONDS
    assert megabytes < MEGABYTES


@each_row(
    ("name", "place"),
    [
        ("malformed.curve.json", "line 1, column 10"),
        ("wrong_type_y.curve.json", "curves[0].points[2].y must be a number"),
        ("version_newer.curve.json", "newer version of Curvebench"),
        ("million_digits.curve.json", "curves[0].points[0].x must lie between"),
        ("ragged.csv", "Row 3 has 3 cells; the first row has 2."),
        ("formula.csv", "Row 3, column 1: “=cmd|' /C calc'!A0” is a formula"),
        ("bad_last_row.csv", "Row 200002 has 1 cells"),
        ("entities.svg", "The entity “b5” is nested deeper than 4 levels"),
        ("quadratic_entities.svg", "the DOCTYPE exceed 64 KB"),
        ("default_values.svg", "the DOCTYPE exceed 64 KB"),
        ("use_loop.svg", "2 circular references left out: Use 5 and Use 3."),
        ("nan.svg", "1 path imported only up to an error in the data: Path 2 at character 7, “NaN 1”"),
        ("infinite_by_transform.svg", "1 element with coordinates out of range left out: Path 2."),
        ("arc_beyond_numbers.svg", "Path 2 at character 31, “1e300”"),
        ("many_pieces.svg", "1 curve of more than 100000 pieces left out: Path 2."),
        ("too_large.svg", "1 curve with coordinates or velocities outside −1e12 to 1e12 left out: Path 2."),
        ("truncated.dxf", "ends at line 59 without EOF: it is incomplete"),
        ("number_of_words.dxf", "near line: 46"),
    ],
)
def test_the_refusal_names_the_position(name, place, reports):
    assert place in reports[name][1]


ENDINGS = (".curve.json", ".csv", ".svg", ".dxf")


def refused(path):
    with pytest.raises(StorageError) as refusal:
        import_file(path)
    return str(refusal.value)


@each_row("ending", ENDINGS)
def test_folders_and_missing_files_are_refused(ending, tmp_path):
    path = tmp_path / f"a{ending}"
    assert refused(path).startswith("There is no file")
    path.mkdir()
    assert "is a folder" in refused(path)


@pytest.mark.skipif(os.name == "nt", reason="links and pipes as Unix has them")
@pytest.mark.parametrize("ending", ENDINGS)
def test_links_pipes_and_sockets_are_refused(ending, tmp_path):
    names = ("dangling", "loop", "pipe", "socket")
    dangling, loop, pipe, connection = (tmp_path / f"{name}{ending}" for name in names)
    dangling.symlink_to(tmp_path / "gone")
    assert refused(dangling).startswith("There is no file")
    loop.symlink_to(loop)
    assert "is a link to itself" in refused(loop)
    os.mkfifo(pipe)
    assert "is a pipe or a device" in refused(pipe)
    with socket.socket(socket.AF_UNIX) as server:
        server.bind(os.path.relpath(connection))
        assert "cannot be read" in refused(connection)


@pytest.mark.skipif(not Path("/dev/zero").exists(), reason="a file without end")
def test_a_file_without_end_is_refused(tmp_path):
    path = tmp_path / "a.csv"
    path.symlink_to("/dev/zero")
    assert "is a pipe or a device" in refused(path)


@pytest.mark.skipif(os.name == "nt" or os.geteuid() == 0, reason="root may read everything")
def test_an_unreadable_file_is_refused(tmp_path):
    path = tmp_path / "a.csv"
    path.write_text("1,2\n", encoding="utf-8")
    path.chmod(0)
    assert "no permission to read" in refused(path)


@each_row(
    "text",
    ["nan", "inf", "-inf", "9**9**9", "9^9^9^9", "__import__('os')", "1e999", "(" * 150, "0x10", "1_000"],
)
def test_typed_numbers_are_parsed_or_refused(text):
    with pytest.raises(ExpressionError):
        parse_number(text)


@each_row("text", ["", "\0", "=cmd|' /C calc'!A0", "nan\tnan", "1\t2\n3", "9**9**9", "\ud800", "a" * 10**6])
def test_garbage_on_the_clipboard_is_refused(text):
    with pytest.raises(TableTextError):
        read_titled_block(text)


def test_exchange_errors_name_the_file(tmp_path):
    path = tmp_path / "x.csv"
    path.write_bytes(b"")
    with pytest.raises(ExchangeError, match=r"“x\.csv” cannot be read: The file is empty"):
        import_file(path)
