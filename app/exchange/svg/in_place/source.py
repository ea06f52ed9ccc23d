"""The source of an SVG file as a tree: what is not changed in it is written back as it was, to the byte."""

from __future__ import annotations

import re
from collections.abc import Iterator

from ..escapes import quoted
from ..line_roles import ROLE
from ..names import INKSCAPE_SPACE, SODIPODI_SPACE, XLINK_SPACE

_LINK = "xlink:href"
_TOKEN = re.compile(
    r"""(?P<other><!--.*?-->|<!\[CDATA\[.*?\]\]>|<\?.*?\?>|<!(?>[^>"']|"[^"]*"|'[^']*')*>)"""
    r"|</[^>]*(?P<end>>)"
    r"""|<(?P<name>[^\s/>]+)(?P<attributes>(?>\s+[^\s=/>]+\s*=\s*(?>"[^"]*"|'[^']*'))*)"""
    r"(?P<rest>\s*)(?P<slash>/?)>",
    re.DOTALL,
)
_ATTRIBUTE = re.compile(r"""(\s+)([^\s=]+)(\s*=\s*)("[^"]*"|'[^']*')""")
_ENCODING = re.compile(rb"""<\?xml[^>]*?encoding\s*=\s*["']([\w.-]+)""")
_ENTITY = re.compile(r"&(?:#(\d+)|#x([0-9A-Fa-f]+)|(\w+));")
_SPACES = {"inkscape": INKSCAPE_SPACE, "sodipodi": SODIPODI_SPACE, "xlink": XLINK_SPACE}
"""The name spaces of what only some programs take note of, by their usual prefixes."""
_ENTITIES = {"lt": "<", "gt": ">", "amp": "&", "quot": '"', "apos": "'"}


class SourceError(Exception):
    """Source that nobody here can change in its place."""


class Node:
    """Element of the source.

    Attributes
    ----------
    name
        As it is written, with its prefix.
    children
        Elements, and what is between them as it is written.
    parent
        The element around it; None of the outermost, and of what is not in the tree.
    """

    def __init__(self, name: str, attributes: str = "", rest: str = "", *, is_empty: bool = True) -> None:
        self.name, self._attributes, self._rest, self._is_empty = name, attributes, rest, is_empty
        self.children: list[Node | str] = []
        self.parent: Node | None = None
        self._end = f"</{name}>"

    @property
    def tag(self) -> str:
        """The name without its prefix."""
        return self.name.rpartition(":")[2]

    def rename(self, tag: str, prefix: str | None = None) -> None:
        """Give it another name, with the same prefix if there is no other."""
        if (tag, prefix) != (self.tag, None):
            self.name = (self.name.removesuffix(self.tag) if prefix is None else prefix) + tag
            self._end = f"</{self.name}>"

    @property
    def elements(self) -> list[Node]:
        """The elements in it."""
        return [each for each in self.children if isinstance(each, Node)]

    def walk(self) -> Iterator[Node]:
        """Yield it and all elements in it, in the order of the file."""
        yield self
        for each in self.elements:
            yield from each.walk()

    # Attributes

    def get(self, name: str) -> str | None:
        """Return an attribute; None without."""
        found = next((each for each in _ATTRIBUTE.finditer(self._attributes) if each[2] == name), None)
        return unescaped(found[4][1:-1]) if found else None

    def set(self, name: str, value: str) -> None:
        """Set an attribute; a new one stands behind the others, and as they stand."""
        new = f'"{quoted(value)}"'
        gap = " "
        for each in _ATTRIBUTE.finditer(self._attributes):
            gap = each[1]
            if each[2] == name:
                before, after = self._attributes[: each.start(4)], self._attributes[each.end(4) :]
                self._attributes = f"{before}{new}{after}"
                return
        self._attributes += f"{gap}{name}={new}"

    def drop(self, name: str) -> None:
        """Take an attribute away."""
        for each in _ATTRIBUTE.finditer(self._attributes):
            if each[2] == name:
                self._attributes = self._attributes[: each.start()] + self._attributes[each.end() :]
                return

    @property
    def names(self) -> list[str]:
        """The names of its attributes."""
        return [each[2] for each in _ATTRIBUTE.finditer(self._attributes)]

    # Places

    def _place(self) -> tuple[Node, int]:
        assert self.parent is not None
        return self.parent, next(i for i, each in enumerate(self.parent.children) if each is self)

    def insert(self, place: int, new: Node) -> None:
        """Put an element among its children, on a line of its own if these are."""
        self._is_empty = False
        gap = next((each for each in self.children if isinstance(each, str) and not each.strip()), "")
        new.parent = self
        self.children[place:place] = [gap, new] if gap else [new]

    def put_behind(self, other: Node) -> None:
        """Put it, which is nowhere, behind another one."""
        parent, place = other._place()
        parent.insert(place + 1, self)

    def put_before(self, other: Node) -> None:
        """Put it, which is nowhere, before another one."""
        parent, place = other._place()
        has_gap = place > 0 and isinstance(parent.children[place - 1], str)
        parent.insert(place - 1 if has_gap else place, self)

    def put_last(self, parent: Node) -> None:
        """Put it, which is nowhere, at the end of another one."""
        last = max((i for i, each in enumerate(parent.children) if isinstance(each, Node)), default=-1)
        gap = parent._gap_before() if last < 0 and parent.parent is not None else ""
        if gap:
            parent.children = [each for each in parent.children if isinstance(each, Node) or each.strip()]
        parent.insert(last + 1, self)
        if gap:
            parent.children[-1:] = [f"{gap}  ", self, gap]

    def _gap_before(self) -> str:
        parent, place = self._place()
        before = parent.children[place - 1] if place else ""
        return before if isinstance(before, str) and not before.strip() else ""

    def take_out(self) -> None:
        """Take it out of the tree, with the blank line that this would leave."""
        parent, place = self._place()
        first = place - 1 if self._gap_before() else place
        del parent.children[first : place + 1]
        self.parent = None

    def write(self, into: list[str]) -> None:
        """Append its source."""
        into.append(f"<{self.name}{self._attributes}{self._rest}")
        if self._is_empty:
            into.append("/>")
            return
        into.append(">")
        for each in self.children:
            if isinstance(each, Node):
                each.write(into)
            else:
                into.append(each)
        into.append(self._end)

    def take_over(self, other: Node) -> None:
        """Become what another one is that is nowhere: with its name, its attributes and what is in it."""
        self.name, self._end, self._is_empty = other.name, other._end, other._is_empty
        self.children = other.children
        for each in self.elements:
            each.parent = self
        for name in other.names:
            self.set(name, other.get(name) or "")

    def fill(self) -> None:
        """Take note that there is something in it."""
        self._is_empty = False

    def close_with(self, end: str) -> None:
        """Take note of the tag that ends it, as it is written."""
        self._end = end


class Source:
    """A whole file.

    Attributes
    ----------
    root
        Its outermost element.
    """

    def __init__(self, data: bytes) -> None:
        match = _ENCODING.match(data.removeprefix(b"\xef\xbb\xbf")[:1000])
        self._encoding = match[1].decode() if match else "utf-8"
        try:
            text = data.decode(self._encoding)
        except (LookupError, UnicodeDecodeError) as problem:
            raise SourceError(str(problem)) from None
        around = Node("", is_empty=False)
        _fill(around, text)
        (self.root,) = around.elements
        self.root.parent, self._around = None, around

    @property
    def data(self) -> bytes:
        """The file."""
        return self.text.encode(self._encoding, "xmlcharrefreplace")

    @property
    def text(self) -> str:
        """The file as text."""
        parts: list[str] = []
        for each in self._around.children:
            if isinstance(each, Node):
                each.write(parts)
            else:
                parts.append(each)
        return "".join(parts)

    def named(self, space: str, name: str) -> str:
        """Return a name of a name space as it is written in this file, which may have to declare that."""
        prefix = self._prefix_of(space)
        return f"{prefix}:{name}" if prefix else name

    def prefixed(self, name: str) -> str:
        """Return a name with the usual prefix of a name space, or without any, as it is in this file."""
        prefix, _, own = name.rpartition(":")
        return self.named(_SPACES[prefix], own) if prefix else name

    def inkscape(self, name: str) -> str:
        """Return the name of an attribute of Inkscape's."""
        return self.named(INKSCAPE_SPACE, name)

    def sodipodi(self, name: str) -> str:
        """Return the name of an attribute of Sodipodi's."""
        return self.named(SODIPODI_SPACE, name)

    def xlink(self, name: str) -> str:
        """Return the name of an attribute of links."""
        return self.named(XLINK_SPACE, name)

    def _prefix_of(self, space: str) -> str:
        for name in self.root.names:
            if name.startswith("xmlns:") and self.root.get(name) == space:
                return name.removeprefix("xmlns:")
        prefix = next(usual for usual, each in _SPACES.items() if each == space)
        self.root.set(f"xmlns:{prefix}", space)
        return prefix

    def new(self, tag: str) -> Node:
        """Return a new element of SVG."""
        return Node(self.root.name.removesuffix(self.root.tag) + tag)

    def adopted(self, text: str) -> list[Node]:
        """Return elements of SVG that were written without a prefix, their attributes with the usual ones."""
        around = Node("", is_empty=False)
        _fill(around, text)
        prefix = self.root.name.removesuffix(self.root.tag)
        for each in around.elements:
            each.parent = None
            for node in each.walk():
                node.rename(node.tag, prefix)
                if (link := node.get(_LINK)) is not None:
                    node.drop(_LINK)
                    node.set(self.xlink("href"), link)
                if (role := node.get(ROLE)) is not None:
                    node.drop(ROLE)
                    node.set(self.sodipodi("role"), role)
        return around.elements

    @property
    def ids(self) -> set[str]:
        """All ids."""
        return {each.get("id") or "" for each in self.root.walk()}


def unescaped(text: str) -> str:
    """Return text of XML with the characters that its entities stand for."""
    return _ENTITY.sub(_character, text)


def _fill(around: Node, text: str) -> None:
    """Put what a text has into an element; it is known to be well-formed."""
    node, place = around, 0
    for token in _TOKEN.finditer(text):
        if token.start() > place:
            node.children.append(text[place : token.start()])
        place = token.end()
        if token["other"]:
            node.children.append(token[0])
        elif token["end"]:
            node.close_with(token[0])
            if node.parent is None:
                raise SourceError("it has an end more")
            node = node.parent
        else:
            new = Node(token["name"], token["attributes"], token["rest"], is_empty=bool(token["slash"]))
            new.parent = node
            node.children.append(new)
            node = node if token["slash"] else new
    if place < len(text):
        node.children.append(text[place:])
    if node is not around:
        raise SourceError("it has an end less")


def _character(match: re.Match[str]) -> str:
    decimal, hexadecimal, name = match.groups()
    if name:
        return _ENTITIES.get(name, match[0])
    return chr(int(decimal) if decimal else int(hexadecimal, 16))
