"""A map that a robot has drawn of a building becomes a course."""
