"""The rules of a curve: its family and its parameters.

- ``commands``: the actions.  ``bar``: the rule for the t_i and its α, in the toolbar.
- ``family_button``: the menu of further families there.
"""
