"""The figures of the two sources, drawn again from the reference: `python -m compare published figures --out DIR`."""
