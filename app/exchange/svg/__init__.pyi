# Modules that are imported when they are first used.
from . import fragments as fragments
from . import reader as reader
