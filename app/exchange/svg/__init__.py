"""SVG.

- ``writer``: a drawing as SVG, exact or within a stated tolerance.
- ``reader``: SVG as Hermite curves.  ``path_data``: its paths.  ``properties``: its colours.
- ``xml_tree``: its elements, without DTD and entities.
"""
