"""History: undo and redo, and the list of steps.

- ``commands``: the actions and the panel.
"""
