"""What derham raises. Each error is also the builtin one that a caller would expect."""

from __future__ import annotations


class Error(Exception):
    """The root of everything that derham raises."""


class InputError(Error, ValueError):
    """An argument has a wrong shape, range or value. `row` is the first offending row of the input, or -1."""

    def __init__(self, message: str, row: int = -1) -> None:
        super().__init__(message)
        self.row = row


class TopologyError(Error, ValueError):
    """A complex lacks a topological property that was demanded: purity, manifold, orientability."""


class GeometryError(Error, ValueError):
    """A metric quantity does not exist: no metric, a flat simplex, a position that is not finite, a zero dual volume."""


class LimitError(Error, OverflowError):
    """Something does not fit: the index type, or a stated bound on size."""


class FileError(Error, OSError):
    """A file cannot be read, parsed or written. `line` is 0 where no line applies; `action` is "read" or "write"."""

    def __init__(self, message: str, path: str = "", line: int = 0, action: str = "read") -> None:
        super().__init__(message)
        self.path = path
        self.line = line
        self.action = action
