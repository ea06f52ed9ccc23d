"""Settings that are saved between starts.

- ``preferences``: all settings, as attributes.
- ``kinds``: the kinds of settings.  ``file``: the ini file that holds them.

To add a setting: one attribute of ``preferences.Preferences``, with a docstring, of one of the kinds::

    is_loud = Switch("view/loud", default=False, label="Loud", tip="Play a sound at each click")

A setting with a label is shown in the dialog of preferences, in the order of the class; others are saved
when they are changed elsewhere. If `WindowState` has a field of the same name, the setting is its start
value, and a change in the dialog acts at once. ``tests/gui/test_preferences_dialog.py`` adds one of each
kind.
"""
