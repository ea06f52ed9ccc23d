"""Files in and out.

- ``formats``: one record for each format, found by listing; what writes text beside them.
- ``files``: the content of a file decides which, or its name.  ``options``, ``choice``: what a person chose.
- ``drawing``: a document as a picture: SVG's source, PNG, PDF, films.
- ``parts``: the curves of a document and their pieces, the source of everything else that is written.
- ``code_runtime``: what exported Python brings along.
- ``svg``: SVG out and in.  ``dxf_library``: ezdxf, for DXF.
  ``arcs``, ``cubics_in``: their pieces as Hermite curves.  ``node_types``: of what kinds their points are.
- ``table``: tables in, of text and of other kinds, and blocks of numbers on the clipboard.
- ``child``: a process with limits for the files of others.  ``reading``: what is done there.
- ``units``: units of length as files write them.
  ``rescaled``: documents in another unit, or elsewhere.
- ``naming``: names made different from each other.
- ``errors``: what is raised, and what does not come in, by kind and count.
- ``facts``: what ``curvebench info`` prints.
"""

import lazy_loader as lazy

READER_PROCESS = "--reader-process"
"""First word of the command line of a bundle that shall read a drawing (see ``child``); not for people."""

__getattr__, __dir__, __all__ = lazy.attach_stub(__name__, __file__)
