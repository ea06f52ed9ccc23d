"""Remedies for Qt itself, below everything that uses it.

- ``overrides``: guarded overrides: an exception ends in the method that Qt called.
- ``keys``: keys that a widget takes before its window does.
- ``labels``: words of others as they are written, not as HTML.
- ``sources``: imports without a search through the source of every module.
"""
