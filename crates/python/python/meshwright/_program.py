"""The program `meshwright`, which the package contains."""

from __future__ import annotations

import signal
import sys

from . import _core


def main() -> int:
    """Runs the program with the arguments of this process."""
    # The program handles Ctrl-C itself.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    return _core.program(["meshwright", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
