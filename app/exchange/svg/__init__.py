"""SVG, written and read.

- ``writer``: documents as SVG, exactly or within a stated tolerance.
- ``reader``: SVG as curves, with a remark on everything that is lost. Its parts, from the file to a curve:
  ``xml_tree``, elements and their names · ``cascade``, declarations in force · ``styles``, strokes, fills and
  paints · ``coordinates``, lengths, transforms and the page · ``shapes``, outlines · ``context``, groups and
  boxes that cut · ``own_files``, pictures that Curvebench wrote.
- ``fragments``: SVG as people copy it.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
