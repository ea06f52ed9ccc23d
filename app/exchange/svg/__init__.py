"""SVG.

- ``writer``: a drawing as SVG, exact or within a stated tolerance.  ``tree``: its paths in their groups.
  ``numbers``, ``escapes``: numbers and text as XML has them.
- ``reader``: SVG as Hermite curves.
  ``xml_tree``: elements, without DTD and entities.  ``elements``: those that others refer to.
  ``names``, ``groups``: what they are called.
- ``sheet``, ``lengths``, ``matrices``: sizes, units, view boxes and transforms.
- ``guides``: those of Inkscape.
- ``shapes``, ``path_data``, ``basic_shapes``: outlines.  ``clips``: boxes that cut.
- ``cascade``, ``properties``, ``paint``, ``gradients``: the style of an element, from attributes
  and rules.  ``missing``: what of a file is lost, and told.
- ``fragments``: SVG as people copy it.  ``for_clipboard``: as others paste it.
- ``our_own``: what in a picture of Curvebench's own is not the document's.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
