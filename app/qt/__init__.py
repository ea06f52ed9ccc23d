"""Qt itself, below everything that uses it: remedies, and what a document says in its terms.

- ``overrides``: guarded overrides: an exception ends in the method that Qt called.
- ``keys``: keys that a widget takes before its window does, and those of the window that no field takes.
- ``labels``: words of others as they are written, not as HTML.
- ``strokes``: pens and fill rules of styles, for the screen and for pictures.
- ``sources``: imports without a search through the source of every module.
"""
