"""A driver for pytest-qt: real mouse and key events on a real window, and the waiting that goes with them.

A stranger's ``conftest.py`` needs three lines::

    @pytest.fixture
    def editor(qtbot):
        return Editor(qtbot)

and a test reads as what a person does::

    def test_dragging_moves_the_point(editor):
        editor.new()
        editor.add_point(0, 0)
        editor.add_point(2, 1)
        editor.drag_point(1, to=(3, 2))
        assert editor.point(1) == pytest.approx((3, 2), abs=editor.pixel)

It does what a person can do, and raises `ImpossibleError`, with the reason, where there is no such thing: an
action is disabled, a panel is hidden, a place lies outside the plot or under something, a dialog waits.

Where the application has been told to quit, Qt ends every event loop at once; whoever waits then gets an
`ApplicationQuitError` instead of a test that hangs or asks a window that has handled no event.

- ``editor``: one window with all that can be done in it, its t-rail and its file bar.
- ``input_driver``: mouse, wheel and keys as events.
- ``reach``: refusal of events that no person could send.
- ``waiting``: event loops that end, and the time that a window needs to catch up.
"""

from .editor import Editor
from .input_driver import InputDriver
from .reach import ImpossibleError
from .waiting import ApplicationQuitError, spin, wait_for_rest

__all__ = ["ApplicationQuitError", "Editor", "ImpossibleError", "InputDriver", "spin", "wait_for_rest"]
