"""The groups of the dataset: for each family its layouts, and the numbers that the profiles put on them."""
