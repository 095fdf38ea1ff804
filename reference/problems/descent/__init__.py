"""Descent on a curve: a body released at rest slides down without friction in uniform gravity."""
