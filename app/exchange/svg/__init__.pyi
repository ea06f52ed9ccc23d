# Modules that are imported when they are first used.
from . import fragments as fragments
from . import our_own as our_own
from . import reader as reader
