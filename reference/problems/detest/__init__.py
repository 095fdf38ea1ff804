"""The 25 smooth problems of the nonstiff DETEST, from A1 to E5."""
