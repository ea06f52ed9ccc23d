# Modules that are imported when they are first used.
from . import manual as manual
from . import shortcut_sheet as shortcut_sheet
