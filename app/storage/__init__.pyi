# Modules that are imported when they are first used.
from . import digests as digests
from . import files as files
from . import gimp_palette as gimp_palette
from . import ps as ps
