"""The cycloid: the curve of quickest descent to any end point, and the tautochrone, Huygens' pendulum."""
