"""Rules of a curve: its family and its parameters.

- ``commands``: the actions.  ``toolbar_widgets``: the rule for the parameters, and the further families.
"""
