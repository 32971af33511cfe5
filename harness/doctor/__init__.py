"""What this machine has, and what is missing for what somebody may want to do on it."""
