"""The human-like driver: looks ahead, reacts late, slows for corners, and learns."""
