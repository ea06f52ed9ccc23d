"""The form of the active curve: name, interval of t and tangent rules.

- ``commands``: the form in the window.  ``panel``: the form.
"""
