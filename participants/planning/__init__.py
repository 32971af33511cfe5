"""The way through a course, and how far the chair can go according to a scan."""
