"""Where laps are driven: the seam every world fits, and the one in PyBullet."""
