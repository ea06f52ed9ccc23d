"""The plots over t, one or several a module, with all that is known of them: `PLOTS` finds the records."""
