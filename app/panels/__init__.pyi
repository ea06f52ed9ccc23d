# Modules that are imported when they are first used.
from . import command_palette as command_palette
from . import crash_dialog as crash_dialog
from . import export_dialog as export_dialog
from . import import_drawing_dialog as import_drawing_dialog
from . import import_table_dialog as import_table_dialog
from . import plot_canvas as plot_canvas
from . import plot_pane as plot_pane
from . import preferences_dialog as preferences_dialog
