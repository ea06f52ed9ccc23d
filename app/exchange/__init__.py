"""Import and export.

- ``formats``: a record for each format, found by listing, with its reader and its writer.
- ``files``: `import_file` and `export`; the content of a file or its name decides on the format.
  ``options``, ``export_choice``: options of exports, and a person's choice of them.
- ``exported_curves``: the curves of a document and their pieces, the source of every writer of data.
  ``code_runtime``: functions that exported Python consists of.
- ``drawing``: a document as a picture: the source of SVG, PNG, PDF and films.
- ``cubics_in``: paths of other programs as Hermite curves.  ``svg``: SVG.  ``dxf_library``: ezdxf, for DXF.
- ``table``: tables read as curves, and blocks of numbers on the clipboard.
- ``reader_process``: a process with limits for drawings of others.  ``reader_main``: its work.
- ``units``: units of length, and documents in another unit.  ``unique_names``: different names.
- ``errors``: the error of this package, and the record of content that is not imported as it is.
- ``facts``: numbers about curves, for ``curvebench info``.
"""

import lazy_loader as lazy

READER_PROCESS = "--reader-process"
"""First argument of a bundle that is started to read a drawing; see ``reader_process``."""

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
