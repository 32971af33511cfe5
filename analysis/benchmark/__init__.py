"""What a benchmark of assistants found: measures by lap, and a table that ranks."""
