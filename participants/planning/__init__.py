"""From a course to a way through it, and from a scan to how far the chair can go."""
