# Modules that are imported when they are first used.
from . import command_palette as command_palette
from . import preferences_dialog as preferences_dialog
from .main_window import MainWindow as MainWindow
