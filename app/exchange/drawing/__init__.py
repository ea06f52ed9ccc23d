"""Documents as pictures and films.

- ``outlines``: curves as cubic Bézier pieces, and the frame around them.
- ``drawing``: the outlines of a document in a frame, the source of every picture.
- ``annotations``: a grid, handles and basis functions beside the curves.  ``styles``: colours.
- ``image``: PNG and PDF.  ``painting``: drawings painted with Qt.  Both need Qt.
- ``film``: films of a motion.  ``motion_frames``: their frames; needs Qt.  ``pillow``: writes GIF and APNG.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
