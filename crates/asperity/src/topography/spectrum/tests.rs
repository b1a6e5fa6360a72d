use super::*;

#[test]
fn the_shortest_wave_lies_across_a_lay() {
    let self_affine = SpectrumShape::SelfAffine { hurst: 0.8, roll_off: 40.0, cut_off: 8.0 };
    for (shape, elongation, shortest) in [
        (self_affine, 1.0, Some(8.0)),
        (self_affine, 5.0, Some(8.0)),
        (self_affine, 0.5, Some(4.0)),
        (SpectrumShape::Gaussian(3.0), 1.0, Some(3.0)),
        (SpectrumShape::Exponential(3.0), 1.0, None),
    ] {
        let spectrum = Spectrum::new(shape, Lay { elongation, angle: 0.0 }).unwrap();
        assert_eq!(spectrum.shortest_wave(), shortest, "{shape:?} {elongation}");
    }
}

/// The autocorrelation that the waves of a spectrum have on the grid, the mean wave among them.
fn realised(spectrum: &GridSpectrum, points: [usize; 2]) -> Vec<f64> {
    let fill = |j: usize, waves: &mut [Complex<f64>]| {
        let mut deviations = vec![0.0; waves.len()];
        spectrum.column(j, &mut deviations);
        if j == 0 {
            deviations[0] = spectrum.mean_variance().sqrt();
        }
        for (wave, deviation) in waves.iter_mut().zip(deviations) {
            *wave = Complex::new(deviation * deviation, 0.0);
        }
    };
    synthesise(points, fill, |_| ((points[0] * points[1]) as f64).recip(), &Silent)
}

/// Up to the longest correlation length that a map may have, the grid's autocorrelation is the prescribed one,
/// wrapped around the map: also its kink, or its curvature, at the origin.
#[test]
fn autocorrelations_on_a_grid_are_exact() {
    let (points, pixel) = ([100, 84], [1.0, 1.2]);
    let turned = Lay { elongation: 2.0, angle: 0.6 };
    for (shape, lay) in [
        (SpectrumShape::Exponential(10.0), Lay::default()),
        (SpectrumShape::Gaussian(10.0), Lay::default()),
        (SpectrumShape::Exponential(5.0), turned),
        (SpectrumShape::Gaussian(5.0), turned),
        (SpectrumShape::Gaussian(1.3), Lay::default()),
    ] {
        let spectrum = Spectrum::new(shape, lay).unwrap();
        spectrum.check(points, pixel).unwrap();
        let found = realised(&spectrum.on_grid(points, pixel), points);
        for (i, j) in [(0, 0), (1, 0), (0, 1), (1, 1), (1, 83), (99, 0), (50, 42), (7, 80), (2, 0)] {
            let mut exact = 0.0;
            for a in -12..=12 {
                for b in -12..=12 {
                    let x = (f64::from(i) + 100.0 * f64::from(a)) * pixel[0];
                    let y = (f64::from(j) + 84.0 * f64::from(b)) * pixel[1];
                    exact += spectrum.autocorrelation([x, y]).unwrap();
                }
            }
            let gap = found[i as usize * points[1] + j as usize] - exact;
            assert!(gap.abs() < 2e-12, "{shape:?} {lay:?} {i} {j}: {gap}");
        }
    }
}

#[test]
fn lengths_are_held_against_the_side_that_they_lie_along() {
    let lay = |elongation, angle| Lay { elongation, angle };
    let check = |shape, lay, points| Spectrum::new(shape, lay).unwrap().check(points, [1.0; 2]);
    let along_x = lay(10.0, 0.0);
    let along_y = lay(10.0, std::f64::consts::FRAC_PI_2);
    assert!(check(SpectrumShape::Gaussian(5.0), along_x, [500, 50]).is_ok());
    assert!(check(SpectrumShape::Exponential(5.1), along_x, [600, 50]).is_err(), "longer than a tenth of y");
    assert!(check(SpectrumShape::Gaussian(5.0), along_y, [500, 50]).is_err());
    assert!(check(SpectrumShape::Gaussian(5.0), along_y, [50, 500]).is_ok());
    let affine = |roll_off, cut_off| SpectrumShape::SelfAffine { hurst: 0.8, roll_off, cut_off };
    assert!(check(affine(20.0, 4.0), along_x, [200, 20]).is_ok());
    assert!(check(affine(20.0, 4.0), lay(10.0, 0.1), [200, 20]).is_err());
    // Across the lay waves are short, along it long: what counts is the shortest along each axis.
    assert!(check(affine(20.0, 4.0), lay(0.4, 0.0), [64, 64]).is_err());
    assert!(check(affine(20.0, 4.0), lay(0.5, 0.0), [64, 64]).is_ok());
    assert!(Spectrum::new(affine(3.0, 4.0), Lay::default()).is_err());
    assert!(Spectrum::new(SpectrumShape::Gaussian(f64::NAN), Lay::default()).is_err());
}

/// Persson et al. 2005, with the lay turned to the x axis.
#[test]
fn self_affine_waves_are_those_of_the_definition() {
    let (points, pixel) = ([50, 36], [1.0, 1.5]);
    let (hurst, roll_off, cut_off) = (0.7, 20.0, 6.0);
    for (elongation, angle) in [(1.0, 0.0), (2.0, 0.0), (2.0, 0.6), (0.5, -0.6)] {
        let shape = SpectrumShape::SelfAffine { hurst, roll_off, cut_off };
        let grid = Spectrum::new(shape, Lay { elongation, angle }).unwrap().on_grid(points, pixel);
        let mut waves = vec![0.0; points[0]];
        for j in 0..=points[1] / 2 {
            grid.column(j, &mut waves);
            for (i, wave) in waves.iter().enumerate().skip(usize::from(j == 0)) {
                let i = if 2 * i > points[0] { i as f64 - points[0] as f64 } else { i as f64 };
                let [x, y] = [i / (points[0] as f64 * pixel[0]), j as f64 / (points[1] as f64 * pixel[1])];
                let along = elongation * (x * f64::cos(angle) + y * f64::sin(angle));
                let q = along.hypot(y * f64::cos(angle) - x * f64::sin(angle));
                let density = (q * roll_off).max(1.0).powf(-2.0 * (1.0 + hurst));
                let exact = if q * cut_off > 1.0 + 1e-9 { 0.0 } else { density };
                assert!((wave * wave - exact).abs() < 1e-12 * density, "{elongation} {angle}: {i} {j}");
            }
        }
    }
}

/// Its ends are the two spectra, and in between amplitudes beyond both roll-offs do not change.
#[test]
fn between_two_spectra() {
    let points = [96, 80];
    let lay = Lay { elongation: 1.7, angle: 0.4 };
    let amplitudes = |shape| {
        let spectrum = Spectrum::new(shape, lay).unwrap().on_grid(points, [1.0; 2]);
        let mut waves = vec![0.0; points[0]];
        (0..points[1] / 2 + 1)
            .flat_map(|j| {
                spectrum.column(j, &mut waves);
                waves.clone()
            })
            .collect::<Vec<f64>>()
    };
    let (hurst, roll_offs, cut_off) = (0.7, [18.0, 20.0], 6.0);
    let between = |weight| amplitudes(SpectrumShape::Between { hurst, roll_offs, weight, cut_off });
    let ends = [between(0.0), between(1.0)];
    for (end, roll_off) in ends.iter().zip(roll_offs) {
        let single = amplitudes(SpectrumShape::SelfAffine { hurst, roll_off, cut_off });
        let largest = single.iter().copied().fold(0.0, f64::max) / end.iter().copied().fold(0.0, f64::max);
        assert!(end.iter().zip(&single).all(|(a, b)| (largest * a - b).abs() < 1e-14), "{roll_off}");
    }
    let sum = between(0.3);
    let mut differ = 0;
    for ((a, b), sum) in ends[0].iter().zip(&ends[1]).zip(sum) {
        assert!((0.7 * a + 0.3 * b - sum).abs() < 1e-14);
        differ += usize::from((a - b).abs() > 1e-14);
    }
    let waves = ends[0].iter().filter(|amplitude| **amplitude > 0.0).count();
    assert!(0 < differ && 2 * differ < waves, "{differ} of {waves}");
    let refused = |roll_offs, weight| {
        Spectrum::new(SpectrumShape::Between { hurst, roll_offs, weight, cut_off }, lay).is_err()
    };
    assert!(refused([20.0, 18.0], 0.5) && refused(roll_offs, 1.1) && refused([5.0, 18.0], 0.5));
    assert!(!refused(roll_offs, 0.5));
}
