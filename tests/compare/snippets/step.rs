use std::io::{stdin, BufRead};

fn main() {
    for line in stdin().lock().lines() {
        let numbers: Vec<f64> = line.unwrap().split(' ').map(|word| word.parse().unwrap()).collect();
        let (h, mut theta, mut omega) = (numbers[0], numbers[1], numbers[2]);
        omega -= h / 2.0 * 9.81 * theta.sin();
        theta += h * omega;
        omega -= h / 2.0 * 9.81 * theta.sin();
        println!("{} {}", theta, omega);
    }
}
