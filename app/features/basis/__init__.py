"""Basis functions over t.

- ``commands``: actions of the t-rail.
"""
