"""The document: immutable values and the edits that make new ones.

- ``model``: Document, Curve, Point and the rules for parameters.  ``derivatives``: those of points, and the
  rules that estimate them.  ``limits``: the numbers that they may hold.
- ``style``: stroke and fill of a curve.
- ``shapes``: neighbouring curves that are drawn as one.
- ``export``: the last export of a document.
- ``decimals``: numbers added as they are written.
- ``value``: their base.  ``fields``: what each field holds, and what it is called.
- ``steps``: what has changed from one value to the next.
- ``plain``: NumPy's numbers turned into Python's before a document holds them.
- ``words``: names, numbers and plurals as people read them.
- ``edits``, ``curve_edits``: pure functions ``(Document, …) -> Document``, of points and of whole curves.
- ``transforms``, ``jet_edits``: of many points or derivatives at once.
- ``kept_handles``: derivatives set for the spacing that moved points have.
- ``several_curves``: of several curves at once, and curves from elsewhere.  ``point_group``: points of
  several that change together.
- ``curve_tree``: shapes and groups as a tree.  ``shape_edits``: made, taken apart and moved in the order.
- ``straight_edits``: segments made straight.  ``lines``: straight ones found, and kept straight.
- ``box_edits``: rectangles and ellipses drawn into a box.
- ``style_edits``: how curves look, and what several have in common.
- ``ties``: velocities before and after a point that go the same way.
- ``selection``: selected curves and points followed through a change.
- ``places``: where in it something is, in words.
- ``image_edits``, ``plane_edits``: of the picture to trace; of unit, grid and guides.
- ``expression``: numbers as people type them.  ``lengths``: with their units.  ``units``: their size.
"""
