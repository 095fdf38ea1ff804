"""What a step is: a class for each kind of method, its coefficients exact."""
