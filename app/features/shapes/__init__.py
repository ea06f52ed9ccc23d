"""Shapes and groups: curves combined, with holes, and taken apart; grouped and ungrouped.

- ``commands``: the actions.
"""
