"""The document: immutable values, the edits that make new ones, and the file they live in.

- ``model``: Document, Curve, Node and the enumerations.  ``limits``: what numbers they may hold.
- ``plain``: NumPy's numbers turned into Python's before a document holds them.
- ``edits``, ``curve_edits``: pure functions ``(Document, …) -> Document``, of points and of whole curves.
- ``transforms``, ``parameter_edits``, ``jet_edits``: of many points, parameters or derivatives at once.
- ``kept_handles``: derivatives set for the spacing that moved points have.
- ``several_curves``: of several curves at once.  ``straight_edits``: segments made straight.
- ``choice``: where chosen curves and selected nodes are after a change.
- ``image_edits``, ``import_edits``: of the picture to trace; curves from elsewhere.
- ``expression``: numbers as people type them.
- ``format``: documents to and from bytes, strictly; ``coding``: families in them, by name.
  ``image_path``: where the file of a picture lies.
- ``migration``: older versions of the format, step by step.  ``all_within``: a quick look at many numbers.
  ``repeated_keys``: what typed decoding passes over.
- ``storage``: bytes to and from disk, so that nothing is ever half written; ``file_access``: who may read
  them; ``leftovers``: temporary files, and sweeping them.
- ``lock``: whose a document is while it is open; ``processes``, ``turns``, ``claim``: who else is at work.
- ``open_file``: the file behind an open document: what was seen of it, and the lock.
- ``recovery``: snapshots of what is not saved.
"""
