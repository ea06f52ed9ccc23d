"""The document: immutable values, the edits that make new ones, and the file they live in.

- ``model``: Document, Curve, Node and the enumerations.
- ``edits``, ``curve_edits``: pure functions ``(Document, …) -> Document``, of points and of whole curves.
- ``format``: documents to and from bytes, strictly.
- ``storage``: bytes to and from disk, so that nothing is ever half written.
"""
