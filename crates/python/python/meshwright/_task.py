"""Runs the program `meshwright` as a process of a batch. The process ends when the process that started it ends."""

from __future__ import annotations

import os
import sys
import threading

from . import _core


def end_with_parent() -> None:
    """Ends this process when the pipe to its parent closes. The pipe also closes if the parent is killed."""
    sys.stdin.buffer.read()
    os._exit(1)


if __name__ == "__main__":
    threading.Thread(target=end_with_parent, daemon=True).start()
    code = _core.program(["meshwright", *sys.argv[1:]])
    sys.stdout.flush()
    os._exit(code)
