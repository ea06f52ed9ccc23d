"""The overlays, one or two a module, with all that is known of them: `OVERLAYS` finds the records."""
