"""Proofs of order, and of stability where it has one."""
