"""Files that people write: read with their lines, checked, and each fault reported in one line."""
