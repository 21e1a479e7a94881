"""`python -m meshwright` runs the program `meshwright`."""

import sys

from ._program import main

sys.exit(main())
