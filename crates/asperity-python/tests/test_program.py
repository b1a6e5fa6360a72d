"""The package against the program, bit for bit."""

import csv
import io

import numpy as np
import pytest

import asperity

MATERIALS = """
[material.steel]
young = 210e9
poisson = 0.3
hardness = 7.6e9

[material.lead]
young = 18e9
poisson = 0.35
hardness = 170e6
"""

SPECTRUM = {"self-affine": {"hurst": 0.8, "roll-off": 32e-6, "cut-off": 8e-6}}

GENERATED = """
[surface.surface.generate]
points = 256
pixel = 1e-6
sigma = 50e-9
spectrum.self-affine = { hurst = 0.8, roll-off = 32e-6, cut-off = 8e-6 }
"""

SPEC = f"""
title = "Comparison"
seed = 7
{MATERIALS}
[compare]
rough = "steel"
flat = "steel"
law = "zmc"
separation = [2.5, 1.5, 0.5]
pressure = [1e6, 1e7]
models = ["statistical", "deterministic", "reference"]
{GENERATED}
"""


def steel():
    return asperity.Material(210e9, 0.3, hardness=7.6e9)


def rows_of(path, **wanted):
    rows = csv.DictReader(io.StringIO(path.read_text()))
    return [row for row in rows if all(row[name] == value for name, value in wanted.items())]


def numbers(rows, column):
    flags = {"true": 1.0, "false": 0.0, "": np.nan}
    return np.array([flags[cell] if (cell := row[column]) in flags else float(cell) for row in rows])


def assert_equal(table, rows):
    """Every column of a table against the same rows of a file, to the bit."""
    assert table.rows == len(rows) > 0
    for name, values in table.items():
        if values.dtype.kind == "U":
            assert values.tolist() == [row[name] for row in rows], name
        elif values.dtype.kind == "b":
            assert [str(value).lower() for value in values.tolist()] == [row[name] for row in rows], name
        else:
            assert np.array_equal(values.astype(float), numbers(rows, name), equal_nan=True), name


@pytest.fixture(scope="module")
def by_program(report):
    return report(SPEC)


def test_a_spec_file_gives_the_same_tables(by_program, tmp_path):
    path = tmp_path / "spec.toml"
    path.write_text(SPEC)
    results = asperity.run(path)
    files = {file.name: file.read_bytes() for file in by_program.glob("*.csv") if file.name != "digest.csv"}
    assert results.csv == files
    assert set(results.tables) == {name.removesuffix(".csv") for name in files}
    assert_equal(results.curves, rows_of(by_program / "curves.csv"))


def test_a_dictionary_gives_the_same_tables(by_program):
    material = {"young": 210e9, "poisson": 0.3, "hardness": 7.6e9}
    spec = {
        "title": "Comparison",
        "seed": 7,
        "material": {"steel": material},
        "compare": {
            "rough": "steel",
            "flat": "steel",
            "law": "zmc",
            "separation": np.array([2.5, 1.5, 0.5]),
            "pressure": (1e6, 1e7),
            "models": ["statistical", "deterministic", "reference"],
        },
        "surface": {"surface": {"generate": {"points": 256, "pixel": 1e-6, "sigma": 50e-9, "spectrum": SPECTRUM}}},
    }
    results = asperity.run(spec)
    assert results.csv["curves.csv"] == (by_program / "curves.csv").read_bytes()
    assert results.csv["reference.csv"] == (by_program / "reference.csv").read_bytes()
    assert results.csv["attribution.csv"] == (by_program / "attribution.csv").read_bytes()
    assert [entry["verdict"] for entry in results.verdicts]


def test_models_on_a_generated_surface(by_program):
    surface = asperity.generate(256, pixel=1e-6, sigma=50e-9, spectrum=SPECTRUM, seed=7)
    asperities = surface.find_summits()
    contact = asperity.Interface(steel(), steel())
    at = {"separations": [2.5, 1.5, 0.5], "pressures": [1e6, 1e7]}
    found = {
        "deterministic": asperity.deterministic(contact, asperities, **at),
        "statistical": asperity.statistical(contact, asperities.population(), **at),
    }
    for model, table in found.items():
        rows = rows_of(by_program / "curves.csv", model=model)
        # In a comparison the limits of one model are those of both.
        for name, values in table.items():
            if values.dtype.kind == "f":
                assert np.array_equal(values, numbers(rows, name), equal_nan=True), (model, name)


def test_asperities_are_independent_only_where_that_is_said():
    surface = asperity.generate(256, pixel=1e-6, sigma=50e-9, spectrum=SPECTRUM, seed=7)
    summits = surface.find_summits()
    contact = asperity.Interface(steel(), steel())
    drawn = asperity.draw(20_000, radius=20e-6, sigma=48e-9, density=6e10)
    assert (drawn.independent, summits.independent, summits.places.shape) == (True, False, (2, len(summits)))
    plain = asperity.Asperities(drawn.heights, drawn.radii, drawn.nominal_area)
    said = asperity.Asperities(drawn.heights, drawn.radii, drawn.nominal_area, independent=True)
    results = asperity.compare({"plain": plain, "said": said, "drawn": drawn, "summits": summits}, contact, pressures=[2e7])
    basis = dict(zip(results.tables["cases"]["surface"], results.tables["cases"]["basis"]))
    assert basis == {"plain": "none", "said": "independent", "drawn": "independent", "summits": basis["summits"]}
    assert basis["summits"] in ("blocks", "model-based", "none")
    assert [warning for warning in results.warnings if "plain" in warning and "independent=True" in warning]
    assert not [warning for warning in results.warnings if "said" in warning]


def test_the_tip_is_an_option_of_a_topography():
    surface = asperity.generate(128, pixel=1e-6, sigma=50e-9, spectrum=SPECTRUM, seed=7)
    traced = asperity.Topography(surface.raw_heights, 1e-6, periodic=True)
    eroded = traced.prepared_with(tip=5e-6)
    assert eroded.roughness["tip_radius_m"] == 5e-6 and traced.roughness["tip_radius_m"] is None
    assert np.nanmax(eroded.heights - traced.heights) <= 1e-15


def test_the_reference_alone(report):
    spec = SPEC.replace("separation = [2.5, 1.5, 0.5]\n", "").replace('"statistical", "deterministic", ', "")
    by_program = report(spec, "reference")
    surface = asperity.generate(256, pixel=1e-6, sigma=50e-9, spectrum=SPECTRUM, seed=7)
    found = asperity.reference(surface, asperity.Interface(steel(), steel()), pressures=[1e6, 1e7])
    rows = rows_of(by_program / "curves.csv", model="reference")
    assert found["target"].tolist() == [1e6, 1e7]
    # The map in memory is that of the spec, and so are its loads; the plane of separations is that of the summits of both.
    for name in ("pressure_pa", "area_ratio", "raw_area_ratio", "separation_m", "stiffness_pa_per_m"):
        assert np.array_equal(found[name], numbers(rows, name), equal_nan=True), name


def test_arrays_are_files(report, tmp_path):
    """A map and a list in memory against the same numbers in files, under a layer and prepared in every way."""
    rng = np.random.default_rng(3)
    smooth = np.cumsum(np.cumsum(rng.normal(size=(96, 80)), axis=0), axis=1)
    heights = 1e-9 * (smooth - smooth.mean()) + 2e-8 * rng.normal(size=smooth.shape)
    heights[5, 7] = np.nan
    np.save(tmp_path / "map.npy", heights)
    listed = np.stack([rng.normal(0, 5e-8, 500), rng.uniform(1e-5, 3e-5, 500)], axis=-1)
    np.save(tmp_path / "list.npy", listed)
    by_program = report(
        f"""
title = "Comparison"
{MATERIALS}
[compare]
rough = "steel"
flat = "steel"
law = {{ zmc = {{ transition-ratio = 110 }} }}
layer = {{ material = "lead", thickness = [1e-7] }}
separation = [2, 1]

[surface.map.file]
path = "{tmp_path / "map.npy"}"
pixel = [1e-6, 2e-6]
outliers = "remove"
align-lines = "x"
level = "quadratic"
filter = {{ s = 4e-6, l = 40e-6 }}
neighbours = "eight"

[surface.list.asperities]
file = "{tmp_path / "list.npy"}"
nominal-area = 1e-8
""",
        "arrays",
    )
    surface = asperity.Topography(
        heights,
        (1e-6, 2e-6),
        outliers="remove",
        align_lines="x",
        level="quadratic",
        s=4e-6,
        l=40e-6,
        neighbours="eight",
    )
    asperities = asperity.Asperities(listed[:, 0], listed[:, 1], 1e-8)
    lead = asperity.Material(18e9, 0.35, hardness=170e6)
    law = asperity.Law("zmc", transition_ratio=110)
    contact = asperity.Interface(steel(), steel(), law, layer=lead, thickness=1e-7)
    results = asperity.compare({"map": surface, "list": asperities}, contact, separations=[2, 1])
    files = {file.name: file.read_bytes() for file in by_program.glob("*.csv") if file.name != "digest.csv"}
    assert results.csv == files
    # And the models alone.
    for name, own in (("map", surface.find_summits()), ("list", asperities)):
        table = asperity.deterministic(contact, own, separations=[2, 1])
        rows = rows_of(by_program / "curves.csv", model="deterministic", surface=name)
        for column in ("pressure_pa", "area_ratio", "stiffness_pa_per_m", "separation_m"):
            assert np.array_equal(table[column], numbers(rows, column)), (name, column)
    assert surface.heights.shape == (96, 80)
    assert [surface.roughness[f"points_{axis}"] for axis in "xy"] == [96, 80]


def test_a_periodic_file(report, tmp_path):
    made = asperity.generate(128, pixel=1e-6, sigma=50e-9, spectrum=SPECTRUM, seed=2)
    np.save(tmp_path / "map.npy", made.heights)
    by_program = report(
        f"""
title = "Comparison"
{MATERIALS}
[compare]
rough = "steel"
flat = "steel"
law = "hertz"
separation = [2, 1]
[surface.map.file]
path = "{tmp_path / "map.npy"}"
pixel = 1e-6
periodic = true
""",
        "periodic",
    )
    contact = asperity.Interface(steel(), steel(), "hertz")
    again = asperity.Topography(made.heights, 1e-6, periodic=True)
    assert len(again.find_summits()) == len(made.find_summits())
    assert len(asperity.Topography(made.heights, 1e-6, level="none").find_summits()) < len(made.find_summits())
    table = asperity.deterministic(contact, again.find_summits(), separations=[2, 1])
    rows = rows_of(by_program / "curves.csv", model="deterministic")
    assert np.array_equal(table["pressure_pa"], numbers(rows, "pressure_pa"))


def test_draws_are_those_of_the_program(report):
    population = 'radius = 2e-5\nsigma = 4.8e-8\ndensity = 6e10\ncount = 1000\nheights.weibull = { shape = 2 }'
    by_program = report(
        f"""
title = "Comparison"
seed = 11
{MATERIALS}
[compare]
rough = "steel"
flat = "steel"
law = "zmc"
separation = 1
[surface.surface.population]
{population}
""",
        "drawn",
    )
    asperities = asperity.draw(
        1000, radius=2e-5, sigma=4.8e-8, density=6e10, heights={"weibull": {"shape": 2}}, seed=11
    )
    contact = asperity.Interface(steel(), steel())
    rows = rows_of(by_program / "curves.csv", model="deterministic")
    # The program measures by the nominal sigma, from a nominal mean of zero.
    mean = asperities.statistics()["mean_height_m"]
    table = asperity.deterministic(contact, asperities, separations=[1 - mean / 4.8e-8], sigma=4.8e-8)
    assert np.allclose(table["pressure_pa"], numbers(rows, "pressure_pa"), rtol=1e-12)
    integral = asperity.statistical(
        contact, asperity.Population(2e-5, 4.8e-8, 6e10, {"weibull": {"shape": 2}}), separations=1
    )
    rows = rows_of(by_program / "curves.csv", model="statistical")
    assert np.array_equal(integral["pressure_pa"], numbers(rows, "pressure_pa"))
