"""Widgets that know nothing of curves.

- ``action_switch``: buttons that show an action.  ``tool_buttons``: named for tests and screen readers.
  ``toolbar_widget``: what shrinks with a toolbar.
- ``field_edit``, ``told_spin``: numbers and words to type.  ``number_text``: numbers as they are written.
- ``live_slider``, ``setting_slider``: sliders.  ``elided_label``: words that change while a hand moves.
- ``fitting``: room on small screens.  ``choice_style``: style of small buttons that switch something.
"""
