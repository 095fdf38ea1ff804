program verlet
    implicit none
    integer, parameter :: real64 = selected_real_kind(15)
    real(real64), parameter :: g = 9.81_real64, length = 1, h = 1 / 64.0_real64
    real(real64) :: theta = 1, omega = 0
    integer :: n

    print '(a)', 't theta omega'
    do n = 0, 64
        print '(3es25.16e3)', n * h, theta, omega
        omega = omega - h / 2 * g / length * sin(theta)
        theta = theta + h * omega
        omega = omega - h / 2 * g / length * sin(theta)
    end do
end program verlet
