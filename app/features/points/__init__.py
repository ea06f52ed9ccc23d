"""Points: all of them, none, and with estimated derivatives.

- ``commands``: the actions.
"""
