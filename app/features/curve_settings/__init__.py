"""The form of the active curve: name, interval of t and tangent rules, and its family's settings.

- ``commands``: the form in the window.  ``panel``: the form.
- ``setting_fields``: the fields of the family's settings.
"""
