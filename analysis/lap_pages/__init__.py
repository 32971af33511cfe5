"""Laps as interactive pages: one self-contained file, all of it from the record."""
