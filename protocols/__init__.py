"""What a study is, and what it leaves behind. Knows no simulator."""
