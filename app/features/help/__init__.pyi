# Modules that are imported when they are first used.
from . import shortcut_sheet as shortcut_sheet
