"""Section IV of Soh & Demiris (2013), reproduced: each of its figures and numbers beside ours."""
