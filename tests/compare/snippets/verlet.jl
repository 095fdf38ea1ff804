let g = 9.81, length = 1.0, h = 1 / 64, theta = 1.0, omega = 0.0
    println("t,theta,omega")
    for n in 0:64
        println(n * h, ",", theta, ",", omega)
        omega -= h / 2 * g / length * sin(theta)
        theta += h * omega
        omega -= h / 2 * g / length * sin(theta)
    end
end
