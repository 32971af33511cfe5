"""Figures: frames in, one matplotlib ``Figure`` out, one file each. No pyplot, no global state."""
