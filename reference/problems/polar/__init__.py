"""The brachistochrone in an inverse-square field: z = r/r0 from rest at z = 1 through the lowest point z0."""
