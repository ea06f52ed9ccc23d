# Modules that are imported when they are first used.
from . import lessons as lessons

__version__: str
