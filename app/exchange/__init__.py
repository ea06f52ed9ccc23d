"""Import and export.

- ``formats``: a record for each format, found by listing, with its reader and its writer.
- ``files``: `import_file` and `export`; the content of a file or its name decides on the format.
  ``options``, ``choice``: options of exports, and what a person chose of them.
- ``exported_curves``: the curves of a document and their pieces, the source of every writer of data.
  ``code_runtime``: functions that exported Python consists of.
- ``drawing``: a document as a picture: the source of SVG, PNG, PDF and films.
- ``cubics_in``: paths of other programs as Hermite curves.  ``svg``: SVG.  ``dxf_library``: ezdxf, for DXF.
- ``table``: tables read as curves, and blocks of numbers on the clipboard.
- ``child``: a process with limits for drawings of others.  ``reading``: the work that is done in it.
- ``units``: units of length, and documents in another unit.  ``naming``: different names.
- ``errors``: the error of this package, and the record of content that is not imported as it is.
- ``facts``: numbers about curves, for ``curvebench info``.
"""

import lazy_loader as lazy

READER_PROCESS = "--reader-process"
"""First word of the command line of a bundle that shall read a drawing (see ``child``); not for people."""

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
