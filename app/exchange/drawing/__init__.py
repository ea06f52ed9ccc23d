"""Documents as pictures.

- ``drawing``: a document as cubic Bézier curves in a frame, the source of every picture.
- ``annotations``: a grid, handles and basis functions to go with it.  ``styles``: its colours.
- ``image``: its SVG as PNG and PDF; needs Qt.
- ``animation``: motions as GIF, APNG and MP4.  ``motion_frames``: their frames; needs Qt.
"""
