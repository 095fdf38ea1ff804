typedef void (*rhs)(double t, const double *y, double *dydt);

void rk4(rhs f, int n, double t, double h, const double *y, double *ynew)
{
    double k1[n], k2[n], k3[n], k4[n], z[n];

    f(t, y, k1);
    for (int i = 0; i < n; i++) z[i] = y[i] + h / 2 * k1[i];
    f(t + h / 2, z, k2);
    for (int i = 0; i < n; i++) z[i] = y[i] + h / 2 * k2[i];
    f(t + h / 2, z, k3);
    for (int i = 0; i < n; i++) z[i] = y[i] + h * k3[i];
    f(t + h, z, k4);
    for (int i = 0; i < n; i++) ynew[i] = y[i] + h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
}
