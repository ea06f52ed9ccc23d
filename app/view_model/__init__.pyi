# Modules that are imported when they are first used.
from . import analysis as analysis
from . import convert as convert
from . import reshape as reshape
