"""The manual in the window: every page opens, links lead to pages, and every quote of the window is true."""

from __future__ import annotations

import re

import pytest
from PySide6.QtCore import Qt, QUrl
from PySide6.QtGui import QKeySequence, QTextTable
from PySide6.QtWidgets import QAbstractButton, QLabel, QLineEdit, QListWidget, QTabWidget, QTextBrowser

from app.actions.keymap import RESERVED
from app.features.help.manual import ManualWindow, manual_pages
from app.storage.resources import resource
from app.testing.input_driver import type_keys
from app.tools.tool import TOOLS
from app.window.connect import all_actions
from tests.rows import each_row

PAGES = manual_pages()
_GESTURES = " ".join(row.keys for tool in TOOLS for row in tool.gestures)
_IN_GESTURES = {"Alt", "Ctrl", "E", "Enter", "Escape", "Shift", "Tab", "X", "Y", "Backspace"}
"""Keys of gestures, which are no keys of actions: those while something is dragged, those of the t-rail."""


@pytest.fixture
def manual(editor):
    editor.trigger("manual")
    window = editor.window.findChild(ManualWindow)
    yield window
    window.close()


def code_of(page):
    return "".join(re.findall(r"```.*?```", page.text, re.DOTALL))


def titles(manual):
    pages = manual.findChild(QListWidget, "manualPages")
    return [pages.item(row).text() for row in range(pages.count())]


def page_text(manual):
    return manual.findChild(QTextBrowser, "manualText").toPlainText()


def search(manual, text):
    field = manual.findChild(QLineEdit, "manualSearch")
    field.clear()
    field.textEdited.emit("")
    type_keys(field, text)


def test_every_page_opens_from_the_list(manual, qtbot):
    pages = manual.findChild(QListWidget, "manualPages")
    assert titles(manual) == [page.title for page in PAGES]
    for row, page in enumerate(PAGES):
        place = pages.visualItemRect(pages.item(row)).center()
        qtbot.mouseClick(pages.viewport(), Qt.MouseButton.LeftButton, pos=place)
        assert page_text(manual).startswith(page.title)
        assert "](" not in page_text(manual)
        assert page_text(manual).count("**") == code_of(page).count("**")


def test_tables_of_a_page_are_tables(manual):
    """The two pages with a table of keys and of formats, and no other."""
    with_tables = []
    for page in PAGES:
        manual.show_page(page.name)
        frames = manual.findChild(QTextBrowser, "manualText").document().rootFrame().childFrames()
        with_tables += [page.title] * any(isinstance(frame, QTextTable) for frame in frames)
    assert with_tables == [page.title for page in PAGES if "\n| --- |" in page.text]


def test_every_link_leads_to_a_page(manual):
    text = manual.findChild(QTextBrowser, "manualText")
    links = [(page.name, link) for page in PAGES for link in re.findall(r"\]\((.+?)\)", page.text)]
    assert len(links) > 4
    for name, link in links:
        manual.show_page(name)
        text.anchorClicked.emit(QUrl(link))
        assert page_text(manual).startswith(next(page.title for page in PAGES if page.name == link)), (
            name,
            link,
        )


def test_a_search_lists_the_pages_with_all_words_and_marks_the_words(manual):
    search(manual, "scrub Λ")
    assert titles(manual) == ["Basis functions"]
    text = manual.findChild(QTextBrowser, "manualText")
    marked = [mark.cursor.selectedText().casefold() for mark in text.extraSelections()]
    assert {"scrub", "λ"} == set(marked)
    assert len(marked) == page_text(manual).casefold().count("scrub") + page_text(manual).count("Λ")
    search(manual, "zzz")
    assert titles(manual) == []
    assert page_text(manual) == "No page has all of these words."
    manual.show_page(PAGES[0].name)
    assert titles(manual) == [page.title for page in PAGES]


def test_the_manual_opens_once(editor, manual):
    editor.trigger("manual")
    assert len(editor.window.findChildren(ManualWindow)) == 1


# Quotes of the window

ENTRIES = {
    " › ".join(filter(None, (each.section.menu.title, each.section.submenu, each.text))): each.key
    for each in all_actions()
}
MENUS = {entry.rpartition(" › ")[0] for entry in ENTRIES}
KEYS = {key for each in all_actions() for key in each.key.split(", ")}


@each_row("page", PAGES, ids=lambda page: page.name)
def test_menus_and_keys_of_a_page_are_those_of_the_actions(page):
    paths = re.findall(r"\*([^*\n]+ › [^*\n]+)\*(?: \(`([^`]+)`\))?", page.text)
    for path, key in paths:
        assert path in ENTRIES or path in MENUS, path
        assert key in ["", *ENTRIES.get(path, "").split(", ")], (path, key)
    for row, names in re.findall(r"^\| (`.*`) \| (.*) \|$", page.text, re.MULTILINE):
        if page.name.endswith("_keyboard.md"):
            pairs = zip(re.findall("`(.+?)`", row), names.split(", "), strict=True)
            known = {
                (key, each.text.removesuffix("…")) for each in all_actions() for key in each.key.split(", ")
            }
            assert set(pairs) - known == set()


@each_row("page", PAGES, ids=lambda page: page.name)
def test_keys_of_a_page_do_something(page):
    text = re.sub(r"```.*?```", "", page.text, flags=re.DOTALL)
    for key in re.findall("`([^`]+)`", text):
        if re.fullmatch(r"(?:(?:Ctrl|Shift|Alt)\+)*(?:[A-Z0-9]|F\d+|[%#!|]|[A-Z][a-z]+)", key):
            assert key in KEYS or key in _IN_GESTURES or QKeySequence(key) in RESERVED, key


def test_quotes_of_a_page_occur_in_the_window(editor):
    """Names of panels, boxes and pages: after all panels were built once."""
    window = editor.window
    for name in [
        dock.objectName() for dock in (*window.context.docks.side, window.context.docks["lessonsDock"])
    ]:
        editor.show_dock(name)
    for name in ("toggleLaboratory", "overlayBand"):
        editor.trigger(name)
    editor.settle()
    known = {each.text for each in all_actions()} | {menu for path in MENUS for menu in path.split(" › ")}
    known |= {dock.windowTitle() for dock in window.context.docks.side}
    known |= {each.text() for kind in (QLabel, QAbstractButton) for each in window.findChildren(kind)}
    for tabs in window.findChildren(QTabWidget):
        known |= {tabs.tabText(row) for row in range(tabs.count())}
    for page in PAGES:
        text = re.sub(r"```.*?```|\*\*", "", page.text, flags=re.DOTALL)
        quotes = [quote for quote in re.findall(r"\*([^*\n]+)\*", text) if " › " not in quote]
        assert set(quotes) - known == set(), page.name


def test_the_pages_are_small_and_alone_in_their_folder():
    assert {path.name for path in resource("manual").iterdir()} == {page.name for page in PAGES}
    assert all(len(page.text.encode()) < 8000 for page in PAGES)
    assert all(re.fullmatch(r"\d\d_[a-z_]+\.md", page.name) for page in PAGES)
