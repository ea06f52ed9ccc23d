"""What is owed to Qt itself, below everything that uses it.

- ``overrides``: guarded overrides: an exception ends in the method that Qt called.
- ``labels``: words of others as they are written, not as HTML.
"""
