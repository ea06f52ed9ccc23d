"""Qt itself, below everything that uses it: remedies, and what a document says in its terms.

- ``overrides``: guarded overrides: an exception ends in the method that Qt called.
- ``keys``: keys that a widget takes before its window does.
- ``labels``: words of others as they are written, not as HTML.
- ``glyphs``: outlines of letters, as the fonts of the system have them.
- ``strokes``: pens and fill rules of styles, for the screen and for print.  ``gradients``: brushes, likewise;
  ``patterns``: of those.  ``tile_texts``: words in them.
- ``clips``: what they are cut by.
- ``contents``: texts and pictures in their frames.  ``picture_data``: what is in PNG and JPEG files.
- ``run_fonts``: fonts of parts of a text, and what they measure.
- ``letters_along``: letters along a course.  ``decorations``: lines under and through letters.
- ``written``: letters as glyphs of fonts in a PDF.
- ``caret_places``: where a caret stands between letters.
- ``sources``: imports without a search through the source of every module.
"""
