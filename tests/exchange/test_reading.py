"""Files in by their endings, and the limits of the child process."""

import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest

from app.document.model import Document, make_curve
from app.exchange.errors import ExchangeError
from app.exchange.files import ImportOptions, export, import_file
from app.exchange.formats import FORMATS, ContentKind, endings_of, format_of
from app.exchange.reader_process import ReaderProcess, read_in_process, seconds_for
from app.exchange.svg.reader import read_svg
from app.families import LAGRANGE
from app.tasks.progress import Cancelled
from app.view_model.curve.curve_view import view_of
from tests.programs import write_program
from tests.rows import each_row

ROOT = Path(__file__).parents[2]
BUSY = b'<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0' + b"C1 1 2 2 3 3" * 90_000 + b'"/></svg>'


@pytest.mark.usefixtures("drawings_read_here")
@each_row("ending", [".curve.json", ".svg", ".dxf", ".csv", ".TSV"])
def test_written_blocks_read_back_unchanged(ending, sketch, tmp_path):
    path = tmp_path / f"a{ending}"
    export(sketch, path)
    result = import_file(path)
    curve = view_of(result.document.curves[0]).curve
    assert curve.evaluate(curve.domain[1]) == pytest.approx(
        view_of(sketch.curves[0]).curve.evaluate(1.0), abs=1e-9
    )


@pytest.mark.parametrize("ending", [".svg", ".dxf"])
def test_a_process_reads_drawings(ending, tmp_path, children):
    path = tmp_path / f"a{ending}"
    document = Document((make_curve([(0.0, 0.0), (1.0, 2.0), (3.0, 1.0)]),))
    export(document, path)
    assert len(import_file(path).document.curves) == 1
    assert len(children) == 1
    assert children[0].returncode is not None


def test_a_table_is_named_after_its_file(tmp_path):
    path = tmp_path / "tide.csv"
    path.write_text("0,1\n1,2\n", encoding="utf-8")
    (curve,) = import_file(path, ImportOptions(family=LAGRANGE)).document.curves
    assert (curve.name, curve.family) == ("tide", LAGRANGE)


def test_an_unknown_ending_is_refused(tmp_path):
    *others, last = endings_of(FORMATS.read)
    with pytest.raises(ExchangeError) as refusal:
        import_file(tmp_path / "a.gif")
    assert str(refusal.value).endswith(f"use {', '.join(others)} or {last}.")
    assert {".svg", ".dxf", ".csv", ".npy", ".geojson"} <= set(others)


def test_the_reason_names_the_file(tmp_path):
    path = tmp_path / "bad.svg"
    path.write_text("<html/>", encoding="utf-8")
    with pytest.raises(ExchangeError) as refusal:
        import_file(path)
    said = str(refusal.value)
    assert said == "“bad.svg” cannot be read: This is not an SVG file: it begins with <html>."


def test_a_reader_beyond_its_time_is_stopped(children):
    with pytest.raises(
        ExchangeError, match=r"Reading needs more than 0.2 s of processor time and was stopped"
    ):
        read_in_process(read_svg, BUSY, None, seconds=0.2)
    assert all(each.returncode not in (None, 0) for each in children)
    assert len(children) == 1


LINE = b'<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0C1 1 2 2 3 0"/></svg>'
SLOW = """import sys
import time
from app.exchange.svg.reader import read_svg

def work(seconds):
    began = time.process_time()
    while time.process_time() - began < seconds:
        pass

if "pytest" not in sys.modules:
    work(0.2)

def sleeping(data, tolerance):
    time.sleep(0.3)
    return read_svg(data, tolerance)

def working(data, tolerance):
    work(0.06)
    return read_svg(data, tolerance)
"""


@pytest.fixture
def slow_reader(tmp_path, monkeypatch):
    """Readers that sleep for 0.3 s or work for 0.06 s; to import them takes 0.2 s of the processor."""
    (tmp_path / "slow_reader.py").write_text(SLOW)
    monkeypatch.syspath_prepend(tmp_path)
    yield import_module("slow_reader")
    del sys.modules["slow_reader"]


def test_the_start_and_other_programs_do_not_count_towards_the_limit(slow_reader, children):
    """Beside eight busy programs, eleven of nineteen icons took longer than 10 s, as the clock says."""
    told = []
    found = read_in_process(
        slow_reader.sleeping, LINE, None, seconds=0.15, report=lambda share, _word: told.append(share)
    )
    assert len(found.document.curves) == 1
    assert len(children) == 1
    assert len(told) > 10
    assert told == sorted(told)


def test_a_sleeping_reader_is_ended(slow_reader, children, monkeypatch):
    monkeypatch.setattr("app.exchange.reader_process.longest_wait", lambda _seconds: 0.1)
    with pytest.raises(ExchangeError, match=r"Reading did not finish within 0.1 s and was stopped"):
        read_in_process(slow_reader.sleeping, LINE, None)
    assert [each.returncode in (None, 0) for each in children] == [False]


def test_one_process_reads_one_drawing_after_the_other(slow_reader, children):
    """Each has the limit to itself: together they take more than one may."""
    with ReaderProcess() as process:
        process.begin(read_svg, LINE, None)
        assert len(process.read(read_svg, LINE, None).document.curves) == 1
        with pytest.raises(ExchangeError, match="begins with <png>"):
            process.read(read_svg, LINE.replace(b"svg", b"png"), None)
        for _drawing in range(3):
            process.read(slow_reader.working, LINE, None, seconds=0.15)
        assert len(children) == 1


def test_a_stopped_drawing_does_not_affect_the_next_one(children):
    with ReaderProcess() as process:
        with pytest.raises(ExchangeError, match=r"needs more than 0.1 s"):
            process.read(read_svg, BUSY, None, seconds=0.1)
        assert len(process.read(read_svg, LINE, None).document.curves) == 1
        process.begin(read_svg, BUSY, None)
        assert len(process.read(read_svg, LINE, None).document.curves) == 1
    assert len(children) == 3
    assert all(each.returncode is not None for each in children)


def test_a_process_without_its_parent_leaves_no_folder(tmp_path):
    """The parent was killed: it cannot remove what it wrote for the child."""
    folder = tmp_path / "messages"
    folder.mkdir()
    (folder / "question").write_bytes(LINE)
    code = f"from app.exchange.reader_main import main; main({str(folder)!r})"
    subprocess.run([sys.executable, "-c", code], cwd=ROOT, stdin=subprocess.DEVNULL, check=True, timeout=60)
    assert not folder.exists()


def test_a_cancelled_reading_ends_the_process(children):
    class Impatient:
        calls = 0

        def __call__(self, share, word):
            self.calls += 1
            assert 0 <= share < 1
            if self.calls == 3:
                raise Cancelled

    impatient = Impatient()
    with pytest.raises(Cancelled):
        read_in_process(read_svg, BUSY, None, report=impatient)
    assert impatient.calls == 3
    assert all(each.returncode not in (None, 0) for each in children)
    assert len(children) == 1


def test_a_large_file_may_take_longer_than_a_small_one():
    assert seconds_for(0) == seconds_for(2**16) == 10
    assert seconds_for(2**16 + 2**20) == 130


@pytest.mark.skipif("sys.platform != 'linux'", reason="only Linux limits the address space")
def test_a_reader_beyond_its_memory_is_stopped():
    with pytest.raises(ExchangeError, match="Reading needs more memory than is allowed and was stopped"):
        read_in_process(read_svg, BUSY, None, memory=10 * 2**20, seconds=30)


@pytest.mark.skipif(sys.platform == "win32", reason="the executable is a script")
def test_a_bundle_reads_drawings(tmp_path, monkeypatch):
    """“Reading needs more memory than is allowed”: a bundle's executable knows no option -c.

    PyInstaller's, for one, is the program itself; this one stands for it.
    """
    bundle = tmp_path / "curvebench"
    write_program(
        bundle,
        f"import sys\nsys.path.insert(0, {str(ROOT)!r})\nfrom app.cli import main\nsys.exit(main())\n",
    )
    monkeypatch.setattr(sys, "frozen", True, raising=False)
    monkeypatch.setattr(sys, "executable", str(bundle))
    drawing = b'<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0C1 1 2 2 3 0"/></svg>'
    assert len(read_in_process(read_svg, drawing, None).document.curves) == 1


def test_a_process_that_breaks_down_is_not_called_one_that_needs_memory(monkeypatch):
    monkeypatch.setattr(sys, "frozen", True, raising=False)
    # An interpreter, which does not know the option and ends with 2.
    with pytest.raises(ExchangeError, match=r"ended without an answer \(code 2\)"):
        read_in_process(read_svg, b"<svg/>", None)


def test_every_ending_belongs_to_one_format_that_is_written_and_one_that_is_read():
    for formats in (FORMATS.written, FORMATS.read):
        endings = endings_of(formats)
        assert len(set(endings)) == len(endings)
        for each in formats:
            assert all(format_of(f"a{ending.upper()}", formats) is each for ending in each.endings)


def test_every_drawing_is_read_by_a_function_that_a_process_finds_by_name():
    for each in FORMATS.read:
        if each.kind is ContentKind.DRAWING:
            assert getattr(import_module(each.read.__module__), each.read.__name__) is each.read


def test_the_window_starts_without_readers_and_writers():
    code = "import sys, app.exchange; print(*(m for m in sys.modules if m.startswith('app.exchange.')))"
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True)
    assert done.stdout.split() == []
