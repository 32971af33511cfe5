"""What a study is, and what it records. Knows no simulator."""
