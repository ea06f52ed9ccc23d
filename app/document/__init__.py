"""The document: immutable values, the edits that make new ones, and the file they live in.

- ``model``: Document, Curve, Node and the enumerations.
- ``edits``: pure functions ``(Document, …) -> Document``.
- ``format``: documents to and from bytes, strictly.
- ``storage``: bytes to and from disk, so that nothing is ever half written.
"""
