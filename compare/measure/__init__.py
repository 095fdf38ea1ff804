"""What is measured of a march against the proven truth, and the records that hold it."""
