"""Widgets that know nothing of curves.

- ``boxes``: layouts in one expression.  ``overlay_frame``: frames that lie over another widget.
- ``controls``: buttons and boxes, named for tests and screen readers, and what shrinks with a toolbar.
  ``tool_buttons``: small ones, those that show an action, and the style of those that switch something.
- ``field_edit``, ``ranged_spin``: numbers and words to type.  ``number_text``: numbers as they are written.
  ``cell_editing``: fields in the cells of lists and tables.
- ``length_text``: lengths with their units.  ``choice_row``: one of a few.
- ``colour_popup``: colours, looked at and chosen.
- ``preference_fields``: one for each kind of setting.
- ``field_form``: fields that ask for changes of the document.
- ``live_slider``, ``setting_slider``: sliders.  ``elided_label``: words that change while a hand moves.
- ``fitting``: room on small screens.
"""
