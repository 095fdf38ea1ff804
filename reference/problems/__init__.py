"""The families: each module holds its equations, its closed form and its routes."""
