"""What is wrong in the two published sources, each slip with a check that fails if it were none."""
