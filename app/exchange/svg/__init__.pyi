# Modules that are imported when they are first used.
from . import fragments as fragments
from . import own_files as own_files
from . import reader as reader
