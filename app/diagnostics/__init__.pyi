# Modules that are imported when they are first used.
from . import crash_dialog as crash_dialog
from . import log_file as log_file
