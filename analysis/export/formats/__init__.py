"""The formats that ship, one file each: ``write(content, folder, tell)``."""
