"""Qt itself, below everything that uses it: remedies, and styles of a document in Qt's terms.

- ``overrides``: overrides that report their exceptions, and keys of a widget.
- ``labels``: text of others as it is written, not as HTML.
- ``strokes``: pens and fill rules of styles, for the screen and for pictures.
- ``sources``: imports without a search through the source of every module.
"""
