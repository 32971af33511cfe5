"""The studies that a reproduction of the paper stands on, planned and run."""
