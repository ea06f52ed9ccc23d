"""The document: immutable values and the edits that make new ones.

- ``model``: Document, Curve, Point and the enumerations.  ``limits``: what numbers they may hold.
- ``plain``: NumPy's numbers turned into Python's before a document holds them.
- ``coding``: hooks for msgspec.  ``words``: names, numbers and plurals as people read them.
- ``edits``, ``curve_edits``: pure functions ``(Document, …) -> Document``, of points and of whole curves.
- ``transforms``, ``parameter_edits``, ``jet_edits``: of many points, parameters or derivatives at once.
- ``kept_handles``: derivatives set for the spacing that moved points have.
- ``several_curves``: of several curves at once.  ``straight_edits``: segments made straight.
- ``selection``: where selected curves and selected points are after a change.
- ``image_edits``, ``import_edits``: of the picture to trace; curves from elsewhere.
- ``expression``: numbers as people type them.
"""
