"""Files that people write: read with their lines, checked, and faults said in one line each."""
