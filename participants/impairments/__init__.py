"""How a body changes what a participant intends; each wraps any driver, one file each."""
