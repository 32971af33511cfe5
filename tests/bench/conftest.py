"""Makes the benchmark's modules importable, as they are when it runs as a script."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "bench"))
