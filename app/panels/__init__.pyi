# Modules that are imported when they are first used.
from . import crash_dialog as crash_dialog
