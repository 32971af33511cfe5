"""Whether the finding holds with other parameters, and with simpler models on the same laps."""
