"""SVG.

- ``writer``: a drawing as SVG, exact or within a stated tolerance.  ``tree``: its paths in their groups.
  ``numbers``: numbers and text as XML has them.
- ``reader``: SVG as Hermite curves, and what of a file is lost.
  ``xml_tree``: elements with their names.  ``groups``: what holds them.
- ``sheet``, ``lengths``, ``matrices``: sizes, units, view boxes and transforms.
- ``shapes``, ``path_data``: outlines.  ``clips``: boxes that cut.
- ``cascade``, ``properties``, ``paint``: the style of an element, from attributes and rules.
- ``fragments``: SVG as people copy it.
- ``our_own``: what in a picture of Curvebench's own is not the document's.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
