# Modules that are imported when they are first used.
from . import export_dialog as export_dialog
from . import import_drawing_dialog as import_drawing_dialog
from . import import_table_dialog as import_table_dialog
from . import work_dialog as work_dialog
