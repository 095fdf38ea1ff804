for line in eachline()
    h, theta, omega = parse.(Float64, split(line))
    omega -= h / 2 * 9.81 * sin(theta)
    theta += h * omega
    omega -= h / 2 * 9.81 * sin(theta)
    println(theta, " ", omega)
    flush(stdout)
end
