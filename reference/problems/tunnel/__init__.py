"""The fastest tunnel through a planet of uniform density: a hypocycloid, asked as the polar brachistochrone is."""

from reference.problems.tunnel.problem import Tunnel

__all__ = ["Tunnel"]
