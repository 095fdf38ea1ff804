g = 9.81; len = 1; h = 1 / 64;
theta = 1; omega = 0;

fprintf('t,theta,omega\n');
for n = 0:64
    fprintf('%.17g,%.17g,%.17g\n', n * h, theta, omega);
    omega = omega - h / 2 * g / len * sin(theta);
    theta = theta + h * omega;
    omega = omega - h / 2 * g / len * sin(theta);
end
