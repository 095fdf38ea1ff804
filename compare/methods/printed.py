"""Tables as they are printed: lines of fractions."""

from compare.methods.order.algebraic import Q

__all__ = ["line", "lines"]


def line(text: str) -> tuple[Q, ...]:
    """The fractions of one line, such as "3/40 9/40"."""
    return tuple(Q(word) for word in text.split())


def lines(*texts: str) -> tuple[tuple[Q, ...], ...]:
    """The rows of a matrix, a line each; the first row of an explicit method is empty."""
    return tuple(line(text) for text in texts)
