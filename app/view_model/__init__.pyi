# Modules that are imported when they are first used.
from . import analysis as analysis
from . import convert as convert
from . import match_curvature as match_curvature
from . import reshape as reshape
