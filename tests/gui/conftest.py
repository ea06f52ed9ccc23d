"""The editor fixture, as a stranger would write it."""

from __future__ import annotations

import pytest

from app.testing import Editor


@pytest.fixture
def editor(qtbot):
    return Editor(qtbot)
