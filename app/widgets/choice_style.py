"""Style sheet of small buttons that switch something: plain to see which are on, in light and in dark."""

from __future__ import annotations

from ..appearance.theme import Theme, mix


def choice_style(theme: Theme) -> str:
    """Return the style sheet for the QToolButtons of a header."""
    shape = "border-radius: 4px; padding: 2px 5px"
    accent, chosen = theme.accent.name(), mix(theme.accent, theme.surface, 0.14).name()
    return (
        f"QToolButton {{ border: 1px solid {theme.grid_coarse.name()}; {shape} }}"
        f"QToolButton:hover {{ background: {mix(theme.ink, theme.surface, 0.07).name()} }}"
        f"QToolButton:checked {{ background: {chosen}; color: {accent}; border-color: {accent} }}"
        f"QToolButton:focus {{ border-color: {accent} }}"
    )
