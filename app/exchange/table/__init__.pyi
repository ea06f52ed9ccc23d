# Modules that are imported when they are first used.
from . import read as read
from . import source as source
