"""Whether a model taught on one course helps on another, and where it should not."""
