"""The wheelchair as everybody knows it: its size and what it can do.

A paediatric powered wheelchair like ARTY's (Soh & Demiris 2014, section V); the top speeds are
those of section IV.A.
"""

MAX_SPEED = 0.7
"""Top translational speed, m/s."""

MAX_TURN_RATE = 0.5
"""Top rotational speed, rad/s."""

ACCELERATION = 0.7
"""Translational acceleration the controller allows, m/s^2, speeding up and braking."""

TURN_ACCELERATION = 1.5
"""Rotational acceleration the controller allows, rad/s^2."""
