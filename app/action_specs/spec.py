"""What is known of an action before there is a window."""

from __future__ import annotations

import msgspec


class ActionSpec(msgspec.Struct, frozen=True):
    """What an action is called, how it is reached and where it stands.

    Attributes
    ----------
    name
        The action's objectName.
    text
        Menu text, without mnemonic.
    menu
        The menu it stands in.
    shortcut
        One or more key sequences, comma separated; empty for none.
    icon
        A file of resources/icons, without suffix; empty for none.
    tip
        What it does, for tooltip and status line; the text itself where empty.
    group
        Name of the exclusive group it belongs to; makes it checkable.
    checkable
        Whether it is a switch of its own.
    separated
        Whether a separator stands before it in its menu; of the first in a submenu, before the submenu.
    submenu
        The submenu of `menu` it stands in; empty for the menu itself.
    alone
        What it is called where its menu is not seen: in the palette and the list of keys; the text itself
        where empty.
    needs
        What must be there before it can be used, to follow "needs"; empty where it always can be, or where
        nothing short says it.
    """

    name: str
    text: str
    menu: str
    shortcut: str = ""
    icon: str = ""
    tip: str = ""
    group: str = ""
    checkable: bool = False
    separated: bool = False
    submenu: str = ""
    alone: str = ""
    needs: str = ""
