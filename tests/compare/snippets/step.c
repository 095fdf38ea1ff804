#include <math.h>
#include <stdio.h>

int main(void)
{
    double h, theta, omega;

    while (scanf("%lf %lf %lf", &h, &theta, &omega) == 3) {
        omega -= h / 2 * 9.81 * sin(theta);
        theta += h * omega;
        omega -= h / 2 * 9.81 * sin(theta);
        printf("%.17g %.17g\n", theta, omega);
        fflush(stdout);
    }
}
