"""Widgets that know nothing of curves.

- ``boxes``: layouts in one expression.  ``frames``: frames over another widget, scrolled areas, and
  dialogs that fit small screens.
- ``controls``: buttons and boxes with names for tests and screen readers.  ``sliders``: sliders.
- ``fields``: edits, spin boxes and forms for numbers and words.  ``number_text``: numbers as text.
- ``preference_fields``: a field for each kind of setting.  ``colour_popup``: a popup to choose colours in.
- ``elided_label``: labels whose text changes while the mouse moves.
"""
