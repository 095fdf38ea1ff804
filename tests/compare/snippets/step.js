const lines = require("readline").createInterface({ input: process.stdin });

lines.on("line", (line) => {
  let [h, theta, omega] = line.split(" ").map(Number);
  omega -= h / 2 * 9.81 * Math.sin(theta);
  theta += h * omega;
  omega -= h / 2 * 9.81 * Math.sin(theta);
  console.log(theta + " " + omega);
});
