# Modules that are imported when they are first used.
from . import along as along
from . import caret as caret
from . import field as field
from . import first_size as first_size
from . import flowing as flowing
from . import fonts_before as fonts_before
from . import letter_paint as letter_paint
from . import letters as letters
from . import outlined as outlined
from . import remarks as remarks
from . import replace_bar as replace_bar
from . import replacing as replacing
from . import rewriting as rewriting
from . import type_bar as type_bar
from . import wording as wording
