fn main() {
    let (g, length, h) = (9.81, 1.0, 1.0 / 64.0);
    let (mut theta, mut omega): (f64, f64) = (1.0, 0.0);

    println!("t,theta,omega");
    for n in 0..=64 {
        println!("{},{},{}", f64::from(n) * h, theta, omega);
        omega -= h / 2.0 * g / length * theta.sin();
        theta += h * omega;
        omega -= h / 2.0 * g / length * theta.sin();
    }
}
