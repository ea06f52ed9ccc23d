"""Rules of a curve: its family and its parameters.

- ``commands``: the widgets of the toolbar, for the parameters and further families, and the actions.
"""
