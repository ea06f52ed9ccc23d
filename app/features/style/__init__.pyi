# Modules that are imported when they are first used.
from . import blur_gesture as blur_gesture
from . import panel as panel
