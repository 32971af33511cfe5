"""The studies of a reproduction of the paper, listed and run."""
