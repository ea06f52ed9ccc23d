# Modules that are imported when they are first used.
from . import canvas as canvas
from . import pane as pane
