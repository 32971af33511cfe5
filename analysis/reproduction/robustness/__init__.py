"""Whether the finding survives other parameters, and what simpler models make of the same laps."""
