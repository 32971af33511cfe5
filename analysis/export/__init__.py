"""A study in other people's formats: what may leave it, and one file for each format."""
