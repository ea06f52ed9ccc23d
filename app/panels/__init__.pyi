# Modules that are imported when they are first used.
from . import plot_canvas as plot_canvas
from . import plot_pane as plot_pane
