# Modules that are imported when they are first used.
from . import bar as bar
from . import offers as offers
