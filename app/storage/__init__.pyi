# Modules that are imported when they are first used.
from . import digests as digests
from . import files as files
