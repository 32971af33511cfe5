"""Imported before numpy: one thread per process, or CPU time would count idle spinning."""

import os

for _library in ("OPENBLAS", "OMP", "MKL"):
    os.environ[f"{_library}_NUM_THREADS"] = "1"
