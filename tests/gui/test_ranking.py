"""What is found first in the palette and among the shortcuts: one ranking for both."""

from __future__ import annotations

from app.window.fuzzy import SearchEntry, ranked
from app.window.preferences_dialog import ShortcutEditor

NAMES = ["Recover Unsaved Work", "Reverse Curve", "Next Curve", "Curve Colour…", "Rename Curve…"]


def order(typed, names=NAMES):
    return [names[place] for place in ranked(typed, [SearchEntry(name) for name in names])]


def test_names_are_ranked_by_prefix_then_words_then_scattered_letters():
    assert order("reverse") == ["Reverse Curve"]
    assert order("re") == ["Reverse Curve", "Rename Curve…", "Recover Unsaved Work"]
    assert order("curve") == ["Curve Colour…", "Next Curve", "Reverse Curve", "Rename Curve…"]
    assert order("curve co") == ["Curve Colour…"]


WORDS = {
    "fill": "Style: Stroke and Fill…",  # it was an example, by letters scattered over its path
    "colour": "Curve Colour…",
    "color": "Curve Colour…",
    "mirror": "Mirror Tool",
    "flip": "Flip Vertically",
    "reverse": "Reverse Curve",
    "settings": "Preferences…",
    "night": "Theme: Dark",
}


def test_the_palette_finds_entries_by_synonyms(editor):
    found = {typed: editor.find_command(typed) for typed in WORDS}
    assert {typed: names[0] for typed, names in found.items()} == WORDS
    for typed, names in found.items():
        assert not {"Letter S", "NACA 2412"} & set(names), typed


def test_the_shortcut_search_ranks_alike(editor, qtbot):
    keys = ShortcutEditor(editor.window.actions_by_name.keymap)
    qtbot.addWidget(keys)
    keys.show()

    def search(text):
        keys.search.clear()
        qtbot.keyClicks(keys.search, text)
        return [
            keys.table.item(row, 0).text() for row in keys.displayed_rows if not keys.table.isRowHidden(row)
        ]

    everything = search("")
    assert search("Reverse") == ["Reverse Curve"]  # "Recover Unsaved Work" stood before it
    assert keys.current == "reverseCurve"
    assert search("undo")[0] == "Undo"
    assert "Undo" in search("Ctrl+Z")
    keys.search.clear()
    qtbot.keyClicks(keys.search, " ")
    assert [keys.table.item(row, 0).text() for row in keys.displayed_rows] == everything
