//! Bounds of the error by the grid. That they hold is tested in `asperity-evidence`, against the same waves on a finer grid.

use asperity::bem::{Boundary, GridError};

use super::{options, paraboloid, rough, solved};

/// The narrower the contact in points and the fewer there are, the larger the bounds; full contact has no border.
#[test]
fn bounds_grow_with_the_pixel_and_vanish_without_a_border() {
    let all = [4, 8, 16, 32].map(|pixels| {
        let (map, _) = paraboloid(3 * pixels, 0.1 / pixels as f64);
        GridError::new(&solved(&map, options(Boundary::Finite, 1e-8, None), 4.0 / 3.0 * 1e-3 / 0.09))
    });
    for pair in all.windows(2) {
        assert!(pair[1].area < pair[0].area && pair[1].load < pair[0].load);
        assert!(pair[1].stiffness < pair[0].stiffness);
    }
    let map = rough([64, 64], 0.8, 0.9, 0.1, 4);
    let full = GridError::new(&solved(&map, options(Boundary::Periodic, 1e-8, None), 50.0));
    assert_eq!(full, GridError { area: 0.0, load: 0.0, stiffness: 0.0 });
}
