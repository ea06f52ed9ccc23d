"""The form of the active curve: name, interval of t and tangent rules.

- ``commands``: the form in the window.
- ``panel``: the form.  ``controller``: turns what is typed and chosen into changes of the curve.
"""
