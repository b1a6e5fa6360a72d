use super::*;

fn wave(points: usize) -> Vec<(f64, f64)> {
    (0..points)
        .map(|k| 10f64.powf(-9.0 + 7.0 * k as f64 / points as f64))
        .map(|x| (x, x.ln().sin()))
        .collect()
}

/// A plot alone or a figure, as it stands in a page.
trait Drawn {
    fn svg(&self) -> String;
}

impl Drawn for Plot {
    fn svg(&self) -> String {
        Figure::from(self.clone()).part_of_page()
    }
}

impl Drawn for Figure {
    fn svg(&self) -> String {
        self.part_of_page()
    }
}

fn plot() -> Plot {
    Plot::new("title", Axis::log("x (m)"), Axis::linear("y"))
}

fn field(map: ColourMap, columns: usize, values: Vec<f64>) -> Raster {
    let rows = values.len() / columns;
    let (x, y) = ((0.0, columns as f64), (0.0, rows as f64));
    Raster { x, y, columns, rows, values, map, limits: None, label: "height (µm)".into() }
}

fn map_of(raster: Raster) -> Plot {
    Plot::new("map", Axis::linear("x (µm)"), Axis::linear("y (µm)")).with(Layer::raster(raster))
}

fn count(svg: &str, what: &str) -> usize {
    svg.matches(what).count()
}

/// What stands between `key="` and the next quotation mark, at each place.
fn values<'a>(svg: &'a str, key: &str) -> Vec<&'a str> {
    let opening = format!("{key}=\"");
    svg.split(&*opening).skip(1).map(|rest| rest.split_once('"').unwrap().0).collect()
}

fn height(svg: &str) -> f64 {
    values(svg, " height")[0].parse().unwrap()
}

/// Every element that is opened is closed, and nothing stands where a number should.
fn assert_sound(svg: &str) {
    for tag in ["svg", "g", "text", "title"] {
        let opened = count(svg, &format!("<{tag} ")) + count(svg, &format!("<{tag}>"));
        assert_eq!(opened, count(svg, &format!("</{tag}>")), "{tag}");
    }
    // The text of an image may hold anything.
    let mut parts = svg.split("data:image/png;base64,");
    let first = parts.next().into_iter();
    let text: String = first.chain(parts.map(|part| part.split_once('"').unwrap().1)).collect();
    assert!(!text.contains("NaN") && !text.contains("inf"), "{text}");
}

#[test]
fn drawing_is_pure_and_tells_plots_apart() {
    // So many markers are thinned by sets, whose order differs from one to the next.
    let marked =
        |marker| plot().with(Layer::line(wave(300)).named("a")).with(Layer::points(wave(5000), marker));
    let [first, again] = [(); 2].map(|()| marked(Marker::Circle).svg());
    assert!(count(&first, "<path") + count(&first, "<circle") > 0 && first == again);
    assert_ne!(first, marked(Marker::Cross).svg());
    assert_sound(&first);
    assert!(first.contains("viewBox") && first.contains("<title>title</title>"));
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
    assert_eq!(count(&Figure::joint("", plot(), plot(), plot()).svg(), "no data"), 3);
    assert_sound(&Figure::row("", vec![]).svg());
    assert_sound(&Figure::column("", vec![]).svg());
}

#[test]
fn no_values_make_trouble() {
    let usual = [0.0, -0.0, 1.0, -1.0, 5e-324, 1e-300, 1e300, f64::MAX, f64::MIN, f64::NAN];
    let values = usual.into_iter().chain([1.0 + 1e-15, f64::INFINITY]);
    let axes = [
        Axis::linear("l"),
        Axis::log("g"),
        Axis::linear("r").range(1e-300, 2e-300),
        Axis::log("z").range(2.0, 1.0),
    ];
    for (k, (a, b)) in values.clone().flat_map(|a| values.clone().map(move |b| (a, b))).enumerate() {
        // Each value on twelve of the pairs of axes.
        let pair = (k + k / 12) % 16;
        let [x, y] = [&axes[pair / 4], &axes[pair % 4]];
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
        for map in [ColourMap::Diverging, ColourMap::Counts] {
            let raster = Raster { x: (a, b), y: (b, a), limits: Some((a, b)), ..field(map, 2, vec![a, b]) };
            let plot = Plot::new("", Axis::linear("l"), axes[k % 2].clone()).equal_aspect().height(60.0);
            assert_sound(&plot.with(Layer::raster(raster)).svg());
        }
    }
}

#[test]
fn a_missing_point_breaks_the_line() {
    let lines = |points: Vec<(f64, f64)>| {
        // The frame with its ticks is drawn alike for both.
        let svg = plot().with(Layer::line(points)).svg();
        values(&svg, " d").into_iter().map(|data| count(data, "m")).sum::<usize>()
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
    // No wider than the page, however fine the field is.
    let rough = (0..1500 * 1500_usize).map(|k| (k * 7919 % 1009) as f64).collect();
    let fine = map_of(field(ColourMap::Sequential, 1500, rough)).svg();
    assert!(fine.len() < 350_000, "{}", fine.len());
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
fn contributions_of_either_sign_stand_on_their_own_side_of_zero() {
    let plot = Plot::new("", Axis::linear(""), Axis::linear("")).with_contributions(
        &[1.0, 2.0, 3.0],
        [
            ("a", Colour::Heights, &[0.5, -0.5, f64::NAN][..]),
            ("b", Colour::Radii, &[-0.2, -0.2, 1.0][..]),
            ("c", Colour::Correlation, &[0.1, 0.1, 1.0][..]),
        ],
    );
    let reach: Vec<_> = plot.layers.iter().map(Layer::reach).collect();
    // Half way "a" leaves the upper side and enters the lower one.
    let crossing = [(1.5, 0.0), (1.5, 0.0)];
    assert_eq!(reach[0][..2], [(1.0, 0.0), (1.0, 0.5)]);
    assert_eq!(reach[0][2..6], [crossing, crossing].concat());
    assert_eq!(reach[0][6..8], [(2.0, -0.5), (2.0, 0.0)]);
    assert_eq!(reach[1][..2], [(1.0, -0.2), (1.0, 0.0)]);
    assert_eq!(reach[1][2..8], [(1.5, -0.2), (1.5, 0.0), (1.5, -0.2), (1.5, 0.0), (2.0, -0.7), (2.0, -0.5)]);
    assert_eq!(reach[2][..2], [(1.0, 0.5), (1.0, 0.6)]);
    assert_eq!(reach[2][2..8], [(1.5, 0.0), (1.5, 0.1), (1.5, 0.0), (1.5, 0.1), (2.0, 0.0), (2.0, 0.1)]);
    assert!(reach.iter().all(|points| points[8..].iter().skip(1).step_by(2).all(|point| point.1.is_nan())));
}

#[test]
fn a_steep_reference_keeps_its_slope() {
    // Twelve decades of x on one decade of y: the ends lie far outside the frame.
    let svg = Plot::new("", Axis::log("").range(1e-6, 1e6), Axis::log("").range(1.0, 10.0))
        .with(Layer::line([(1.0, 2.0), (2.0, 3.0)]))
        .with(Layer::slope((1.0, 10f64.sqrt()), -12.0, ""))
        .svg();
    let dashed = svg.split_once("stroke-dasharray").unwrap().1;
    let points = dashed.split_once(" d=\"m").unwrap().1.split_once('"').unwrap().0;
    let step = points.rsplit(' ').next().unwrap();
    let numbers: Vec<f64> = step.split(',').map(|number| number.parse().unwrap()).collect();
    let [dx, dy] = numbers[..] else { panic!("{step}") };
    // 144 frame heights over a frame width: the frame is near 660 by 380 pixels.
    let steepness = dy / dx;
    assert!((70.0..95.0).contains(&steepness), "{steepness}");
}

#[test]
fn plots_in_a_column_are_in_line() {
    let from = |y: [f64; 2]| {
        Plot::new("", Axis::linear(""), Axis::linear("")).with(Layer::line([(0.0, y[0]), (1.0, y[1])]))
    };
    let svg = Figure::column("two", [[1.00001, 1.00002], [1.0, 2.0]].map(from).to_vec()).svg();
    assert_sound(&svg);
    let [first, second] = values(&svg, "<svg x")[..] else { panic!("{svg}") };
    assert_eq!(first, second);
}

/// Width and height, in pixels, of the frame that cuts off what is outside.
fn frame(svg: &str) -> (f64, f64) {
    let rest = svg.split_once("<svg x=\"").unwrap().1;
    let number = |key: &str| values(rest, key)[0].parse::<f64>().unwrap() / 3.0;
    (number(" width"), number(" height"))
}

#[test]
fn a_field_without_values_or_on_other_axes_is_not_shown() {
    let broken = Raster { rows: 3, ..field(ColourMap::Diverging, 2, vec![1.0; 4]) };
    let endless = Raster { rows: usize::MAX, ..broken.clone() };
    for raster in [field(ColourMap::Diverging, 2, vec![f64::NAN; 4]), broken, endless] {
        let svg = map_of(raster).svg();
        assert!(svg.contains("no data") && !svg.contains("<image"));
    }
    let svg = plot().with(Layer::raster(field(ColourMap::Diverging, 2, vec![1.0; 4]))).svg();
    assert!(svg.contains("no data") && !svg.contains("<image"));
}

#[test]
fn units_of_a_map_are_equally_long() {
    let wide = map_of(field(ColourMap::Diverging, 40, vec![1.0; 400])).equal_aspect().svg();
    let (width, height) = frame(&wide);
    assert!((width / height - 4.0).abs() < 0.02 && width > 500.0, "{width} {height}");
    let high = map_of(field(ColourMap::Diverging, 10, vec![1.0; 400])).equal_aspect().svg();
    let (width, height) = frame(&high);
    assert!((height / width - 4.0).abs() < 0.05 && (height - 380.0).abs() < 1.0, "{width} {height}");
}

/// The first row of pixels is the upper one; the first cell stands at the lower left.
#[test]
fn an_image_stands_upright() {
    let corners = |x: [f64; 2], y: [f64; 2]| {
        let [x, y] = [x, y].map(|[from, to]| Axis::linear("").range(from, to));
        let field = field(ColourMap::Sequential, 2, vec![5.0, 1.0, 2.0, 2.0, 3.0, 4.0]);
        let svg = Plot::new("", x, y).with(Layer::raster(field)).svg();
        let (pixels, info) = raster::tests::decoded(values(&svg, "href")[0], png::Transformations::IDENTITY);
        let (wide, high) = (info.width as usize, info.height as usize);
        // Upper left, upper right, lower left, lower right: values in ascending order, from 1.
        [0, wide - 1, (high - 1) * wide, high * wide - 1].map(|at| pixels[at] + 1)
    };
    assert_eq!(corners([0.0, 2.0], [0.0, 3.0]), [3, 4, 5, 1]);
    assert_eq!(corners([2.0, 0.0], [0.0, 3.0]), [4, 3, 1, 5]);
    assert_eq!(corners([0.0, 2.0], [3.0, 0.0]), [5, 1, 3, 4]);
}

#[test]
fn marginal_plots_share_the_axes_of_the_main_one() {
    let points = [(0.0, 1.0), (3.0, 2.0), (9.0, 7.0), (f64::NAN, 1.0)];
    let main = || {
        Plot::new("main", Axis::linear("height"), Axis::linear("radius"))
            .with(Layer::raster(Raster::of_points(points, (0.0, 10.0), (0.0, 8.0), 20, 16)))
    };
    let side = |edges: &[f64]| {
        let bars = Layer::bars(edges, &[0.1, 0.2]).named("asperities");
        Plot::new("", Axis::linear("own axis"), Axis::linear("density"))
            .with(bars)
            .with(Layer::line([(edges[0], 0.1), (edges[2], 0.2)]).named("assumed"))
            .with(Layer::raster(field(ColourMap::Diverging, 2, vec![1.0; 4])))
    };
    let svg = Figure::joint("t", main(), side(&[0.0, 5.0, 10.0]), side(&[0.0, 4.0, 8.0])).svg();
    assert_sound(&svg);
    assert_eq!((count(&svg, "<image"), count(&svg, "density\n"), count(&svg, "own axis")), (2, 2, 0));
    assert_eq!((count(&svg, "asperities"), count(&svg, "assumed")), (1, 1));

    // Top, right and main frames, in the order in which they are drawn.
    let numbers = |text: &str| text.split(' ').map(|number| number.parse().unwrap()).collect::<Vec<f64>>();
    let frames: Vec<Vec<f64>> = values(&svg, "viewBox").into_iter().map(numbers).collect();
    let [_, top, right, main] = &frames[..] else { panic!("{frames:?}") };
    assert_eq!((top[0], top[2]), (main[0], main[2]));
    assert_eq!((right[1], right[3]), (main[1], main[3]));
    assert!(top[1] + top[3] < main[1] && main[0] + main[2] < right[0]);

    // The two bars of either meet in the middle of the shared axis.
    let corners: Vec<(f64, f64)> = values(&svg, "<polygon points")
        .into_iter()
        .flat_map(|polygon| polygon.split(' '))
        .map(|corner| corner.split_once(',').unwrap())
        .map(|(x, y)| (x.parse().unwrap(), y.parse().unwrap()))
        .collect();
    assert_eq!(corners.len(), 16);
    assert!((corners[4].0 - (main[0] + main[2] / 2.0)).abs() <= 1.0, "{corners:?}");
    assert!((corners[12].1 - (main[1] + main[3] / 2.0)).abs() <= 1.0, "{corners:?}");
    // Bars stand on the sides that face the main plot.
    assert_eq!((corners[0].1, corners[8].0), (top[1] + top[3], right[0]));
}

#[test]
fn what_lies_sideways_is_turned_back() {
    let layers = [
        Layer::line([(1.0, 2.0)]),
        Layer::points([(1.0, 2.0)], Marker::Cross),
        Layer::band([(1.0, 2.0, 3.0)]),
        Layer::bars(&[1.0, 2.0], &[3.0]),
        Layer::region_x(1.0, 2.0, "r"),
        Layer::at_y(1.0, "l"),
        Layer::slope((1.0, 2.0), 4.0, "s"),
        Layer::note((1.0, 2.0), "n"),
    ];
    for layer in layers {
        let turned = layer.clone().sideways();
        let swapped: Vec<_> = layer.reach().iter().map(|point| (point.1, point.0)).collect();
        assert_eq!(turned.reach(), swapped);
        assert_ne!(format!("{turned:?}"), format!("{layer:?}"));
        assert_eq!(format!("{:?}", turned.sideways()), format!("{layer:?}"));
    }
}

#[test]
fn a_tile_is_filled_and_holds_its_text() {
    let plot = Plot::new("", Axis::linear("").range(0.0, 2.0), Axis::log("").range(1.0, 100.0))
        .with(Layer::tile((0.0, 1.0), (1.0, 10.0), "+0.3").coloured(Colour::Heights).named("heights"))
        .with(Layer::tile((1.0, 10.0), (2.0, 100.0), "-0.1").coloured(Colour::Radii).named("radii"));
    let reach: Vec<_> = plot.layers.iter().map(Layer::reach).collect();
    assert_eq!(reach[1], [(1.0, 10.0), (2.0, 100.0)]);
    let svg = plot.svg();
    for text in ["+0.3", "-0.1", "heights", "#566FB8", "#C4DDF0"] {
        assert!(svg.contains(text), "{text} is missing in {svg}");
    }
    // Light on the dark tile, dark on the light one.
    let colour_of =
        |text: &str| svg.split_once(text).unwrap().0.rsplit_once("fill=\"").unwrap().1[..7].to_owned();
    assert_eq!([colour_of("+0.3"), colour_of("-0.1")], ["#FEFEFE", "#232323"], "{svg}");
}

#[test]
fn a_file_adapts_to_a_dark_environment_and_a_page_does_so_once() {
    let figure = Figure::from(plot().with(Layer::line(wave(9))));
    let file = figure.file(None);
    // Only the rules that it needs, and all of those.
    let (style, elements) = file.split_once("</style>").unwrap();
    for (light, dark) in DARK_COLOURS {
        for key in ["fill", "stroke"] {
            let attribute = format!("{key}=\"{light}\"");
            let rule = format!("svg [{attribute}]{{{key}:{dark}}}");
            assert_eq!(style.contains(&rule), elements.contains(&attribute), "{attribute}");
        }
    }
    assert!(style.contains("svg [fill=\"#FFFFFF\"]{fill:#15181C}") && !style.contains("#882255"));
    assert!(!figure.part_of_page().contains("<style>"));
}

#[test]
fn a_size_in_print_sets_width_and_text() {
    let figure = Figure::from(plot().with(Layer::line(wave(9))));
    let svg = figure.file(Some(Size::new(85.0, 8.0)));
    assert_sound(&svg);
    assert!(svg.contains("width=\"85mm\""), "{svg}");
    // 85 mm hold 30 widths of 8 pt; the tick labels are 37 or 38 units high.
    let width: f64 = values(&svg, "viewBox")[0].split(' ').nth(2).unwrap().parse().unwrap();
    assert!((width / (12.5 * 3.0) - 85.0 / 25.4 * 72.0 / 8.0).abs() < 0.1, "{width}");
    assert_eq!(Size::new(1.0, 99.0), Size::new(40.0, 24.0));
}

#[test]
fn a_card_shows_the_first_plot_with_few_names() {
    let named = |count: usize| {
        let line = |k: usize| Layer::line([(0.0, k as f64), (1.0, 2.0)]).named(format!("curve {k}"));
        (0..count).fold(Plot::new("Area", Axis::linear("x"), Axis::linear("y")), |plot, k| plot.with(line(k)))
    };
    let second = Plot::new("Separation", Axis::linear("x"), Axis::linear("y"));
    let card = |count| Figure::column("Both", vec![named(count), second.clone()]).card();
    assert_sound(&card(2));
    assert!(
        card(2).contains("width=\"340\"") && card(2).contains("curve 1") && !card(2).contains("Separation")
    );
    assert!(!card(5).contains("curve 1"));
    assert_eq!(
        card(2).matches("font-size=\"125\"").count(),
        Figure::from(named(2)).file(None).matches("font-size=\"125\"").count()
    );
}

#[test]
fn a_card_has_room_for_each_named_place() {
    let height = |count: usize| {
        let places = Axis::named((0..count).map(|k| format!("case {k}")));
        let line = Layer::line([(0.0, 0.0), (1.0, 1.0)]);
        height(&Figure::from(Plot::new("Area", Axis::linear("x"), places).with(line)).card())
    };
    // Pixels of a line of text.
    const LINE: f64 = 15.0;
    assert!(height(20) > 20.0 * LINE, "{}", height(20));
    assert!(height(2) == height(3) && height(2) < 20.0 * LINE, "{}", height(2));
}

#[test]
fn plots_in_a_row_keep_the_size_of_text_and_share_their_legend() {
    let named =
        |names: &[&str]| names.iter().fold(plot(), |plot, name| plot.with(Layer::line(wave(9)).named(*name)));
    let two = Figure::row("two", vec![named(&["a", "b"]), named(&["b", "a"])]).svg();
    assert_sound(&two);
    assert!(two.contains("width=\"720\""));
    assert_eq!((count(&two, "\na\n"), count(&two, "\nb\n")), (1, 1), "{two}");
    let four = Figure::row("four", vec![named(&["a"]), named(&["b"]), named(&["c"]), named(&["d"])]).svg();
    let lefts = values(&four, "<svg x");
    assert_eq!(lefts.len(), 4);
    assert_eq!((lefts[0], lefts[1]), (lefts[2], lefts[3]));
}

#[test]
fn columns_of_a_grid_are_in_line_and_each_row_has_one_legend() {
    let named = |name: &str, factor: f64| {
        let line = wave(9).into_iter().map(|(x, y)| (x, factor * y));
        Plot::new("", Axis::linear("x"), Axis::linear("y")).with(Layer::line(line).named(name))
    };
    let plots = || vec![named("a", 1.0), named("b", 1.0), named("c", 1234.567), named("c", 1.0)];
    let svg = Figure::grid("four", 2, plots()).svg();
    assert_sound(&svg);
    let lefts = values(&svg, "<svg x");
    assert_eq!((lefts[0], lefts[1]), (lefts[2], lefts[3]), "{lefts:?}");
    assert_ne!(lefts[0], lefts[1]);
    for name in ["a", "b", "c"] {
        assert_eq!(count(&svg, &format!("\n{name}\n")), 1, "{name}: {svg}");
    }
    // No room for two columns: one below the other, each with its own legend.
    let narrow = Figure::grid("four", 2, plots()).file(Some(Size::new(60.0, 8.0)));
    assert_eq!(count(&narrow, "\nc\n"), 2);
}

#[test]
fn many_ordered_curves_share_a_colour_scale() {
    let figure = |of: usize| {
        let line = |index: usize| {
            Layer::line(wave(9)).coloured(Colour::Ordered { index, of }).named(format!("{} nm", index + 1))
        };
        (0..of).map(line).fold(plot(), Plot::with).with_key("statistical", Dash::Dashed).svg()
    };
    let (few, many) = (figure(8), figure(11));
    assert_sound(&many);
    assert!(many.contains("\n11 nm\n") && many.contains("\nstatistical\n"));
    // Cells instead of samples of lines: of those only the key is left.
    let cells = |svg: &str| count(svg, "height=\"33\"");
    assert_eq!((cells(&few), cells(&many)), (0, 11));
}

#[test]
fn a_wide_band_does_not_flatten_its_line_and_is_said_to_be_cut() {
    let line = || Layer::line([(1.0, 1.0), (10.0, 2.0)]);
    let linear = || Plot::new("", Axis::log("x"), Axis::linear("y")).with(line());
    let wide = linear().with(Layer::band([(1.0, -90.0, 90.0), (10.0, 1.9, 2.1)]));
    let layout = super::layout::Layout::new(&wide, (720.0, 380.0));
    assert!(layout.y.from > 0.4 && layout.y.to < 2.6, "{:?}", layout.y);
    assert!(wide.svg().contains("cut at the frame"));
    let narrow = linear().with(Layer::band([(1.0, 0.9, 1.1), (10.0, 1.9, 2.1)])).svg();
    assert!(!narrow.contains("cut at the frame"));
    let log = Plot::new("", Axis::log("x"), Axis::log("y")).with(line());
    let log = log.with(Layer::band([(1.0, 1e-9, 1e9), (10.0, 1.9, 2.1)]));
    let layout = super::layout::Layout::new(&log, (720.0, 380.0));
    assert!(layout.y.from > -0.2 && layout.y.to < 0.5, "{:?}", layout.y);
}

#[test]
fn a_difference_is_shown_with_its_zero() {
    let far = Layer::line([(1.0, -65.0), (2.0, -50.0)]);
    let shown = |plot: Plot| Figure::from(plot).svg();
    assert!(!shown(plot().with(far.clone())).contains("\n0\n"));
    assert!(shown(plot().with_zero().with(far.clone())).contains("\n0\n"));
    // Where a range is asked for, that one is shown.
    let mut other = plot().with(far).with_zero();
    other.y = other.y.range(-70.0, -40.0);
    assert!(!shown(other).contains("\n0\n"));
}
