"""The two published documents: their tables, their figures and their errata."""
