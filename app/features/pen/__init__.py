"""What a click of the pen makes.

- ``commands``: its action.
"""
