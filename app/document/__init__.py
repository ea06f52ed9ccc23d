"""The document: immutable values, and edits that return new ones.

In reading order:

- ``model``: `Document`, `Curve`, `Point`, and the rules for parameters.  ``style``: stroke and fill.
  ``derivatives``: velocity, acceleration and jerk of a point, and the rules that estimate them.
- ``fields``: base class of all values, and what each field may hold.  ``limits``: largest numbers,
  `EditError`.  ``words``: names, numbers and plurals for people.
- ``point_edits``: edits of the points of a curve and of their derivatives.  ``rule_edits``: of its family,
  rules and parameters.  ``curve_edits``: of whole curves.  ``straight_edits``: segments made straight.
- ``constraints``: straight segments, ties and handles, kept while points move.
- ``point_group``: points of several curves that change together.  ``several_curves``: edits of several
  curves, and of their stroke and fill. ``transforms``: affine maps, alignment and distribution.
- ``groups``: shapes and groups as a tree.  ``group_edits``: combine, group, reorder, rename.
- ``plane_edits``: unit, grid, guides, reference image.
- ``selection``: selected curves and points, followed through a change.
- ``differences``: what changed from one document to the next.  ``plain_numbers``: numbers of NumPy made
  plain.
- ``expression``: numbers as people type them.  ``lengths``: lengths with units.

To add an edit: write a pure function ``(document, curve, …) -> Document`` in the module of its subject. Raise
`EditError` with a sentence for the status line where the edit is impossible; check numbers with
`limits.checked`; return the document itself where nothing changes. An edit that moves points ends with
`point_edits.with_points_elsewhere`, which keeps handles. A command calls it with
``session.change(undo_text, edit)``.
"""
