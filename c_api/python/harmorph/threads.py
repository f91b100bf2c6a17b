"""Executors: the kernel for this processor, and pools of threads for large meshes."""

from __future__ import annotations

import os
import weakref
from typing import Any

from ._native import ffi, lib
from .errors import Error
from .reports import new


class Executor:
    """Threads that the library may use in one call at a time.

    Parameters
    ----------
    threads : int
        1 .. 256. With 1, everything runs on the calling thread, and any number of Python threads
        may use the executor at once.

    Attributes
    ----------
    view : cdata
        The ``hm_executor*`` for the library.
    threads : int
        The number of threads that could be started.
    """

    def __init__(self, threads: int = 1) -> None:
        if not isinstance(threads, int) or not 1 <= threads <= 256:
            raise Error(f"The number of threads must be an integer between 1 and 256, not {threads!r}.")
        self.view: Any
        if threads == 1:
            self.view = new("hm_executor")
            self.view.n_threads = 1
            self.view.kernel = lib.hm_best_kernel()
        else:
            pool = ffi.new("hm_pthreads*")
            self.view = ffi.new("hm_executor*", lib.hm_pthreads_start(pool, threads))
            weakref.finalize(self, _stop, pool, os.getpid())
        self.threads: int = self.view.n_threads


def _stop(pool: Any, process: int) -> None:
    # The threads of a pool do not exist in a process that was forked; there the calling thread
    # does all tasks, and nothing has to be stopped.
    if os.getpid() == process:
        lib.hm_pthreads_stop(pool)


ONE_THREAD = Executor(1)
