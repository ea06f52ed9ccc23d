# Modules that are imported when they are first used.
from . import cubics_in as cubics_in
from . import drawing as drawing
from . import dxf_library as dxf_library
from . import export_choice as export_choice
from . import exported_curves as exported_curves
from . import facts as facts
from . import files as files
from . import options as options
from . import reader_main as reader_main
from . import reader_process as reader_process
from . import svg as svg
from . import units as units
from .drawing.image import png_file as png_file
from .formats.formulas import svg_path_data as svg_path_data
from .svg.writer import svg_for_clipboard as svg_for_clipboard
from .svg.writer import svg_of as svg_of

READER_PROCESS: str
