"""The fastest tunnel through a planet of uniform density: a hypocycloid, asked as the polar brachistochrone is."""
