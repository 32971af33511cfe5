"""Recordings of a real wheelchair become a study: the record of laps that nobody simulated."""
