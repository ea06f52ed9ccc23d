"""Documents as pictures.

- ``drawing``: a document as cubic Bézier curves in a frame, the source of every picture.
  ``outlines``: one curve as such.  ``frames``: what a picture shows.
- ``annotations``: a grid, handles and basis functions to go with it.  ``styles``: its colours.
- ``image``: it as PNG and PDF.  ``painting``: how it is painted.
  Both need Qt.
- ``film``: a motion as a film.  ``animation``: it as GIF, APNG and MP4.  ``motion_frames``: its frames; needs
  Qt.  ``pillow``: what writes some of them.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
