"""``python -m zeroset`` is ``zeroset``."""

import sys

from zeroset.cli import main

sys.exit(main())
