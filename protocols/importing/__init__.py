"""What others recorded, drew or asked becomes a study, a course or answers."""
