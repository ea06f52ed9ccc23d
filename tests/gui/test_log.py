"""The log: what helps to understand a failure is in it, and nothing of what a person has drawn or named."""

from __future__ import annotations

import logging
from pathlib import Path

import pytest
from msgspec.structs import replace
from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QFileDialog

from app.cli import main
from app.diagnostics.crash_handler import CrashHandler, place_of, report_of
from app.diagnostics.log import FORMAT, LAST_LINES, NAME, last_lines, logged
from app.diagnostics.log_file import FILE_NAME, LogFile
from app.diagnostics.slow_frames import SlowFrames
from app.document.model import Document, make_curve
from app.document.point_edits import set_position
from app.features.import_export.commands import ImportCommands
from app.features.import_export.export_commands import ExportCommands
from app.features.recovery.autosave import Autosave
from app.storage.files import load, save
from app.storage.format_error import FormatError
from app.storage.open_file import OpenFile
from app.tasks.task import Task
from tests.waiting import until

SECRET = ("mallory", "heirloom", "letters", "71.25", "-0.375", "tax2031")


class Lines(logging.Handler):
    """Hears what is logged."""

    def __init__(self):
        super().__init__()
        self.lines = []

    def emit(self, record):
        self.lines.append(FORMAT.format(record))


@pytest.fixture
def debug():
    handler = Lines()
    with logged():
        logging.getLogger(NAME).setLevel("DEBUG")
        logging.getLogger(NAME).addHandler(handler)
        yield handler.lines
    logging.getLogger(NAME).removeHandler(handler)


def telling(x):
    return Document((make_curve([(x, 71.25), (1.0, 2.0), (3.0, -0.375)], name="Heirloom"),))


@pytest.fixture
def folder(tmp_path):
    folder = tmp_path / "mallory letters"
    folder.mkdir()
    save(folder / "tax2031.curve.json", telling(0.5))
    return folder


def test_the_log_contains_no_personal_data(editor, folder, debug, monkeypatch):
    """Everything that names something: files that are there or not, locks, drawings, exceptions, backups."""
    window, session = editor.window, editor.session
    # The window may know already that another one has the file, and ask where else to save.
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: ("", ""))
    path = folder / "tax2031.curve.json"
    window.open_file(path)
    editor.fit()
    editor.drag_point(1, to=(1.5, 3.0))
    named = replace(session.active_curve, name="letters")
    session.commit(replace(session.document, curves=(named,)), "Rename to letters")
    locked = replace(session.active_curve, locked=True)
    session.change("Lock letters", lambda document: replace(document, curves=(locked,)))
    session.change("Move", lambda document: set_position(document, 0, 1, (71.25, 2.0)))
    session.change("Move", lambda document: set_position(document, 0, 1, (float("nan"), 2.0)))
    free = replace(locked, locked=False)
    session.change("Unlock letters", lambda document: replace(document, curves=(free,)))
    editor.trigger("saveDocument")
    other = OpenFile.open(path).file  # as another window
    other.take_over()
    editor.drag_point(1, to=(1.0, 3.0))
    editor.trigger("saveDocument")
    other.close()
    session.save(folder / "heirloom.curve.json")
    save(folder / "heirloom.curve.json", telling(9.0))
    editor.trigger("saveDocument")  # changed on the disk
    (folder / "broken heirloom.curve.json").write_text(
        '{"format": "curvebench", "version": 4, "letters": 71.25}'
    )
    for name in ("broken heirloom.curve.json", "missing heirloom.curve.json"):
        window.open_file(folder / name)
    for name, text in (
        ("letters.svg", "<svg><path d='M71.25,-0.375 x'/></svg>"),
        ("letters.csv", "71.25;;x"),
    ):
        (folder / name).write_text(text)
        window.commands[ImportCommands].import_files([folder / name])
        editor.wait_for_work()
    window.commands[ExportCommands].export(folder / "letters.svg")
    editor.wait_for_work()
    autosave = Autosave(session, folder / "heirloom.curve.json")  # a file where a folder should be
    editor.drag_point(1, to=(2.0, 3.0))
    assert not autosave.write_now()
    autosave.finish()
    crashes = CrashHandler(lambda: True, lambda: [], window)
    monkeypatch.setattr(crashes._soon, "start", lambda: None)
    monkeypatch.setattr("app.diagnostics.crash_handler._print", lambda *_: None)
    try:
        (folder / "letters.curve.json").write_text("{}")
        load(folder / "letters.curve.json")
    except FormatError as problem:
        crashes._take(FormatError, problem, problem.__traceback__)
    Task(lambda _report: int(f"{folder}"), lambda _task: None)
    until(lambda: any("failed (ValueError)" in line for line in debug))
    text = "\n".join(debug).lower()

    for word in SECRET:
        assert word not in text
    for what in (
        "opened a document, version 4, 1 curves, 3 points",
        "its lock is ours",
        "its lock is of another window",
        "saved a document: 1 curves, 3 points",
        "curvebench.storage: read ",
        "curvebench.storage: written ",
        "not read: enoent",
        "the file is seen as changed",
        "a change was refused by the lock of a curve",
        "a change was refused by checked",
        "a step of the history, now ",
        "no snapshot: ",
        "curvebench.crash: formaterror in app/storage/format.py:",
        "curvebench.tasks: ",
    ):
        assert what in text, what


def test_nothing_is_logged_for_a_frame_of_a_drag(editor, debug):
    editor.fit()
    x, y = editor.point(1)
    editor.press((x, y))
    debug.clear()
    for step in range(1, 20):
        editor.move((x + step * editor.pixel, y + 3 * step * editor.pixel))
        editor.window.canvas.viewport().repaint()
    assert editor.session.is_previewing
    heard = list(debug)
    editor.release((x, y))
    assert heard == []


def test_a_slow_frame_is_logged(qtbot, debug, monkeypatch):
    clock = iter([1.0, 1.1, 1.85, 1.9, 9.0])
    monkeypatch.setattr("app.diagnostics.slow_frames.thread_time", lambda: next(clock))

    class Source(QObject):
        changed, painted = Signal(), Signal()

    source = Source()
    SlowFrames(source.changed, source.painted, source)
    for _ in range(2):
        source.changed.emit()
        source.painted.emit()
    source.painted.emit()  # a window that is uncovered
    assert [line.rpartition(": ")[2] for line in debug] == ["a frame took 750 ms"]


def test_the_log_file_begins_with_earlier_lines(tmp_path):
    with logged():
        logging.getLogger(NAME).info("before %d", 1)
        file = LogFile(tmp_path / "state")
        logging.getLogger(f"{NAME}.storage").info("after %d", 2)
        logging.getLogger(NAME).debug("not asked for")
        file.close()
        logging.getLogger(NAME).info("too late")
    written = (tmp_path / "state" / FILE_NAME).read_text().splitlines()
    assert [line.rpartition(": ")[2] for line in written[-2:]] == ["before 1", "after 2"]


def test_the_log_file_has_a_largest_size(tmp_path):
    with logged():
        file = LogFile(tmp_path)
        for _ in range(3000):
            logging.getLogger(NAME).info("x" * 1000)
        file.close()
    sizes = [path.stat().st_size for path in tmp_path.iterdir()]
    assert len(sizes) == 4
    assert max(sizes) < 300_000


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="a disk that is always full is Linux's")
def test_a_failing_disk_does_not_stop_the_program(tmp_path, capsys):
    (tmp_path / FILE_NAME).symlink_to("/dev/full")
    with logged():
        file = LogFile(tmp_path)
        logging.getLogger(NAME).info("lost")
        file.close()
    (tmp_path / "file").touch()
    with pytest.raises(FileExistsError):
        LogFile(tmp_path / "file")
    assert capsys.readouterr() == ("", "")


def test_a_crash_report_contains_the_last_lines(tmp_path):
    with logged():
        for number in range(LAST_LINES + 5):
            logging.getLogger(NAME).info("step %d", number)
    assert len(last_lines()) == LAST_LINES
    text = report_of(ValueError("what it is"))
    assert f"step {LAST_LINES + 4}" in text.splitlines()[-1]
    assert text.index("ValueError: what it is") < text.index("step 50")


def test_an_error_in_a_file_of_the_person_does_not_name_the_file(tmp_path):
    """Families come from files of their own."""
    file = tmp_path / "mallory.py"
    with pytest.raises(ZeroDivisionError) as raised:
        exec(compile("1 / 0", file, "exec"), {})
    assert place_of(raised.value) == "no line of the program"


def test_the_log_ends_with_its_block():
    before = list(logging.getLogger(NAME).handlers), logging.getLogger(NAME).level
    with logged("DEBUG"), logged():
        assert len(logging.getLogger(NAME).handlers) >= 2
    assert (list(logging.getLogger(NAME).handlers), logging.getLogger(NAME).level) == before


def test_log_records_keep_no_lock(folder, debug):
    """What is logged is kept for a while: an argument that holds a lock would keep the file locked."""
    path = folder / "tax2031.curve.json"
    OpenFile.open(path)
    assert OpenFile.open(path).file.owner is None


@pytest.mark.parametrize(
    "words", [["--log", "debug", "info"], ["info", "--log=DEBUG"], ["info", "--log", "info"]]
)
def test_every_command_logs_on_request(folder, capsys, words):
    assert main([*words, str(folder / "tax2031.curve.json")]) == 0
    told = capsys.readouterr()
    assert "Heirloom" in told.out
    assert ("curvebench.storage: read " in told.err) == (words[-1] != "info" or words[0] == "--log")
    assert main(["info", str(folder / "tax2031.curve.json")]) == 0
    assert capsys.readouterr().err == ""


def test_every_command_has_the_log_option(capsys):
    for words in (["--help"], ["info", "--help"], ["render", "--help"], ["convert", "--help"]):
        with pytest.raises(SystemExit):
            main(words)
        assert "--log LEVEL" in capsys.readouterr().out
    for words in (["--log"], ["--log", "loud"]):
        with pytest.raises(SystemExit) as ended:
            main(words)
        assert ended.value.code == 2
        capsys.readouterr()
