# Modules that are imported when they are first used.
from . import lesson as lesson
from . import panel as panel
