"""Three independent routes to one number: heyoka's Taylor method, mpmath's quadrature, Arb's balls."""
