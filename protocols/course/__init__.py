"""Courses: what a course file may say, and the geometry that follows from it."""
