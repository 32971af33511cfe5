"""What a participant's body does to its own intention; each wraps any driver, one file each."""
