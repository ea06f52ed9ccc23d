# Modules that are imported when they are first used.
from . import bar as bar
