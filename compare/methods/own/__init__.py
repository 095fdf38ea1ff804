"""Methods of a user's own: how their functions are called, made methods of, and kept from harm."""
