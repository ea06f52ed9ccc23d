"""The document: immutable values, the edits that make new ones, and the file they live in.

- ``model``: Document, Curve, Node and the enumerations.
- ``edits``, ``curve_edits``: pure functions ``(Document, …) -> Document``, of points and of whole curves.
- ``format``: documents to and from bytes, strictly.
- ``migration``: older versions of the format, step by step.
- ``storage``: bytes to and from disk, so that nothing is ever half written; ``file_access``: who may read
  them; ``leftovers``: temporary files, and sweeping them.
- ``lock``: whose a document is while it is open; ``processes``, ``turns``: who else is at work.
- ``open_file``: the file behind an open document: what was seen of it, and the lock.
"""
