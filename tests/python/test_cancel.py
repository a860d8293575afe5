"""Signals, as that of Ctrl-C, reach long work while it runs."""

from __future__ import annotations

import os
import signal
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
import pytest

import derham


class Stop(Exception):
    pass


@contextmanager
def stop_after(seconds: float) -> Iterator[None]:
    def handler(*_: object) -> None:
        raise Stop

    before = signal.signal(signal.SIGALRM, handler)
    signal.setitimer(signal.ITIMER_REAL, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def seconds_of_product(K: derham.Complex, w: np.ndarray, out: np.ndarray) -> float:
    start = time.perf_counter()
    K.apply_d(w, 1, out=out)
    return time.perf_counter() - start


@pytest.mark.parametrize("threads", [1, 2])
def test_a_signal_ends_a_product_before_its_end(threads: int) -> None:
    K = derham.generate.box(3, 40)  # many blocks
    columns = 16
    before = derham.thread_count()
    derham.set_thread_count(threads)
    try:
        while True:  # until a product takes three tenths of a second on this machine
            w = np.ones((K.size(1), columns))
            out = np.ones((K.size(2), columns))  # so that its memory is there before it is timed
            if seconds_of_product(K, w, out) > 0.3:
                break
            columns *= 2
        out[:] = np.nan
        with pytest.raises(Stop), stop_after(0.01):
            K.apply_d(w, 1, out=out)
        assert np.isnan(out).any()
        seconds_of_product(K, w, out)
        assert not np.isnan(out).any()
    finally:
        derham.set_thread_count(before)


def test_other_threads_are_not_interrupted() -> None:
    sizes: list[tuple[int, ...]] = []
    with pytest.raises(Stop), stop_after(0.2):
        worker = threading.Thread(target=lambda: sizes.append(derham.generate.box(3, 60).sizes))
        worker.start()
        time.sleep(5)
    worker.join()
    assert sizes[0][3] == 6 * 60**3


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork")
@pytest.mark.filterwarnings("ignore::DeprecationWarning")
def test_the_thread_that_forks_is_the_main_one_of_the_child() -> None:
    def child() -> int:
        """The exit code: 0 if the work was stopped before its end."""
        K = derham.generate.box(3, 20)
        derham.set_thread_count(1)
        out = np.full((K.size(2), 400), np.nan)
        try:
            with stop_after(0.01):
                K.apply_d(np.ones((K.size(1), 400)), 1, out=out)
        except Stop:
            return 0 if np.isnan(out).any() else 1
        return 2

    def fork() -> None:
        pid = os.fork()
        if pid == 0:
            code = 3
            try:
                code = child()
            finally:
                os._exit(code)
        codes.append(os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]))

    codes: list[int] = []
    worker = threading.Thread(target=fork)
    worker.start()
    worker.join()
    assert codes == [0]


def test_a_construction_that_was_stopped_leaves_nothing_behind() -> None:
    rows = derham.generate.box(3, 50).simplices(3)
    for delay in (0.01, 0.05, 0.1, 0.15):
        try:
            with stop_after(delay):
                derham.Complex(rows).check()
        except Stop:
            pass
    assert derham.Complex(rows).sizes[3] == len(rows)
