"""Choosing by what is chosen: what looks the same, and what is not chosen now.

- ``commands``: the actions.
"""
