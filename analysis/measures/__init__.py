"""Measures of one lap: its steps in, one number out, one file each."""
