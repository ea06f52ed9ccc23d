"""Preferences: what is remembered comes back, and nothing in the file can stop a start."""

from pathlib import Path

import pytest
from PySide6.QtCore import QByteArray, QPoint, QSettings

from app.preferences import Preferences
from app.theme import ThemeMode


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


def test_everything_comes_back(store, tmp_path):
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


def test_it_is_an_ini_file(store):
    preferences = Preferences(store)
    preferences.theme_mode = ThemeMode.LIGHT
    del preferences
    assert "theme=light" in store.read_text(encoding="utf-8")


def test_without_an_argument_it_writes_into_the_configuration_folder(own_home):
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


def test_missing_recent_files_are_not_shown_but_come_back_with_their_drive(store, tmp_path):
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


def test_a_folder_that_is_gone_gives_the_home_folder(store, tmp_path):
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


def test_a_file_of_rubbish_gives_defaults(store):
    store.write_bytes(bytes(range(256)) * 20)
    preferences = Preferences(store)
    assert preferences.theme_mode is ThemeMode.SYSTEM
    assert preferences.recent_files == []
    assert preferences.window_state.isEmpty()


def test_a_place_that_cannot_be_read_is_said(tmp_path):
    preferences = Preferences(tmp_path)
    assert "cannot be read" in preferences.complaint
    preferences.theme_mode = ThemeMode.DARK
    assert preferences.last_folder == Path.home()
