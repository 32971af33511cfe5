"""The wheelchair world, the lap, the session, the runner and the command line."""
