"""The tools that a person chooses for the canvas: `TOOLS` finds the records in the files of this package."""
