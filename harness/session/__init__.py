"""One participant's visit: its stages, the lap, and everything that decides what happens in one."""
