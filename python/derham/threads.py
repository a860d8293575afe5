"""On how many threads the library works."""

from __future__ import annotations

from . import _derham
from ._arguments import whole_number


def thread_count() -> int:
    """The number of threads that heavy work is divided among: at first, that of the processors."""
    return _derham.thread_count()


def set_thread_count(count: int) -> None:
    """Every result has the same bits for any number of threads. Raises InputError unless it is at least 1."""
    _derham.set_thread_count(whole_number(count, "the number of threads", 1, 2**31 - 1))
