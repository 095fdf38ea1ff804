from math import sin

g, length, h = 9.81, 1.0, 1 / 64
theta, omega = 1.0, 0.0

print("t,theta,omega")
for n in range(65):
    print(n * h, theta, omega, sep=",")
    omega -= h / 2 * g / length * sin(theta)
    theta += h * omega
    omega -= h / 2 * g / length * sin(theta)
