"""The paper's Figures 3 and 4, drawn from our records."""
