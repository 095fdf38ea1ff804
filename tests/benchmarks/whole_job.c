/* The whole job of whole_job.py as one would write it in C: every method, amplitude and N, one after another.

   Reads the amplitudes and, for each, 128 exact angles; writes the largest error at those times and the largest
   energy error over every step, relative to the energy above rest. */
#include <math.h>
#include <stdio.h>

#define AMPLITUDES 16
#define SAMPLES 128
#define FIRST 7
#define LAST 20

static const double g = 9.81, l = 1.0, t_end = 10.0;
static double drift4[4], kick4[3], drift6[8], kick6[7];

static inline double acceleration(double q) { return -(g / l) * sin(q); }

static inline double energy(double q, double v) {
    double s = sin(q / 2);
    return v * v / 2 + 2 * (g / l) * s * s;
}

#define MARCH(NAME, BEFORE, ...) \
    static void NAME(double q, double h, long n, const double *exact, double *out) { \
        double v = 0, level = energy(q, v), most = 0, error = 0; \
        long every = n / SAMPLES; \
        BEFORE \
        for (long i = 1; i <= n; i++) { \
            __VA_ARGS__ \
            double off = fabs(energy(q, v) - level); \
            if (off > most) most = off; \
            if (i % every == 0) { \
                double e = fabs(q - *exact++); \
                if (e > error) error = e; \
            } \
        } \
        out[0] = error; \
        out[1] = most / level; \
    }

MARCH(euler, , double a = acceleration(q); q += h * v; v += h * a;)
MARCH(symplectic_euler, , v += h * acceleration(q); q += h * v;)
MARCH(verlet, double a = acceleration(q);, v += h / 2 * a; q += h * v; a = acceleration(q); v += h / 2 * a;)
MARCH(rk4, ,
      double k1 = v, a1 = acceleration(q);
      double k2 = v + h / 2 * a1, a2 = acceleration(q + h / 2 * k1);
      double k3 = v + h / 2 * a2, a3 = acceleration(q + h / 2 * k2);
      double k4 = v + h * a3, a4 = acceleration(q + h * k3);
      q += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
      v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);)
MARCH(yoshida4, ,
      for (int j = 0; j < 3; j++) { q += h * drift4[j] * v; v += h * kick4[j] * acceleration(q); }
      q += h * drift4[3] * v;)
MARCH(yoshida6, ,
      for (int j = 0; j < 7; j++) { q += h * drift6[j] * v; v += h * kick6[j] * acceleration(q); }
      q += h * drift6[7] * v;)

static void compose(const double *weights, int count, double *drift, double *kick) {
    for (int j = 0; j <= count; j++)
        drift[j] = ((j > 0 ? weights[j - 1] : 0) + (j < count ? weights[j] : 0)) / 2;
    for (int j = 0; j < count; j++) kick[j] = weights[j];
}

int main(int argc, char **argv) {
    const double w = 1 / (2 - cbrt(2.0)), weights4[3] = {w, 1 - 2 * w, w};
    const double weights6[7] = {0.78451361047755726382, 0.23557321335935813368, -1.17767998417887100695,
                                1.31518632068391121889, -1.17767998417887100695, 0.23557321335935813368,
                                0.78451361047755726382};
    void (*marches[6])(double, double, long, const double *, double *) = {euler, symplectic_euler, verlet,
                                                                            rk4,   yoshida4,         yoshida6};
    double amplitudes[AMPLITUDES], exact[AMPLITUDES][SAMPLES], out[2];
    FILE *in = argc == 3 ? fopen(argv[1], "rb") : NULL, *to = argc == 3 ? fopen(argv[2], "wb") : NULL;
    if (!in || !to || fread(amplitudes, sizeof amplitudes, 1, in) != 1 || fread(exact, sizeof exact, 1, in) != 1)
        return 2;
    compose(weights4, 3, drift4, kick4);
    compose(weights6, 7, drift6, kick6);
    for (int m = 0; m < 6; m++)
        for (int a = 0; a < AMPLITUDES; a++)
            for (int k = FIRST; k <= LAST; k++) {
                marches[m](amplitudes[a], t_end / (1L << k), 1L << k, exact[a], out);
                fwrite(out, sizeof out, 1, to);
            }
    return fclose(to) != 0;
}
