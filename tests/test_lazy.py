"""Modules that are imported when they are first used."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from app import storage
from app.lazy import lazy_submodules

ROOT = Path(__file__).resolve().parents[1]


def test_a_module_is_imported_when_it_is_first_used():
    code = """
import sys
from app import storage
import app.storage.files
assert "app.storage.digests" not in sys.modules and "hashlib" not in sys.modules
storage.digests.sha256(b"")
assert "app.storage.digests" in sys.modules
"""
    subprocess.run([sys.executable, "-c", code], cwd=ROOT, check=True)


def test_what_is_not_there_is_no_attribute():
    assert not hasattr(storage, "nonsense")
    with pytest.raises(AttributeError, match=r"module 'app\.storage' has no attribute 'nonsense'"):
        _ = storage.nonsense


def test_an_import_that_fails_inside_is_told_as_it_is(tmp_path, monkeypatch):
    """A module that lacks a library is there; what is missing is the library."""
    package = tmp_path / "lazy_package"
    package.mkdir()
    (package / "__init__.py").touch()
    (package / "needy.py").write_text("import a_library_that_nobody_has")
    monkeypatch.syspath_prepend(tmp_path)
    with pytest.raises(ModuleNotFoundError, match="a_library_that_nobody_has"):
        lazy_submodules("lazy_package")("needy")
    sys.modules.pop("lazy_package")
