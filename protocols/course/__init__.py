"""Courses: the fields of a course file, and the geometry that follows from it."""
