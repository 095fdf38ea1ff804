#include <math.h>
#include <stdio.h>

int main(void)
{
    const double g = 9.81, length = 1.0, h = 1.0 / 64;
    double theta = 1.0, omega = 0.0;

    printf("t,theta,omega\n");
    for (int n = 0; n <= 64; n++) {
        printf("%.17g,%.17g,%.17g\n", n * h, theta, omega);
        omega -= h / 2 * g / length * sin(theta);
        theta += h * omega;
        omega -= h / 2 * g / length * sin(theta);
    }
}
