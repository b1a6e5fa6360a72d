use asperity::asperity::*;
use asperity::coating::*;
use asperity::interface::*;
use asperity::law::*;
use asperity::material::*;
use asperity::model::*;
fn main() {
    let m = |y, p, h| Material::new(y, p, Some(h), None).unwrap();
    let steel = m(210e9, 0.3, 7.6e9);
    let lead = m(18e9, 0.35, 0.17e9);
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global().unwrap();
    for (r, s, e) in [(2e-5, 4.8e-8, 6e10), (1.6e-6, 2.6e-7, 9e10)] {
        let pop = Population { radius: r, sigma: s, density: e, heights: HeightDensity::Gaussian };
        let set = Ordered::new(&pop.set(1_000_000, Draw::Random([1; 32])).unwrap());
        let d = Datum { mean: 0.0, sigma: s };
        let bare = Interface::bare(Zmc::default(), &steel, &steel);
        let coated: Vec<_> = [1e-8, 5e-8, 1e-6]
            .iter()
            .map(|&t| {
                Layered::new(
                    Zmc::default(),
                    &steel,
                    &steel,
                    Coating::new(&lead, &steel, t, Rule::Gao).unwrap(),
                )
            })
            .collect();
        let mut cs: Vec<&dyn MicroContact> = vec![&bare];
        for c in &coated {
            cs.push(c);
        }
        let mut best = vec![f64::MAX; 4];
        for _ in 0..5 {
            for (k, c) in cs.iter().enumerate() {
                let t = std::time::Instant::now();
                let mo = Deterministic::new(*c, &set, d);
                let mut n = 0.0;
                for k in 0..50 {
                    let r = mo.tally((4.0 - 4.0 * k as f64 / 49.0) * s);
                    n += r.contacts();
                    std::hint::black_box(r);
                }
                best[k] = best[k].min(t.elapsed().as_secs_f64() * 1e9 / n);
            }
        }
        println!("{best:?} ns a contact; ratios {:?}", best.iter().map(|b| b / best[0]).collect::<Vec<_>>());
    }
}
