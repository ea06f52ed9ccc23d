"""Families from a file that the person names: written, used, saved again, wrong, hanging, in all windows."""

from __future__ import annotations

import re

import numpy as np
import pytest
from PySide6.QtCore import QPoint, QRect, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QFileDialog, QLabel, QLineEdit, QMenu, QToolBar, QToolButton

from app.document.model import Document, make_curve
from app.families import FAMILIES, family_file
from app.families.family_file import FileCalls
from app.features.own_families import trial
from app.features.own_families.commands import FamilyBar
from app.features.own_families.files import family_files
from app.features.own_families.template import template
from app.session import Session
from app.storage.format import decode, encode
from app.testing import Editor
from app.view_model.basis_findings import findings_of
from curvecore import LagrangeCurve
from tests.effort import noted_calls
from tests.gui.family_files import forget_family_files, stop_following_files
from tests.waiting import until

POINTS = ((0.0, 0.0), (1.0, 2.0), (2.5, 1.0), (4.0, 3.0), (5.0, 0.5))
NAME = "my_lagrange"
DIFFERENCES = "Derivatives are differences: c′, c″, c‴ to some 9, 8, 6 digits."


@pytest.fixture(autouse=True)
def _forgotten(monkeypatch):
    """No file stays in use, and a sign on the disk is soon heeded, as is that there is no file any more."""
    monkeypatch.setattr("app.workbench.disk_watch._SETTLE_MS", 10)
    monkeypatch.setattr("app.features.own_families.files._RECHECK_MS", 10)
    yield
    forget_family_files()


_without_mistakes: set[bytes] = set()
"""Texts of files that were tried; the one of the template is in most tests."""


@pytest.fixture
def tried_here(monkeypatch):
    """Try files in this process: starting another one takes longer than most of the questions here."""

    def try_out(path, report):
        report(0.0, "Running")
        text = path.read_bytes()
        if text not in _without_mistakes:
            family_file.families_in(path)
            _without_mistakes.add(text)

    monkeypatch.setattr(trial, "try_out", try_out)


@pytest.fixture
def editor(editor):
    editor.session.commit(Document((make_curve(POINTS),)), "Begin")
    editor.fit()
    yield editor
    # Before the window is compared with a new one.
    if (bar := bar_of(editor)) is not None:
        bar.closed.emit(bar.text)
    forget_family_files()
    editor.window.context.actions.declare_again()


@pytest.fixture
def path(tmp_path):
    return tmp_path / f"{NAME}.py"


@pytest.fixture
def save(path):
    """Save the file as many editors do: another file takes its name."""

    def saved(text, way="replaced"):
        if way == "replaced":
            other = path.with_suffix(".new")
            other.write_text(text, encoding="utf-8")
            other.replace(path)
        elif way == "away and back":
            path.rename(path.with_suffix(".py~"))
            path.write_text(text, encoding="utf-8")
        else:
            path.write_text(text, encoding="utf-8")

    return saved


@pytest.fixture
def ask(monkeypatch):
    """Have the dialogs for files answer with this path."""

    def answered(path):
        for name in ("getOpenFileName", "getSaveFileName"):
            monkeypatch.setattr(QFileDialog, name, lambda *_: (str(path), ""))

    return answered


def bar_of(editor):
    bar = editor.window.findChild(FamilyBar)
    return bar if bar is not None and bar.isVisible() else None


def text_of(editor):
    bar = bar_of(editor)
    return bar.text if bar is not None else ""


@pytest.fixture
def using(editor, path, ask, save, tried_here):
    """The editor with the template in use, and its family chosen."""
    save(template(path))
    ask(path)
    editor.trigger("useFamilyFile")
    until(lambda: "adds" in text_of(editor))
    editor.choose_family(NAME)
    return editor


BROKEN = ("others = np.delete(parameters, i)", "others = np.delete(parameters, i)[1:]")


# Writing and using


def test_a_template_is_a_file_that_works_at_once(editor, path, ask):
    """All of it, with the process that runs it first."""
    ask(path)
    editor.trigger("familyTemplate")
    assert path.read_text(encoding="utf-8") == template(path)
    assert text_of(editor).startswith(f"“{NAME}.py” is in {path.parent}.")
    assert "runs this Python code" in text_of(editor)
    assert NAME not in [family.name for family in FAMILIES]  # nothing has run
    QTest.mouseClick(bar_of(editor).button("useOwnFamily"), Qt.MouseButton.LeftButton)
    until(lambda: "adds" in text_of(editor))
    assert text_of(editor) == f"“{NAME}.py” adds “My lagrange”. It runs again whenever it is saved."
    QTest.mouseClick(bar_of(editor).button("useOwnFamily"), Qt.MouseButton.LeftButton)
    editor.settle()
    assert editor.curve.family.name == NAME
    assert bar_of(editor) is None
    view = editor.session.active_view
    t = np.linspace(0.0, 1.0, 50)
    known = LagrangeCurve(view.points, view.parameters)
    assert view.curve.evaluate(t) == pytest.approx(known.evaluate(t), abs=1e-12)
    assert findings_of(view) == ()
    assert editor.window.findChild(QLabel, "basisFindings").text() == DIFFERENCES


def test_derivatives_given_by_a_file_replace_differences(using, save, path):
    said = using.window.findChild(QLabel, "basisFindings")
    assert said.text() == DIFFERENCES
    save("""import numpy as np
name, title = "my_lagrange", "my lines"

def basis(t, parameters, order):
    hats = np.eye(len(parameters))
    values = [np.interp(t, parameters, each) for each in hats]
    return np.stack(values, axis=1) if order == 0 else np.zeros((len(t), len(parameters)))
""")
    until(lambda: "is not the derivative of" in said.text())
    assert DIFFERENCES not in said.text()


@pytest.mark.parametrize("size", [(1024, 640), (1440, 900)])
def test_the_line_about_a_file_lies_over_nothing(editor, path, ask, size):
    """It lay over the foot of the canvas, where points are set and dragged."""
    editor.window.resize(*size)
    editor.settle()
    ask(path)
    editor.trigger("familyTemplate")
    bar, canvas = bar_of(editor), editor.window.canvas
    area = QRect(canvas.mapToGlobal(QPoint(0, 0)), canvas.size())
    own = QRect(bar.mapToGlobal(QPoint(0, 0)), bar.size())
    panel = QRect(editor.window.basis_panel.mapToGlobal(QPoint(0, 0)), editor.window.basis_panel.size())
    assert not own.intersects(area)
    assert not own.intersects(panel)
    needed = bar.sentence.heightForWidth(bar.sentence.width())
    assert bar.sentence.height() >= needed
    height = canvas.height()
    QTest.mouseClick(editor.window.findChild(QToolButton, "closeFamilyBar"), Qt.MouseButton.LeftButton)
    editor.settle()
    assert canvas.height() == height + own.height()


def test_a_line_waits_until_a_drag_has_ended(using, save, path):
    """The canvas would have another size under the hand."""
    place, height = using.point(2), using.window.canvas.height()
    using.press(place)
    using.move((3.0, 2.0))
    path.unlink()
    until(lambda: family_files().problems)
    assert bar_of(using) is None
    assert using.window.canvas.height() == height
    using.release((3.0, 2.0))
    until(lambda: "is no longer in its folder" in text_of(using))


def test_a_template_is_short_and_explains_the_options(path):
    text = template(path)
    assert text.count("\n") <= 30
    for word in ("title", "order", "breaks", "interpolates = False", "can_close = True", "settings = ["):
        assert word in text


@pytest.mark.parametrize(
    ("stem", "name"),
    [("My Splines-2", "my_splines_2"), ("3rd", "my_3rd"), ("ä", "my"), ("x" * 60, "x" * 40)],
)
def test_the_family_of_a_template_is_called_as_its_file(tmp_path, stem, name):
    path = tmp_path / f"{stem}.py"
    path.write_text(template(path), encoding="utf-8")
    (family,) = family_file.families_in(path)
    assert family.name == name


def test_a_dialog_that_is_left_changes_nothing(editor, ask):
    ask("")
    for name in ("familyTemplate", "useFamilyFile"):
        editor.trigger(name)
    assert bar_of(editor) is None
    assert not editor.action("useOwnFamily").isEnabled()


def test_a_template_that_cannot_be_written_is_reported(editor, tmp_path, ask):
    ask(tmp_path / "nowhere" / "own.py")
    editor.trigger("familyTemplate")
    assert text_of(editor).startswith("own.py was not written.")


def test_the_family_of_a_file_is_offered_in_every_list_of_families(using):
    family = FAMILIES.named(NAME)
    action = using.action(family.action_name)
    last = using.action(FAMILIES[-2].action_name)
    # Behind the family before it, in the menu and in that of the toolbar.
    places = [each for each in last.associatedObjects() if isinstance(each, QMenu | QToolBar)]
    assert places
    for place in places:
        assert place.actions().index(action) == place.actions().index(last) + 1
    assert not action.icon().isNull()
    assert family.label in using.find_command(family.label)
    using.key(Qt.Key.Key_Escape)
    using.show_dock("analysisDock")
    using.trigger("ghostMyLagrange")
    using.drag_point(2, (3.0, 2.0))
    using.screenshot()


# Settings


def with_width(text, limits="limits=(0.2, 5.0)"):
    """The template with the setting that it shows in a comment."""
    (record,) = re.findall(r"# settings = \[(FamilySetting\(.*?\))\]", text)
    setting = record.replace("limits=(0.2, 5.0)", limits)
    head = f"from curvecore import FamilySetting\nsettings = [{setting}]\nname ="
    text = text.replace("name =", head, 1)
    return text.replace("basis(t, parameters):", "basis(t, parameters, width):", 1)


def test_the_setting_of_the_template_is_a_field_and_its_value_survives_changes_of_the_file(using, save, path):
    using.show_dock("curveDock")
    save(with_width(template(path)))
    until(lambda: using.window.findChild(QLineEdit, "settingWidth") is not None)
    using.settle()
    field = using.window.findChild(QLineEdit, "settingWidth")
    field.setFocus()
    field.selectAll()
    using.type_text(field, "2.5")
    QTest.keyClick(field, Qt.Key.Key_Return)
    assert dict(using.curve.settings) == {"width": 2.5}
    assert using.session.active_view.curve.chosen == {"width": 2.5}
    assert using.session.undo_stack.undoText() == "Set width of a bell to 2.5"
    assert decode(encode(using.session.document)).curves[0].settings == using.curve.settings
    # A file that no longer allows the value draws by its default.
    save(with_width(template(path), "limits=(0.2, 2.0)"))
    until(lambda: using.session.active_view.curve.chosen == {"width": 1.0})
    save(template(path))
    until(lambda: using.session.active_view.curve.chosen == {})
    assert using.session.active_view.is_current


# Saved again


@pytest.mark.parametrize("way", ["replaced", "written", "away and back"])
def test_saving_draws_the_curves_anew(using, save, path, way):
    before = using.session.active_view.curve.evaluate(0.4)
    document = using.session.document
    save(template(path).replace(*BROKEN).replace('title = "my lagrange"', 'title = "slipped"'), way)
    until(lambda: using.action("familyMyLagrange").text() == "Slipped")
    using.settle()
    assert np.abs(using.session.active_view.curve.evaluate(0.4) - before).max() > 0.1
    assert using.session.document is document
    said = using.window.findChild(QLabel, "basisFindings")
    assert said.isVisible()
    assert "The functions do not sum to 1" in said.text()
    assert "The curve misses its points" in said.text()
    assert said.text().endswith(f" {DIFFERENCES}")
    assert "ran again" in using.status
    save(template(path), way)
    until(lambda: said.text() == DIFFERENCES)
    assert using.session.active_view.curve.evaluate(0.4) == pytest.approx(before)


def test_everything_that_is_switched_on_follows(using, save, path):
    for name in (
        "overlayComb",
        "overlayMarks",
        "ghostMyLagrange",
        "ghostHermite",
        "plotLebesgue",
        "plotSpeed",
    ):
        using.trigger(name)
    using.scrub(0.4)
    using.settle()
    growth = using.session.active_view.growth
    save(template(path).replace("columns.append(", "columns.append(2.0 * "))
    until(lambda: using.session.active_view.growth > 1.5 * growth)
    assert using.session.active_view.growth == pytest.approx(2.0 * growth)
    using.drag_point(1, (1.5, 2.5))
    view = using.session.active_view
    known = LagrangeCurve(view.points, view.parameters)
    assert view.curve.evaluate(0.4) == pytest.approx(2.0 * known.evaluate(0.4))
    basis = using.window.basis_panel.drawing.basis
    assert basis.value_at(float(view.parameters[1]), 0)[1] == pytest.approx(2.0)


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        (("columns = []", "columns = {}"), "line 15: AttributeError"),
        (("import numpy as np", "import numpy as"), "line 3: "),
        (("import numpy as np", "import sys; sys.exit()"), "line 3: SystemExit"),
        (("np.stack(columns, axis=1)", "np.stack(columns)"), "must have the shape (m, n)"),
        (("np.stack(columns, axis=1)", "np.stack(columns, axis=1) / 0"), "line 16"),
        (('name = "my_lagrange"', 'name = "hermite"'), "a family named “hermite” already exists"),
    ],
)
def test_a_mistake_is_reported_with_its_line_and_the_last_working_version_stays(
    using, save, path, wrong, said
):
    view = using.session.active_view
    with np.errstate(all="ignore"):
        save(template(path).replace(*wrong))
        until(lambda: said in text_of(using))
    assert text_of(using).startswith(f"“{NAME}.py”")
    assert "The last version that worked stays in use." in text_of(using)
    assert str(path.parent) not in text_of(using)
    assert using.session.active_view is view
    using.drag_point(2, (3.0, 2.0))
    assert using.session.active_view.is_current
    save(template(path))
    until(lambda: bar_of(using) is None)


def test_a_dismissed_message_stays_hidden_until_the_next_message(using, save, path):
    save(template(path).replace("columns = []", "columns = {}"))
    until(lambda: "line 15" in text_of(using))
    QTest.mouseClick(using.window.findChild(QToolButton, "closeFamilyBar"), Qt.MouseButton.LeftButton)
    using.settle()
    assert bar_of(using) is None
    save(template(path).replace("columns = []", "columns = ()"))
    until(lambda: "'tuple' object" in text_of(using))


def test_a_missing_file_is_reported_and_its_curves_continue(using, save, path):
    path.unlink()
    until(lambda: "is no longer in its folder" in text_of(using))
    using.drag_point(2, (3.0, 2.0))
    assert using.session.active_view.is_current
    save(template(path))
    until(lambda: bar_of(using) is None)


def test_a_changed_file_cancels_a_running_gesture(using, save, path):
    using.press(using.point(2))
    using.move((3.0, 2.0))
    save(template(path).replace(*BROKEN))
    said = using.window.findChild(QLabel, "basisFindings")
    until(lambda: "sum to 1" in said.text())
    assert using.point(2) == POINTS[2]
    assert not using.session.is_previewing


# Files that do not end


@pytest.fixture
def immediate_progress():
    """Have it said at once that a file runs, not after a second."""
    patience = family_files()._task._patience
    before = patience.interval()
    patience.setInterval(1)
    yield
    patience.setInterval(before)


@pytest.mark.usefixtures("immediate_progress")
def test_a_file_that_hangs_is_tried_elsewhere_and_can_be_stopped(editor, save, path, ask):
    runs = path.with_suffix(".runs")
    save(f"open({str(runs)!r}, 'w').close()\nwhile True:\n    pass\n")
    ask(path)
    editor.trigger("useFamilyFile")
    until(lambda: "has been running for a while" in text_of(editor))
    until(runs.exists)
    editor.drag_point(2, (3.0, 2.0))
    assert editor.point(2) == pytest.approx((3.0, 2.0), abs=2 * editor.pixel)
    QTest.mouseClick(bar_of(editor).button("stopFamilyFile"), Qt.MouseButton.LeftButton)
    until(lambda: "was stopped" in text_of(editor))
    assert NAME not in [family.name for family in FAMILIES]


SLOW = """import time

def spin(seconds):
    began = time.thread_time()
    while time.thread_time() - began < seconds:
        pass

def basis(t, parameters):
    if len(parameters) == len(t) == 6:
        print("slow {")
        spin(SECONDS)
"""


def slow(text, seconds):
    """The template with functions that take so many seconds of processor time at six points."""
    return text.replace("def basis(t, parameters):\n", SLOW.replace("SECONDS", str(seconds)))


@pytest.fixture
def slowing(using, save, path):
    """The editor, after the file was saved with other seconds."""

    def slowed(seconds):
        title = f"slow by {seconds}"
        text = slow(template(path), seconds).replace('title = "my lagrange"', f'title = "{title}"')
        save(text)
        until(lambda: using.action("familyMyLagrange").text() == title.capitalize())
        return text[: text.index("< seconds")].count("\n") + 1

    return slowed


LAST = "The last curve that could be drawn is shown."


def test_functions_that_hang_for_some_number_of_points_do_not_hold_the_window(
    using, slowing, path, monkeypatch
):
    """It stood still for 5 s, and then said "Cancelled." alone."""
    line = slowing(1e9)
    monkeypatch.setattr(trial, "SECONDS", 1.0)
    good = using.session.active_view.curve
    stopped = noted_calls(monkeypatch, FileCalls, "_refuse_overdue")
    using.add_point(4.5, 2.5)
    # The window waits for them once, and only for a moment.
    assert [(call.kind[0], seconds) for _calls, call, _problem, seconds in stopped] == [(6, 0.1)]
    what = rf"“{NAME}\.py”, line {line}|{line + 1}: the family “slow by 1e9” takes long for 6 points"
    assert re.match(what, using.message)
    assert using.message.endswith(f"and is tried in the background. {LAST}")
    assert using.session.active_view.curve is good
    using.drag_point(2, (3.0, 2.0))
    assert using.point(2) == pytest.approx((3.0, 2.0), abs=2 * using.pixel)
    assert not using.window.findChild(QToolButton, "offeredAction").isVisible()
    using.screenshot()
    assert len(stopped) == 1
    until(lambda: "ran for longer than 1 s and was stopped" in using.message)
    assert re.match(what, using.message)
    assert using.message.endswith(LAST)
    # With the points that it can draw it is drawn.
    using.trigger("undo")
    using.trigger("undo")
    assert using.session.active_view.is_current
    assert using.message == ""
    using.drag_point(1, (1.2, 1.5))
    assert using.session.active_view.is_current


@pytest.mark.usefixtures("immediate_progress")
def test_a_hanging_computation_beside_the_window_can_be_stopped(using, slowing):
    slowing(1e9)
    using.add_point(4.5, 2.5)
    until(lambda: "takes long for 6 points…" in text_of(using))
    QTest.mouseClick(bar_of(using).button("stopFamilyFile"), Qt.MouseButton.LeftButton)
    until(lambda: "takes long for 6 points and was stopped" in using.message)
    assert using.message.endswith(LAST)
    assert bar_of(using) is None


def test_functions_that_are_slow_and_end_are_drawn_a_moment_later(using, slowing):
    # More than the 0.1 s that a window waits.
    slowing(0.12)
    using.add_point(4.5, 2.5)
    assert "is tried in the background" in using.message
    until(lambda: using.session.active_view.is_current)
    using.settle()
    assert using.message == ""
    assert len(using.session.active_view.parameters) == 6


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("while True:\n    print('x' * 100)\n", "printed more than a megabyte and was stopped"),
        ("import os\nos._exit(0)\n", "ended the process that ran it (code 0)"),
        ("import sys\nprint('hello', file=sys.stderr)\nsys.exit(0)\n", "line 3: SystemExit: 0"),
    ],
)
def test_harmful_code_in_a_file_affects_only_the_trial_process(path, text, said):
    path.write_text(text)
    with pytest.raises(family_file.FamilyFileError) as caught:
        trial.try_out(path, lambda _share, _word: None)
    assert said in str(caught.value)
    assert str(caught.value).startswith(f"“{NAME}.py”")


# In C, where no alarm of Python's is heard.
BUSY = "import re\nre.fullmatch('(a+)+', 'a' * 60 + 'b')\n"


def test_a_trial_beyond_the_time_limit_is_ended(path, monkeypatch):
    monkeypatch.setattr(trial, "SECONDS", 0.3)
    path.write_text(BUSY)
    with pytest.raises(family_file.FamilyFileError, match=r"ran for longer than 0\.3 s and was stopped"):
        trial.try_out(path, lambda _share, _word: None)


def test_a_trial_counts_processor_time_alone_and_still_ends(path, monkeypatch):
    """Beside eight busy programs each was stopped that took 4 s of the processor."""
    monkeypatch.setattr(trial, "SECONDS", 1.0)
    path.write_text(f"import time\ntime.sleep(1.0)\n{template(path)}")
    trial.try_out(path, lambda _share, _word: None)
    monkeypatch.setattr(trial, "longest_wait", lambda _seconds: 0.2)
    with pytest.raises(family_file.FamilyFileError, match=r"has not ended after 0\.2 s and was stopped"):
        trial.try_out(path, lambda _share, _word: None)


# All windows, and documents


@pytest.fixture
def second(qtbot, using):
    other = Editor(qtbot, Session())
    yield other
    other.session.files.give_up_changes()


def test_all_windows_have_the_family_and_follow_its_changes(using, second, save, path):
    second.choose_family(NAME)
    curve = second.session.active_view.curve
    save(template(path).replace(*BROKEN))
    for each in (using, second):
        said = each.window.findChild(QLabel, "basisFindings")
        until(lambda said=said: "sum to 1" in said.text())
    assert second.session.active_view.curve is not curve


def test_a_document_that_was_open_before_its_family_is_drawn(editor, path, save, ask, tmp_path, tried_here):
    """Nothing in a document is run: its family is there once the person names the file."""
    document = tmp_path / "own.curve.json"
    save(template(path))
    document.write_bytes(encode(Document((make_curve(POINTS, family=FAMILIES.named(NAME)),))))
    editor.session.open(document)
    assert "is not available" in editor.message
    ask(path)
    editor.trigger("useFamilyFile")
    until(lambda: editor.session.active_view.is_current)
    editor.settle()
    assert "is not available" not in editor.message
    assert editor.action("familyMyLagrange").isChecked()
    assert not editor.session.files.is_modified


def test_a_file_given_on_the_command_line_is_watched(qtbot, path, save, tried_here):
    save(template(path))
    with family_file.families_of_files(FAMILIES, [str(path)]):
        family_files().deleteLater()
        stop_following_files()
        from app.features.own_families import files

        files._files.clear()
        editor = Editor(qtbot, Session())
        editor.choose_family(NAME)
        save(template(path).replace(*BROKEN))
        said = editor.window.findChild(QLabel, "basisFindings")
        until(lambda: "sum to 1" in said.text())
        editor.session.files.give_up_changes()


def test_a_family_removed_from_its_file_leaves_the_menus_and_its_curves_stay(using, save, path):
    save(template(path).replace('"my_lagrange"', '"other"').replace('"my lagrange"', '"other one"'))
    further = using.window.findChild(QMenu, "familiesMenu")
    until(lambda: "familyOther" in using.window.actions_by_name)
    using.settle()
    assert "familyMyLagrange" not in using.window.actions_by_name
    assert "My lagrange" not in [action.text() for action in further.actions()]
    assert "Other one" in [action.text() for action in further.actions()]
    assert using.session.active_view.is_current
    using.drag_point(2, (3.0, 2.0))
    assert using.session.active_view.is_current
    using.choose_family("other")
    using.trigger("undo")
    assert using.curve.family.name == NAME


def test_a_second_requested_file_does_not_displace_the_first_request(editor, path, save, ask, tried_here):
    """The first one was said to be “run again”, and its family was not offered."""
    other = path.with_name("my_second.py")
    save(template(path))
    other.write_text(template(other), encoding="utf-8")
    said = []
    # The files outlive this window.
    listening = family_files().brought.connect(lambda *_: said.append(text_of(editor)))
    for each in (path, other):
        ask(each)
        editor.trigger("useFamilyFile")
    until(lambda: len(said) == 2)
    family_files().brought.disconnect(listening)
    assert [words.partition(" adds ")[0] for words in said] == [f"“{NAME}.py”", "“my_second.py”"]
    assert editor.status == ""
    editor.trigger("useOwnFamily")
    assert editor.curve.family.name == "my_second"
