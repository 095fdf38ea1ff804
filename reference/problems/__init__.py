"""The families: each folder holds its equations, its closed form, and how the other routes read them."""
