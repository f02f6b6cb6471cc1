//! A rope of 50 links, 3 m long, hangs between two points 2 m apart: how far it sags, against the closed form.

use tautline::{Error, Rope, Settings, Vec3, World};

const SPAN: f64 = 2.0;
const LENGTH: f64 = 3.0;

fn main() -> Result<(), Error> {
    let settings = Settings { substeps: 16, damping: 1.0, ..Settings::default() };
    let mut world = World::new(settings)?;
    let ends = [Vec3::ZERO, Vec3::X * SPAN as f32];
    let rope = Rope::straight(ends[0], ends[1], 50).length(LENGTH as f32).pin(0).pin(50);
    let rope = world.add(rope)?;
    for _ in 0..20 * 60 {
        world.step(1.0 / 60.0)?;
    }

    let lowest = world.body(rope)?.positions().iter().map(|p| f64::from(p.y)).fold(0.0, f64::min);
    let (sag, exact) = (-lowest, catenary_sag());
    let error = (sag / exact - 1.0).abs();
    println!("sag {sag:.4} m; catenary {exact:.4} m; off by {:.2} %", 100.0 * error);
    assert!(error < 0.02);
    Ok(())
}

/// y = a cosh(x/a) between supports `SPAN` apart has the length 2a sinh(SPAN/2a), which falls as a grows: a is
/// found by bisection. Its sag is a (cosh(SPAN/2a) − 1).
fn catenary_sag() -> f64 {
    let (mut low, mut high) = (0.1, 100.0);
    for _ in 0..60 {
        let a: f64 = (low + high) / 2.0;
        let too_long = 2.0 * a * (SPAN / (2.0 * a)).sinh() > LENGTH;
        if too_long { low = a } else { high = a }
    }
    low * ((SPAN / (2.0 * low)).cosh() - 1.0)
}
