"""XML without a DOCTYPE: what stands in one may be a bomb, or lead to other files."""

from __future__ import annotations

from defusedxml.ElementTree import DefusedXMLParser

from app.exchange.drawing import ExchangeError

_WITH_ENTITIES = (
    "The file declares entities or a DTD in its DOCTYPE, and those are not read. Save it as plain SVG; or, "
    "where no “&name;” stands in the file, delete all from “<!DOCTYPE” to “]>” in a text editor."
)
_PLAIN = (
    "The file has a DOCTYPE, and those are not read. In a text editor, delete the line that begins with "
    "“<!DOCTYPE”, up to its “>”; the drawing does not need it."
)


class Parser(DefusedXMLParser):  # type: ignore[misc]  # that package has no types
    """Refuses every DOCTYPE, and says how to do without it."""

    def __init__(self, target: object) -> None:
        super().__init__(target=target, forbid_dtd=True)

    def defused_start_doctype_decl(  # noqa: D102 - the parser calls it
        self, name: str, sysid: str | None, pubid: str | None, has_internal_subset: int
    ) -> None:
        raise ExchangeError(_WITH_ENTITIES if has_internal_subset else _PLAIN)
