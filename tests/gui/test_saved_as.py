"""Save As under the names of other formats: the file is what its name says, or there is none."""

from __future__ import annotations

import pytest
from PySide6.QtWidgets import QFileDialog


@pytest.fixture
def save_as(editor, tmp_path, monkeypatch):
    """Save a changed sketch under a typed name."""
    editor.drag_point(0, to=(0.0, 0.0))

    def save(name):
        answer = str(tmp_path / name), ""
        monkeypatch.setattr(
            QFileDialog, "getSaveFileName", lambda *words: proposed.append(words[2]) or answer
        )
        editor.trigger("saveDocumentAs")

    save.proposed = proposed = []
    return save


@pytest.mark.parametrize("name", ["icons.PNG", "icons.svg", "icons.dxf", "icons.points.csv"])
def test_nothing_of_ours_has_the_name_of_another_format(editor, save_as, tmp_path, name):
    save_as(name)
    assert editor.file_bar.text.startswith(
        f"{name} was not saved. Documents are saved as .curve.json. To write a "
    )
    assert (list(tmp_path.glob("[!.]*")), editor.session.files.is_modified) == ([], True)
    save_as("logo v1.2")
    assert [each.name for each in tmp_path.glob("[!.]*")] == ["logo v1.2.curve.json"]


def test_a_document_named_svg_opens_as_a_document_and_is_saved_elsewhere(editor, save_as, tmp_path):
    path = tmp_path / "icons.svg"
    editor.session.save(path)
    held, document = path.read_bytes(), editor.session.document
    editor.session.new()
    editor.window.context.files.open(path)
    assert (editor.session.document, editor.session.files.path) == (document, path)
    save_as("icons.curve.json")
    assert save_as.proposed[-1] == str(tmp_path / "icons.curve.json")
    assert path.read_bytes() == held
