"""Clones: copies of curves that follow their originals.

- ``commands``: making and unlinking them, and finding their originals.
"""
