"""Points: their selection, kinds and derivatives, and straight segments between them.

- ``commands``: the actions.
"""
