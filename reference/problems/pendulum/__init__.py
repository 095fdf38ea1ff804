"""The mathematical pendulum: theta'' = -(g/l) sin theta, released from rest or set going; linearised; in series."""
