g <- 9.81; length <- 1; h <- 1 / 64
theta <- 1; omega <- 0

cat("t,theta,omega\n")
for (n in 0:64) {
    cat(sprintf("%.17g,%.17g,%.17g\n", n * h, theta, omega))
    omega <- omega - h / 2 * g / length * sin(theta)
    theta <- theta + h * omega
    omega <- omega - h / 2 * g / length * sin(theta)
}
