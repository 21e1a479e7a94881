"""`python -m meshwright` is the program `meshwright`."""

import sys

from ._program import main

sys.exit(main())
