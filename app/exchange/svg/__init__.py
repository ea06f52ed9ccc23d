"""SVG.

- ``writer``: a drawing as SVG, exact or within a stated tolerance.
- ``reader``: SVG as Hermite curves.  ``path_data``: its paths.  ``properties``: its colours.
- ``fragments``: SVG as people copy it.
- ``xml_tree``: its elements, without DTD and entities.
"""

import lazy_loader as lazy

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
