"""Section IV of Soh & Demiris (2013), reproduced: each figure and number of theirs beside ours."""
