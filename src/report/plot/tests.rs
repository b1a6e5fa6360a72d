use super::*;

fn wave(points: usize) -> Vec<(f64, f64)> {
    (0..points)
        .map(|k| 10f64.powf(-9.0 + 7.0 * k as f64 / points as f64))
        .map(|x| (x, x.ln().sin()))
        .collect()
}

fn plot() -> Plot {
    Plot::new("title", Axis::log("x (m)"), Axis::linear("y"))
}

fn count(svg: &str, what: &str) -> usize {
    svg.matches(what).count()
}

fn height(svg: &str) -> f64 {
    let rest = svg.split_once(" height=\"").unwrap().1;
    rest.split_once('"').unwrap().0.parse().unwrap()
}

/// Every element that is opened is closed, and nothing stands where a number should.
fn assert_sound(svg: &str) {
    for tag in ["svg", "g", "text", "title"] {
        let opened = count(svg, &format!("<{tag} ")) + count(svg, &format!("<{tag}>"));
        assert_eq!(opened, count(svg, &format!("</{tag}>")), "{tag}");
    }
    assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
}

#[test]
fn the_same_plot_gives_the_same_bytes() {
    let svg =
        || plot().with(Layer::line(wave(300)).named("a")).with(Layer::points(wave(30), Marker::Circle)).svg();
    assert_eq!(svg(), svg());
    assert_sound(&svg());
    assert!(svg().contains("viewBox") && svg().contains("<title>title</title>"));
}

#[test]
fn nothing_to_show_says_so() {
    for layer in [
        Layer::line([]),
        Layer::line([(f64::NAN, 1.0), (1.0, f64::INFINITY), (-1.0, 1.0)]),
        Layer::points([(0.0, 1.0)], Marker::Cross),
        Layer::bars(&[], &[]),
        Layer::band([(1.0, f64::NAN, f64::NAN)]),
        Layer::at_y(1.0, "a line alone is no data"),
    ] {
        let svg = plot().with(layer).svg();
        assert!(svg.contains("no data"));
        assert_sound(&svg);
    }
    assert!(!plot().with(Layer::line([(1.0, 1.0)])).svg().contains("no data"));
    assert_sound(&Figure::row("", vec![]).svg());
    assert_sound(&Figure::column("", vec![]).svg());
}

#[test]
fn no_values_make_trouble() {
    let values = [
        0.0,
        -0.0,
        1.0,
        -1.0,
        1.0 + 1e-15,
        5e-324,
        1e-300,
        1e300,
        f64::MAX,
        f64::MIN,
        f64::NAN,
        f64::INFINITY,
    ];
    let axes = [
        Axis::linear("l"),
        Axis::log("g"),
        Axis::linear("r").range(1e-300, 2e-300),
        Axis::log("z").range(2.0, 1.0),
    ];
    for (x, y) in axes.iter().flat_map(|x| axes.iter().map(move |y| (x, y))) {
        for (a, b) in values.iter().flat_map(|a| values.iter().map(move |b| (*a, *b))) {
            let points = [(a, b), (b, a), (a, a)];
            let plot = Plot::new("", x.clone(), y.clone())
                .height(a)
                .with(Layer::line(points).named("line"))
                .with(Layer::points(points, Marker::Triangle))
                .with(Layer::band([(a, b, a), (b, a, b)]))
                .with(Layer::bars(&[a, b], &[b]))
                .with(Layer::region_x(a, b, "region"))
                .with(Layer::region_y(b, a, "region"))
                .with(Layer::at_x(a, "x"))
                .with(Layer::slope((a, b), b, "slope"))
                .with(Layer::note((a, b), "note"));
            assert_sound(&plot.svg());
        }
    }
}

#[test]
fn a_missing_point_breaks_the_line() {
    let lines = |points: Vec<(f64, f64)>| {
        // The frame with its ticks is drawn alike for both.
        count(&plot().with(Layer::line(points)).svg(), "<polyline")
    };
    let whole = vec![(1.0, 1.0), (2.0, 2.0), (3.0, 1.5), (4.0, 1.0), (5.0, 2.0)];
    let mut broken = whole.clone();
    broken[2].1 = f64::NAN;
    assert_eq!(lines(broken) - lines(whole), 1);
}

#[test]
fn names_are_escaped_and_shared_names_stand_once() {
    let svg = plot()
        .with(Layer::line(wave(9)).named("<b>&\u{1}"))
        .with(Layer::points(wave(9), Marker::Square).named("<b>&\u{1}"))
        .svg();
    assert_eq!(count(&svg, "&lt;b&gt;&amp; "), 1);
    assert!(!svg.contains("<b>") && !svg.contains('\u{1}'));
    let title = Plot::new("</title><script>", Axis::linear(""), Axis::linear("")).svg();
    assert!(!title.contains("<script"));
}

#[test]
fn pictures_stay_small() {
    assert!(plot().with(Layer::line(wave(100))).svg().len() < 15_000);
    let many = (0..8).fold(plot(), |plot, k| {
        plot.with(Layer::line(wave(5000)).named(format!("{k}")).dashed(Dash::Dashed))
    });
    assert!(many.svg().len() < 60_000, "{}", many.svg().len());
    let cloud = (0..100_000u64).map(|k| ((k * 7919 % 9973) as f64 + 1.0, (k * 104_729 % 9949) as f64));
    assert!(plot().with(Layer::points(cloud, Marker::Cross)).svg().len() < 60_000);
}

#[test]
fn a_legend_without_a_clear_corner_stands_below() {
    let x = [1.0, 10.0, 100.0];
    let part = [0.3, 0.5, f64::NAN];
    let rest = [0.7, 0.5, 0.2];
    let shares = || [("elastic", Colour::Elastic, &part[..]), ("plastic", Colour::Plastic, &rest[..])];
    let full = Plot::new("", Axis::log("").range(1.0, 10.0), Axis::linear("").range(0.0, 1.0))
        .with_stacked(&x, shares());
    let (below, hidden) = (full.clone().svg(), full.legend(Legend::Hidden).svg());
    assert!(height(&below) > height(&hidden));
    assert!(below.contains("elastic") && !hidden.contains("elastic"));
    let line = plot().with(Layer::line([(1.0, 1.0), (2.0, 2.0)]).named("a"));
    assert_eq!(height(&line.clone().svg()), height(&line.legend(Legend::Hidden).svg()));
}

#[test]
fn shares_stand_on_each_other_and_gaps_are_shared() {
    let plot = plot().with_stacked(
        &[1.0, 2.0],
        [("a", Colour::Elastic, &[0.25, f64::NAN][..]), ("b", Colour::Plastic, &[0.75, 1.0][..])],
    );
    let reach: Vec<_> = plot.layers.iter().map(Layer::reach).collect();
    assert_eq!(reach[0][..2], [(1.0, 0.0), (1.0, 0.25)]);
    assert_eq!(reach[1][..2], [(1.0, 0.25), (1.0, 1.0)]);
    assert!(reach.iter().all(|points| points[3].1.is_nan()));
}

#[test]
fn a_steep_reference_keeps_its_slope() {
    // Twelve decades of x on one decade of y: the ends lie far outside the frame.
    let svg = Plot::new("", Axis::log("").range(1e-6, 1e6), Axis::log("").range(1.0, 10.0))
        .with(Layer::line([(1.0, 2.0), (2.0, 3.0)]))
        .with(Layer::slope((1.0, 10f64.sqrt()), -12.0, ""))
        .svg();
    let dashed = svg.split_once("stroke-dasharray").unwrap().1;
    let points = dashed.split_once("points=\"").unwrap().1.split_once('"').unwrap().0;
    let numbers: Vec<f64> = points.split([',', ' ']).map(|number| number.parse().unwrap()).collect();
    let (dx, dy) = (numbers[2] - numbers[0], numbers[3] - numbers[1]);
    // 144 frame heights over a frame width: the frame is near 660 by 380 pixels.
    let steepness = dy / dx;
    assert!((70.0..95.0).contains(&steepness), "{steepness}");
}

#[test]
fn plots_in_a_column_are_in_line() {
    let wide =
        Plot::new("", Axis::linear(""), Axis::linear("")).with(Layer::line([(0.0, 1.00001), (1.0, 1.00002)]));
    let narrow =
        Plot::new("", Axis::linear(""), Axis::linear("")).with(Layer::line([(0.0, 1.0), (1.0, 2.0)]));
    let svg = Figure::column("two", vec![wide, narrow]).svg();
    assert_sound(&svg);
    let lefts: Vec<&str> =
        svg.split("<svg x=\"").skip(1).map(|rest| rest.split_once('"').unwrap().0).collect();
    assert_eq!(lefts.len(), 2);
    assert_eq!(lefts[0], lefts[1]);
}
