"""Studies that other programs recorded: what is recognised, repaired with a word, or refused."""
