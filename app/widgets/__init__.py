"""Widgets that know nothing of curves.

- ``boxes``: layouts in one expression.  ``overlay_frame``: frames that lie over another widget.
- ``controls``: buttons and boxes, named for tests and screen readers.  ``tool_buttons``: small ones.
- ``action_switch``: buttons that show an action.  ``choice_style``: style of those that switch something.
  ``toolbar_widget``: what shrinks with a toolbar.  ``choices_menu``: switches that stay open.
- ``field_edit``, ``ranged_spin``: numbers and words to type.  ``number_text``: numbers as they are written.
- ``length_text``: lengths with their units.  ``choice_row``: one of a few.
- ``colour_popup``: colours, looked at and chosen.
- ``preference_fields``: one for each kind of setting.
- ``field_form``: fields that ask for changes of the document.
- ``live_slider``, ``setting_slider``: sliders.  ``elided_label``: words that change while a hand moves.
- ``fitting``: room on small screens.
"""
