# Modules that are imported when they are first used.
from . import log_file as log_file
