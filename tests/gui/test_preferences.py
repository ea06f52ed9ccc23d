"""Preferences: what is remembered comes back, and nothing in the file can stop a start."""

from pathlib import Path

import pytest
from PySide6.QtCore import QByteArray, QPoint, QRect, QSettings
from PySide6.QtWidgets import QWidget

from app.appearance.theme import ThemeMode
from app.document.style import Style
from app.settings.kinds import Choice, Setting, Switch
from app.settings.preferences import Preferences
from app.testing import Editor
from app.tools.snapping import SnapKind


@pytest.fixture
def store(tmp_path):
    return tmp_path / "settings.ini"


def again(store):
    """The same file as a later start finds it."""
    QSettings(str(store), QSettings.Format.IniFormat).sync()
    return Preferences(store)


def test_a_first_start_has_defaults_and_no_complaint(store):
    preferences = Preferences(store)
    assert preferences.theme_mode is ThemeMode.SYSTEM
    assert preferences.window_geometry.isEmpty()
    assert preferences.window_state.isEmpty()
    assert preferences.splitter_state.isEmpty()
    assert preferences.recent_files == []
    assert preferences.last_folder == Path.home()
    assert preferences.complaint == ""


def test_all_settings_are_restored(store, tmp_path):
    first = Preferences(store)
    first.theme_mode = ThemeMode.DARK
    first.window_geometry = QByteArray(b"\x01\xd9\x00geometry")
    first.window_state = QByteArray(b"\xff\x00state")
    first.splitter_state = QByteArray(b"splitter\x00")
    first.last_folder = tmp_path
    del first
    second = again(store)
    assert second.theme_mode is ThemeMode.DARK
    assert second.window_geometry.data() == b"\x01\xd9\x00geometry"
    assert second.window_state.data() == b"\xff\x00state"
    assert second.splitter_state.data() == b"splitter\x00"
    assert second.last_folder == tmp_path
    assert second.complaint == ""


def test_preferences_are_an_ini_file(store):
    preferences = Preferences(store)
    preferences.theme_mode = ThemeMode.LIGHT
    del preferences
    assert "theme=light" in store.read_text(encoding="utf-8")


def test_preferences_without_a_path_are_in_the_configuration_folder(own_home):
    preferences = Preferences()
    preferences.theme_mode = ThemeMode.LIGHT
    del preferences
    assert [path.name for path in own_home.rglob("*.ini")] == ["curvebench.ini"]


def test_a_settings_object_can_be_given(store):
    settings = QSettings(str(store), QSettings.Format.IniFormat)
    Preferences(settings).theme_mode = ThemeMode.DARK
    assert settings.value("theme") == "dark"


def files(folder, count):
    paths = [folder / f"curve {i}, ü.curve.json" for i in range(count)]
    for path in paths:
        path.touch()
    return paths


@pytest.mark.parametrize("count", [1, 2, 10])
def test_recent_files_latest_first(store, tmp_path, count):
    paths = files(tmp_path, count)
    preferences = Preferences(store)
    for path in paths:
        preferences.add_recent_file(path)
    del preferences
    assert again(store).recent_files == paths[::-1]


def test_recent_files_are_ten_at_most_and_each_once(store, tmp_path):
    paths = files(tmp_path, 12)
    preferences = Preferences(store)
    for path in [*paths, paths[5]]:
        preferences.add_recent_file(path)
    assert preferences.recent_files == [paths[i] for i in (5, 11, 10, 9, 8, 7, 6, 4, 3, 2)]


def test_missing_recent_files_are_not_listed_until_their_drive_is_back(store, tmp_path):
    one, two = files(tmp_path, 2)
    preferences = Preferences(store)
    preferences.add_recent_file(one)
    preferences.add_recent_file(two)
    one.unlink()
    assert preferences.recent_files == [two]
    one.touch()
    assert preferences.recent_files == [two, one]


def test_recent_files_can_be_cleared(store, tmp_path):
    preferences = Preferences(store)
    preferences.add_recent_file(files(tmp_path, 1)[0])
    preferences.clear_recent_files()
    del preferences
    assert again(store).recent_files == []


def test_a_relative_recent_file_is_stored_absolute(store, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    path = files(tmp_path, 1)[0]
    preferences = Preferences(store)
    preferences.add_recent_file(Path(path.name))
    assert preferences.recent_files == [path]


def test_a_missing_folder_gives_the_home_folder(store, tmp_path):
    preferences = Preferences(store)
    preferences.last_folder = tmp_path / "gone"
    assert preferences.last_folder == Path.home()


@pytest.mark.parametrize(
    ("key", "value", "name", "default"),
    [
        ("theme", "purple", "theme_mode", ThemeMode.SYSTEM),
        ("theme", ["dark", "light"], "theme_mode", ThemeMode.SYSTEM),
        ("window/geometry", "12", "window_geometry", QByteArray()),
        ("window/state", QPoint(1, 2), "window_state", QByteArray()),
        ("window/splitter", ["a"], "splitter_state", QByteArray()),
        ("files/recent", QPoint(1, 2), "recent_files", []),
        ("files/recent", ["", "x"], "recent_files", []),
    ],
)
def test_foreign_values_give_the_default_and_a_sentence(store, key, value, name, default):
    settings = QSettings(str(store), QSettings.Format.IniFormat)
    settings.setValue(key, value)
    preferences = Preferences(settings)
    assert getattr(preferences, name) == default
    assert key in preferences.complaint
    assert preferences.complaint.endswith(".")


OF_OLDER_VERSIONS = r"""
[General]
shortcuts="{\"traceImage\": \"Ctrl+9\", \"reverseCurve\": \"Ctrl+8\"}"
[view]
thin_lines=off
[text]
font=Serif
[snap]
kinds=grid boxes curves
[document]
new_kind=drawing
new_style="{\"stroke\":\"#ff0000\",\"opacity\":0.5,\"marker_end\":{\"name\":\"Arrow\"}}"
[export]
choice="{\"ending\":\".jpg\",\"values\":{\"quality\":90}}"
"""


def test_settings_of_older_versions_are_skipped_silently(qtbot, store):
    store.write_text(OF_OLDER_VERSIONS, encoding="utf-8")
    preferences = Preferences(store)
    editor = Editor(qtbot, preferences=preferences)
    assert preferences.snap_kinds == {SnapKind.GRID, SnapKind.CURVES}
    assert preferences.new_style == Style(stroke="#ff0000")
    assert editor.action("reverseCurve").shortcut().toString() == "Ctrl+8"
    assert preferences.complaint == ""
    editor.trigger("exportPicture")
    assert preferences.complaint == ""


RUBBISH = {
    "all bytes": bytes(range(256)) * 20,
    "zeros": bytes(500),
    "half a character": b"theme=dark\n\xc3",
    "another format": b'{"theme": "dark"}',
    "open section": b"[window\ngeometry=1",
}


@pytest.mark.parametrize("content", RUBBISH.values(), ids=RUBBISH)
def test_a_damaged_settings_file_is_renamed_and_defaults_apply(store, content):
    store.write_bytes(content)
    preferences = Preferences(store)
    assert preferences.theme_mode is ThemeMode.SYSTEM
    assert preferences.recent_files == []
    assert preferences.window_state.isEmpty()
    assert "damaged" in preferences.complaint
    assert store.with_name("settings.ini.damaged").read_bytes() == content
    preferences.theme_mode = ThemeMode.LIGHT
    del preferences
    later = again(store)
    assert later.theme_mode is ThemeMode.LIGHT
    assert later.complaint == ""


@pytest.mark.parametrize("content", [b"", b"\n", b"# mine\ntheme=dark\nnonsense\n", b"; nothing\n"])
def test_a_file_edited_by_hand_is_read(store, content):
    store.write_bytes(content)
    preferences = Preferences(store)
    assert preferences.theme_mode is (ThemeMode.DARK if b"dark" in content else ThemeMode.SYSTEM)
    assert preferences.complaint == ""
    assert store.read_bytes() == content


SETTINGS = [name for name, member in vars(Preferences).items() if isinstance(member, Setting)]
NAMES = [*SETTINGS, "recent_files"]


def every_key(folder):
    """The keys of everything that is remembered, those of later versions included."""
    preferences = Preferences(folder / "all.ini")
    for name in SETTINGS:
        setattr(preferences, name, getattr(preferences, name))
    preferences.add_recent_file(folder)
    keys = QSettings(str(folder / "all.ini"), QSettings.Format.IniFormat).allKeys()
    assert len(keys) >= 11
    return keys


WRONG = {
    "point": QPoint(1, 2),
    "list": ["a", 3.5],
    "map": {"a": 1},
    "number": 3.5,
    "boolean": True,
    "nan": "nan",
    "zero": "\0",
    "long": "x" * 100_000,
    "bytes": QByteArray(b"\xff\x00"),
    "json": '{"undo": ["Ctrl+Z"], "": "x"}',
}


def values_of(preferences):
    return {name: getattr(preferences, name) for name in NAMES}


def test_no_key_of_a_wrong_type_stops_a_start(qtbot, tmp_path):
    defaults = values_of(Preferences(tmp_path / "none.ini"))
    kinds = {name: type(each) for name, each in defaults.items()}
    keys, seen = every_key(tmp_path), []
    for name, value in WRONG.items():
        # One file: one for each key took as long as the windows.
        settings = QSettings(str(tmp_path / "one.ini"), QSettings.Format.IniFormat)
        for key in keys:
            settings.clear()
            settings.setValue(key, value)
            preferences = Preferences(settings)
            values = values_of(preferences)
            assert {name: type(each) for name, each in values.items()} == kinds, (name, key)
            if isinstance(value, QPoint | dict):
                assert values == defaults, (name, key)
                assert key in preferences.complaint, name
        settings = QSettings(str(tmp_path / f"{name}.ini"), QSettings.Format.IniFormat)
        for key in keys:
            settings.setValue(key, value)
        preferences = Preferences(settings)
        values = values_of(preferences)
        assert "cannot be used" in preferences.complaint, name
        if values in seen:
            # So would the window be.
            continue
        seen.append(values)
        editor = Editor(qtbot, preferences=Preferences(settings))
        assert "cannot be used" in editor.status, name
        editor.drag_point(1, to=(2, 3))
        assert editor.point(1) == pytest.approx((2, 3), abs=editor.pixel), name
    assert len(seen) > 4


def test_a_setting_of_an_unknown_type_gives_the_default_and_a_complaint(store):
    store.write_bytes(b"theme=@Variant(\\0\\0\\0\\x99\\xff)\n")
    preferences = Preferences(store)
    assert preferences.theme_mode is ThemeMode.SYSTEM
    assert "theme" in preferences.complaint


def saved_geometry(qtbot, rect):
    other = QWidget()
    qtbot.addWidget(other)
    other.setGeometry(rect)
    return other.saveGeometry()


@pytest.mark.parametrize(
    "rect",
    [
        QRect(50_000, 50_000, 800, 600),
        QRect(-90_000, -9, 800, 600),
        QRect(0, 0, 9**7, 9**7),
        QRect(0, 0, 1, 1),
    ],
    ids=["right", "left", "huge", "tiny"],
)
def test_a_window_position_off_every_screen_is_ignored(qtbot, qapp, store, rect):
    preferences = Preferences(store)
    preferences.window_geometry = saved_geometry(qtbot, rect)
    editor = Editor(qtbot, preferences=preferences)
    screen = qapp.primaryScreen().availableGeometry()
    shown = editor.window.geometry().intersected(screen)
    assert shown.width() >= 400
    assert shown.height() >= 300


@pytest.mark.parametrize("content", [b"", b"\xff" * 60, bytes(60), b"\x7f\xff\xff\xff" * 15])
def test_an_invalid_layout_gives_the_default_and_a_message(qtbot, store, content):
    layout = QByteArray(b"\x01\xd9\xd0\xcb\x00\x03\x00\x00" + content)
    preferences = Preferences(store)
    preferences.window_geometry = preferences.window_state = preferences.splitter_state = layout
    editor = Editor(qtbot, preferences=preferences)
    assert "cannot be used" in editor.status
    assert min(editor.window.splitter.sizes()[:2]) > 100  # the third part is hidden
    assert editor.window.point_table.isVisible()


def test_an_unreadable_file_of_settings_is_reported(tmp_path):
    preferences = Preferences(tmp_path)
    assert "cannot be read" in preferences.complaint
    preferences.theme_mode = ThemeMode.DARK
    assert preferences.last_folder == Path.home()


class _WithOneMore(Preferences):
    """What it takes to add a setting: one line, and its docstring."""

    beeps = Switch("tests/beeps", default=True)
    """Whether the tests beep."""

    corner = Choice("tests/corner", ThemeMode.DARK, "Corner", "The corner of the beeps")
    """Where they do."""


def test_a_setting_is_one_line(store):
    assert _WithOneMore(store).beeps is True
    _WithOneMore(store).beeps = False
    _WithOneMore(store).corner = ThemeMode.LIGHT
    kept = _WithOneMore(store)
    assert (kept.beeps, kept.corner, kept.complaint) == (False, ThemeMode.LIGHT, "")
    assert "beeps=off" in store.read_text(encoding="utf-8")
    store.write_text("[tests]\nbeeps=perhaps\ncorner=light\n", encoding="utf-8")
    broken = _WithOneMore(store)
    assert (broken.beeps, broken.corner) == (True, ThemeMode.LIGHT)
    assert "“perhaps” is neither “on” nor “off”" in broken.complaint
