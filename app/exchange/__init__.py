"""Files in and out.

- ``formats``: one record for each format, found by listing; writers of text beside them.
  ``options``: theirs.
- ``writing``, ``reading``: the name of a file decides which.  ``choice``: what a person chose for an export.
- ``drawing``: a document as cubic Bézier curves in a frame, the source of every picture.
- ``decor``: a grid, handles and basis functions to go with it.  ``styles``: its colours.
- ``svg``: that drawing as SVG, exact or within a stated tolerance.
- ``image``: that SVG as PNG and PDF; needs Qt.
- ``parts``: the curves of a document and their pieces, the source of everything else that is written.
- ``code_runtime``: what exported Python brings along.
- ``table``, ``table_source``: a table in memory, and the file it comes from.
- ``table_file``, ``table_lines``, ``table_layout``, ``table_columns``: tables of text in.
- ``table_array``, ``table_json``: arrays of NumPy and JSON in, as tables.
- ``table_curve``, ``thinning``: tables as curves, thinned out if asked.  ``table_import``: for the window.
- ``table_text``: blocks of numbers on the clipboard.
- ``svg_in``, ``svg_path``, ``arcs``, ``cubics_in``: SVG in, as Hermite curves.  ``svg_xml``: its tree,
  without DTD and entities.  ``svg_style``: its colours.
- ``animation``: motions as GIF, APNG and MP4.  ``motion_frames``: their frames; needs Qt.
- ``child``: a process with limits for the files of others.
- ``units``: how large a length of one is on paper.
- ``naming``: names made different from each other.  ``errors``: what is raised.
- ``progress``: how long work says how far it is.
- ``facts``: what ``curvebench info`` prints.
"""

READER_PROCESS = "--reader-process"
"""First word of the command line of a bundle that shall read a drawing (see ``child``); not for people."""
