"""One participant's session: its stages, the lap, and the parts that decide what happens in it."""
