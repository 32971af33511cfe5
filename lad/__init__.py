"""Learning Assistance by Demonstration: when to help, and how. Knows no simulator."""
