const g = 9.81, length = 1, h = 1 / 64;
let theta = 1, omega = 0;

console.log("t,theta,omega");
for (let n = 0; n <= 64; n++) {
  console.log([n * h, theta, omega].join());
  omega -= h / 2 * g / length * Math.sin(theta);
  theta += h * omega;
  omega -= h / 2 * g / length * Math.sin(theta);
}
