"""The form of the active curve: name, interval of t, rules, and the settings of its family.

- ``commands``: the form in the window.  ``panel``: the form.
"""
