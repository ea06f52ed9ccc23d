"""The error of import and export."""


class ExchangeError(ValueError):
    """A document cannot be exported, or a file not be imported, as asked; the message says why."""
