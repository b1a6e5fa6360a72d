"""What a user meets: arrays, tables, errors, threads and interrupts."""

import copy
import doctest
import gc
import os
import pickle
import signal
import subprocess
import sys
import threading
import time
import warnings

import numpy as np
import pytest

import asperity
from asperity import study, surfaces

STEEL = asperity.Material(210e9, 0.3, hardness=7.6e9)
CONTACT = asperity.Interface(STEEL, STEEL)
SPECTRUM = {"self-affine": {"hurst": 0.8, "roll-off": 16e-6, "cut-off": 4e-6}}


def asperities(count=1000):
    rng = np.random.default_rng(5)
    return asperity.Asperities(rng.normal(0, 5e-8, count), np.full(count, 2e-5), count / 6e10)


def test_examples_of_the_documentation():
    finder, runner = doctest.DocTestFinder(recurse=False), doctest.DocTestRunner()
    objects = [asperity, *(getattr(asperity, name) for name in asperity.__all__)]
    objects += [asperity.Interface.contact, asperity.Topography.read, study, surfaces]
    for thing in objects:
        name = getattr(thing, "__name__", "asperity")
        for test in finder.find(thing, name, module=False, globs={}):
            runner.run(test)
    summary = runner.summarize()
    assert summary.failed == 0 and summary.attempted > 40


def test_everything_public_is_documented():
    for name in asperity.__all__:
        thing = getattr(asperity, name)
        assert name.startswith("__") or thing.__doc__, name
        for attribute in vars(thing) if isinstance(thing, type) else []:
            if not attribute.startswith("_") and attribute not in ("tables", "summary"):
                assert getattr(thing, attribute).__doc__, f"{name}.{attribute}"


def test_stubs_name_what_is_there():
    from pathlib import Path

    stub = (Path(asperity.__file__).parent / "_asperity.pyi").read_text()
    native = asperity._asperity
    for name in dir(native):
        if not name.startswith("__"):
            assert f"class {name}" in stub or f"def {name}(" in stub, name
            thing = getattr(native, name)
            for attribute in vars(thing) if isinstance(thing, type) else []:
                if not attribute.startswith("_") and name != "Table":
                    assert f"def {attribute}(" in stub, f"{name}.{attribute}"
    assert (Path(asperity.__file__).parent / "py.typed").exists()


def test_contiguous_arrays_are_not_copied():
    heights, radii = np.linspace(0, 1e-7, 1000), np.full(1000, 2e-5)
    held = asperity.Asperities(heights, radii, 1e-8)
    assert held.heights is heights and held.radii is radii
    strided = asperity.Asperities(np.linspace(0, 1e-7, 2000)[::2], list(radii), 1e-8)
    assert strided.heights.flags.c_contiguous and len(strided) == 1000
    # The array stays alive with the object.
    held = asperity.Asperities(np.linspace(0, 1e-7, 100_000), np.full(100_000, 2e-5), 1e-6)
    gc.collect()
    assert asperity.deterministic(CONTACT, held, separations=0)["contact_density_per_m2"][0] > 0
    # A map of 80 MB is read where it lies.
    import tracemalloc

    heights = np.zeros((3000, 3400))
    heights[1::2, 1::2] = 1e-8 * np.random.default_rng(1).random((1500, 1700))
    tracemalloc.start()
    before = resident()
    asperity.Topography(heights, 1e-6)
    assert resident() - before < 20e6
    tracemalloc.stop()


def resident():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGESIZE")


def test_changed_arrays_are_checked_again():
    heights, radii = np.linspace(0, 1e-7, 100), np.full(100, 2e-5)
    held = asperity.Asperities(heights, radii, 1e-8)
    heights[3] = np.nan
    with pytest.raises(ValueError, match="asperity 3: height NaN m"):
        asperity.deterministic(CONTACT, held, separations=1)


def test_an_offset_costs_no_digits():
    near = asperities()
    far = asperity.Asperities(near.heights + 1.0, near.radii, near.nominal_area)
    same = asperity.Asperities((near.heights + 1.0) - 1.0, near.radii, near.nominal_area)
    a, b = (asperity.deterministic(CONTACT, each, separations=[2, 1])["pressure_pa"] for each in (far, same))
    assert np.allclose(a, b, rtol=1e-12)


def test_tables_have_columns_with_units_and_rows():
    table = asperity.deterministic(CONTACT, asperities(), separations=[2, 1, 0], pressures=1e6)
    assert len(table) == len(list(table)) == table.rows == 4
    assert table["control"].tolist() == ["separation"] * 3 + ["pressure"]
    assert table["pressure_pa"] is table["pressure_pa"]
    assert "pressure_pa" in table and "x" not in table and table.get("x") is None
    assert table.units["pressure_pa"] == "Pa" and "Nominal pressure" in table.meanings["pressure_pa"]
    assert table["beyond_model"].dtype == bool and dict(table)["area_ratio"].dtype == np.float64
    assert [row["pressure_pa"] for row in table] == table["pressure_pa"].tolist()
    assert repr(table[-1]) == repr(list(table)[3]) and table[0]["control"] == "separation"
    with pytest.raises(KeyError, match="the columns are model, control"):
        table["x"]
    with pytest.raises(IndexError, match="found row 4; the table has 4 rows"):
        table[4]
    pandas = pytest.importorskip("pandas")
    pandas.testing.assert_frame_equal(pandas.DataFrame(table), table.to_pandas())
    assert list(table.to_pandas().columns) == table.keys()
    pytest.importorskip("xarray")
    assert table.to_xarray()["pressure_pa"].attrs["units"] == "Pa"


def test_all_results_become_data_frames():
    pandas = pytest.importorskip("pandas")
    surface = asperity.generate(128, pixel="1 um", sigma="50 nm", spectrum=SPECTRUM, seed=4)
    results = asperity.compare(surface, CONTACT, pressures=["1 MPa", "10 MPa"])
    for rows in (results.curves, results.on_map, results.verdicts, results.at_load):
        frame = pandas.DataFrame(rows)
        assert len(frame) == len(rows) > 0 and len(frame.columns) > 5
    assert pandas.DataFrame(results.curves).equals(results.curves.to_pandas())


@pytest.mark.parametrize("through", ["pickle", "deepcopy", "copy"])
def test_objects_are_copied_and_sent(through):
    """What joblib and Dask do."""
    copied = {"pickle": lambda one: pickle.loads(pickle.dumps(one)), "deepcopy": copy.deepcopy, "copy": copy.copy}[through]
    soft = asperity.Material("2 MPa", 0.49, hardness="1 MPa", resistivity="17 nohm m")
    layered = asperity.Interface(STEEL, soft, asperity.Law("zmc", transition_ratio=110), layer=STEEL, thickness="2 mm", on="rough")
    bulk = asperity.Interface(STEEL, soft, layer=STEEL, thickness=np.inf)
    surface = asperity.generate(128, pixel=1e-6, sigma=50e-9, spectrum=SPECTRUM, seed=4).prepared_with(s="3 um")
    summits = surface.find_summits()
    population = asperity.Population("20 um", "50 nm", "6e10 /m^2", {"weibull": {"shape": 2}})
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for one in (soft, layered, bulk, layered.law, surface, summits, population):
            assert repr(copied(one)) == repr(one)
        assert copied(soft) == soft and hash(copied(soft)) == hash(soft) and copied(layered.law) == layered.law
        again = copied(surface)
    assert np.array_equal(again.find_summits().heights, summits.heights) and again.periodic
    contact = asperity.Interface(STEEL, STEEL)
    table = asperity.deterministic(copied(contact), copied(summits), pressures=["1 MPa", 1e7])
    sent = copied(table)
    assert repr(list(sent)) == repr(list(table)) and sent.units == table.units and sent.meanings == table.meanings
    results = asperity.compare(again, contact, pressures=[1e6, 1e7])
    assert copied(results).csv == results.csv and repr(copied(results)) == repr(results)
    assert copied(results).warnings == results.warnings


def test_a_copy_of_a_map_is_its_map_to_the_last_bit(tmp_path):
    """A file of single precision, far from zero: both decide how the map is read."""
    heights = asperity.generate(64, pixel=1e-6, sigma=50e-9, spectrum=SPECTRUM, seed=2).heights
    np.save(tmp_path / "map.npy", (1e-3 + heights).astype("f4"))
    read = asperity.Topography.read(tmp_path / "map.npy", pixel="1 um", unit="m")
    assert read.roughness == copy.deepcopy(read).roughness


def test_other_processes():
    from concurrent.futures import ProcessPoolExecutor
    from multiprocessing import get_context

    summits = [asperities(count) for count in (500, 1000)]
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
        sent = [pool.submit(asperity.deterministic, CONTACT, one, pressures="1 MPa") for one in summits]
        found = [one.result() for one in sent]
    for table, one in zip(found, summits):
        assert repr(list(table)) == repr(list(asperity.deterministic(CONTACT, one, pressures=1e6)))


def test_quantities_are_numbers_or_texts_with_units():
    assert asperity.Material("210 GPa", 0.3, hardness="7.6 GPa", resistivity="17 nohm m") == asperity.Material(
        210e9, 0.3, hardness=7.6e9, resistivity=17e-9
    )
    layer = {"layer": asperity.Material("300 GPa", 0.3, hardness="20 GPa")}
    assert asperity.Interface(STEEL, STEEL, **layer, thickness="2 um").thickness == 2e-6
    assert CONTACT.contact(["1 nm", 1e-9], "20 um")["load_n"][0] == CONTACT.contact(1e-9, 20e-6)["load_n"][0]
    assert repr(asperity.Population("20 um", "48 nm", "6e4 /mm^2")) == repr(asperity.Population(20e-6, 48e-9, 6e10))
    assert asperity.Asperities([0.0, 1e-7], [1e-5, 1e-5], "1 mm^2").nominal_area == 1e-6
    by_text = asperity.deterministic(CONTACT, asperities(), pressures=["1 MPa", "10 MPa"], separations=1, sigma="50 nm")
    by_number = asperity.deterministic(CONTACT, asperities(), pressures=[1e6, 1e7], separations=1, sigma=50e-9)
    assert repr(list(by_text)) == repr(list(by_number))
    heights = asperity.generate(64, pixel="1 um", sigma="50 nm", spectrum=SPECTRUM, seed=2).heights
    assert asperity.Topography(heights, ("1 um", 2e-6)).pixel == (1e-6, 2e-6)
    s, tip = (asperity.Topography(heights, "1 um", s=s, tip=tip).heights for s, tip in ((3e-6, 1e-6), ("3 um", "1 um")))
    assert np.array_equal(s, tip)
    loads = {"pressures": {"from": "1 MPa", "to": 1e7, "points": 3}, "forces": ["10 mN"], "nominal_area": "0.02 mm^2"}
    results = asperity.compare(asperities(), CONTACT, **loads)
    assert sorted(set(results.curves["target"].tolist())) == [0.01, 1e6, np.sqrt(1e13), 1e7]
    with pytest.raises(ValueError, match='^thickness: found "1 GPa"; allowed: zero or a positive finite length'):
        asperity.Interface(STEEL, STEEL, **layer, thickness="1 GPa")
    with pytest.raises(ValueError, match='^pixel: found "0,5 um".*the decimal separator is a point'):
        asperity.Topography(heights, "0,5 um")
    with pytest.raises(ValueError, match="^pixel: found 3 lengths"):
        asperity.Topography(heights, (1e-6, 1e-6, 1e-6))


@pytest.mark.parametrize(
    "call, message",
    [
        (lambda: asperity.Material(210e3, 0.3), 'young: found 210000; write "210 GPa"'),
        (lambda: asperity.Material(210e9, 0.3, hardness=7.6e3), 'hardness: found 7600; write "7.6 GPa"'),
        (lambda: asperity.Topography(np.eye(9), 1), 'pixel: found 1; write "1 µm" or "1 nm"'),
        (lambda: asperity.Topography(np.eye(9), 1e-6, tip=5), 'tip: found 5; write "5 µm"'),
        (lambda: asperity.Interface(STEEL, STEEL, layer=STEEL, thickness=2), 'thickness: found 2; write "2 µm"'),
        (lambda: asperity.Asperities([0.0], [1e-5], 4), 'nominal_area: found 4; write "4 mm^2"'),
        (lambda: asperity.Population(20, 0.048, 6e10), 'sigma: found 0.048; write "48 nm"'),
        (lambda: asperity.draw(10, radius=1.0, sigma=2e-3, density=1e4), "sigma: found 0.002"),
        (lambda: asperity.deterministic(CONTACT, asperities(), pressures=[10, 20]), 'pressures: found 10; write "10 MPa"'),
        (lambda: asperity.compare(asperities(), CONTACT, pressures=[10]), 'pressures: found 10; write "10 MPa"'),
    ],
)
def test_numbers_that_are_hardly_si_are_warned_of_where_they_stand(call, message):
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        call()
    found = [one for one in caught if message in str(one.message)]
    assert len(found) == 1, [str(one.message) for one in caught]
    assert issubclass(found[0].category, asperity.AsperityWarning) and issubclass(found[0].category, UserWarning)
    assert found[0].filename == __file__


def test_warnings_of_a_run_are_warned_of_and_stand_in_its_results():
    with pytest.warns(asperity.AsperityWarning):
        soft = asperity.Material(210e3, 0.3)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        results = asperity.compare(asperities(), asperity.Interface(STEEL, soft), pressures=[10])
    assert [str(one.message) for one in caught] == results.warnings
    assert any(one.startswith("pressures: found 10;") for one in results.warnings)
    assert any("Young's modulus is 210 kPa" in one for one in results.warnings)


def test_shown_and_drawn(monkeypatch):
    coated = asperity.Interface(STEEL, STEEL, layer=asperity.Material("300 GPa", 0.2, hardness="20 GPa"), thickness="1 um")
    assert repr(coated) == f'Interface(rough={STEEL}, flat={STEEL}, law=Law("zmc"), layer={coated.layer}, thickness=1e-6, rule="gao", on="flat")'
    surface = asperity.generate(64, pixel=1e-6, sigma=50e-9, spectrum=SPECTRUM, seed=2)
    results = asperity.compare({"a": surface, "b": asperities()}, CONTACT, pressures=[1e6, 1e7])
    assert repr(results).startswith(f"<Results of compare: {results.answer.sentence[:40]}")
    one = asperity.compare(surface, CONTACT, pressures=[1e6, 1e7])
    html = one._repr_html_()
    assert all(label in html for label in one.answer.labels.values()) and "<dl>" in html and "`" not in html
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    assert [line.get_label() for line in results.plot().lines] == [
        "a, statistical", "a, deterministic", "b, statistical", "b, deterministic"
    ]
    drawn = one.plot("separation_over_sigma", over="pressure_pa").lines[0].get_xydata()
    assert np.allclose(drawn[:, 0], [1e6, 1e7])
    image = surface.plot().images[0]
    assert np.allclose(image.get_array().T, 1e6 * surface.raw_heights) and image.get_extent() == [0, 64, 0, 64]
    with pytest.raises(ValueError, match="found the column 'area'; allowed: .*area_ratio"):
        one.plot("area")
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    with pytest.raises(ImportError, match="plot.. needs matplotlib, which is not installed: pip install matplotlib"):
        surface.plot()


def test_a_part_of_a_map(tmp_path):
    surface = asperity.generate(64, pixel=1e-6, sigma=50e-9, spectrum=SPECTRUM, seed=2)
    part = surface.prepared_with(level="plane").crop(x=(0, "20 um"), y=("3 um", 12e-6))
    assert np.array_equal(part.raw_heights, surface.raw_heights[:20, 3:12]) and not part.periodic
    assert np.nanmean(part.heights) == pytest.approx(0, abs=1e-12)
    assert surface.crop().points == (64, 64)
    surface.write(tmp_path / "map.gwy")
    assert asperity.Topography.read(tmp_path / "map.gwy", crop={"x": (0, "20 um")}, periodic=True).points == (20, 64)
    for wrong, message in (
        ({"x": (0, 1)}, "the map is 64 µm long along x, with points every 1 µm: `crop` from 0 m to 1 m is not within it"),
        ({"y": ("20 um", "10 um")}, "the map is 64 µm long along y"),
        ({"y": "20 um"}, "crop.y: found '20 um'; allowed: from and to"),
    ):
        with pytest.raises(ValueError, match=message):
            surface.crop(**wrong)
    assert np.array_equal(asperity.Topography(surface.raw_heights, "1 um", crop={"x": ("2 um", "9 um")}).raw_heights, surface.raw_heights[2:9])
    with pytest.raises(ValueError, match="crop: found 3; allowed"):
        asperity.Topography.read(tmp_path / "map.gwy", crop=3)


def test_reports_name_the_part_of_a_map_in_memory(tmp_path):
    surface = asperity.generate(96, pixel=1e-6, sigma=50e-9, spectrum=SPECTRUM, seed=2)
    part = surface.crop(x=(0, "64 um"), y=("10 um", 90e-6))
    used = "only a part of the map is used, x from 0 m to 64 µm, y from 10 µm to 90 µm."
    assert used in part.warnings and part.warnings == pickle.loads(pickle.dumps(part)).warnings
    assert not any("only a part" in warning for warning in surface.crop().warnings)
    results = asperity.compare(part, CONTACT, pressures=[1e6], report=tmp_path, name="part")
    assert any(used in warning for warning in results.warnings)
    assert used in (tmp_path / "part" / "report.md").read_text()


@pytest.mark.parametrize(
    "call",
    [
        lambda: asperity.Topography.read("no.npy"),
        lambda: asperity.run("no.toml"),
        lambda: asperity.compare({"file": {"path": "no.opd"}}, CONTACT, pressures=1e6),
        lambda: asperity.compare({"asperities": {"file": "no.csv", "nominal-area": "1 mm^2"}}, CONTACT, pressures=1e6),
        lambda: asperity.distributed.map("no.toml", {"seed": [1]}),
    ],
)
def test_a_missing_file_is_a_file_not_found(call):
    with pytest.raises(FileNotFoundError, match="no\\."):
        call()


def test_another_kind_of_object_is_told_how_to_make_it():
    surface = asperity.generate(64, pixel=1e-6, sigma=50e-9, spectrum=SPECTRUM, seed=2)
    with pytest.raises(TypeError, match=r"^asperities: found an object of <class 'asperity.surfaces.Topography'>; allowed: Asperities, such as topography.find_summits\(\)"):
        asperity.deterministic(CONTACT, surface, pressures=1e6)
    with pytest.raises(TypeError, match=r"^population: found an object .*; allowed: a Population, such as topography.find_summits\(\).population\(\)"):
        asperity.statistical(CONTACT, surface, pressures=1e6)
    assert "steel-100Cr6" in asperity.Material.names()
    assert all(isinstance(asperity.Material.named(name), asperity.Material) for name in asperity.Material.names())


def test_a_layer_on_the_rough_body():
    lead = asperity.Material(18e9, 0.35, hardness=170e6)
    bronze = asperity.Material(110e9, 0.34, hardness=1.9e9)
    on_rough = asperity.Interface(STEEL, bronze, layer=lead, thickness=2e-7, on="rough")
    exchanged = asperity.Interface(bronze, STEEL, layer=lead, thickness=2e-7)
    on_flat = asperity.Interface(STEEL, bronze, layer=lead, thickness=2e-7)
    assert (on_rough.on, exchanged.on) == ("rough", "flat")
    assert repr(on_rough).endswith('thickness=2e-7, rule="gao", on="rough")')
    load = [contact.contact(1e-7, 2e-5)["load_n"][0] for contact in (on_rough, exchanged, on_flat)]
    assert load[0] == load[1] != load[2]
    # The program is given the same key.
    found = [asperity.compare(asperities(), contact, separations=[2]).curves for contact in (on_rough, exchanged)]
    assert np.array_equal(found[0]["pressure_pa"], found[1]["pressure_pa"])


@pytest.mark.parametrize(
    "call, message",
    [
        (lambda: asperity.Material(-1, 0.3), "Young's modulus -1 Pa; allowed: positive"),
        (lambda: asperity.Material.named("steal"), 'found "steal"; allowed'),
        (lambda: asperity.Law("zmcc"), 'found the law "zmcc"; allowed: hertz, zmc'),
        (lambda: asperity.Law("zmc", ratio=2), "ratio"),
        (lambda: asperity.Law("zmc", transition_ratio=0.5), "transition-ratio 0.5; allowed"),
        (lambda: asperity.Interface(STEEL, STEEL, layer=STEEL), "only one of layer and thickness"),
        (lambda: asperity.Interface(STEEL, STEEL, layer=STEEL, thickness=-1), "thickness"),
        (lambda: asperity.Interface(STEEL, STEEL, rule="x"), "allowed: gao, series"),
        (lambda: asperity.Interface(STEEL, STEEL, on="ball"), 'on: found "ball"; allowed: rough, flat'),
        (lambda: asperity.Interface(STEEL, STEEL, "jackson-green"), "no yield-strength, which law jackson-green needs"),
        (lambda: CONTACT.contact([1e-9, np.nan], 1e-5), "indentation: found NaN"),
        (lambda: CONTACT.contact(1e-9, -1), "radius: found -1"),
        (lambda: asperity.Asperities([1.0], [1.0, 2.0], 1), "1 heights but 2 radii"),
        (lambda: asperity.Asperities([], [], 1), "no asperity"),
        (lambda: asperity.Asperities([[1.0]], [1.0], 1), "heights: found an array of 2 dimensions; allowed: 1"),
        (lambda: asperity.Asperities(["a"], [1.0], 1), "heights: found no numbers"),
        (lambda: asperity.Asperities([1.0], [0.0], 1), "radius 0 m; allowed: positive"),
        (lambda: asperity.Asperities([1.0], [1.0], 0), "nominal area 0"),
        (lambda: asperity.Asperities([1.0], [1.0], 1, curvatures=[[1.0]]), "curvatures: found the shape"),
        (lambda: asperity.Asperities([1.0], [1.0], 1, places=[[1.0]]), "places: found the shape"),
        (lambda: asperity.Asperities([1.0], [1.0], 1, places=[[1.0], [np.inf]]), "places: found one that is not finite"),
        (lambda: asperity.Population(1e-5, -1, 1e10), "sigma: found -1; allowed: positive"),
        (lambda: asperity.Population(1e-5, 1e-8, 1e10, "x"), 'heights: found "x"; allowed: "gaussian"'),
        (lambda: asperity.deterministic(CONTACT, asperities()), "found no separation and no pressure"),
        (lambda: asperity.deterministic(CONTACT, asperities(), separations=np.nan), "separations: found NaN"),
        (lambda: asperity.deterministic(CONTACT, asperities(), pressures=[1e6, -1]), "pressures: found -1"),
        (lambda: asperity.deterministic(CONTACT, asperities(), pressures=1e30), "deterministic model"),
        (
            lambda: asperity.deterministic(CONTACT, asperity.Asperities([1.0, 1.0], [1.0, 1.0], 1), separations=1),
            "all heights are equal",
        ),
        (
            lambda: asperity.deterministic(
                asperity.Interface(STEEL, STEEL, "elliptic-zmc"), asperities(), separations=1
            ),
            "no principal curvatures",
        ),
        (lambda: asperity.Topography([[1.0, 2.0], [3.0, 4.0]], 1e-6), "2 x 2 points; allowed: at least 3 x 3"),
        (lambda: asperity.Topography(np.zeros((4, 4)), 0), "pixel 0 x 0 m; allowed: positive"),
        (lambda: asperity.Topography(np.full((4, 4), np.nan), 1e-6), "no finite height"),
        (lambda: asperity.Topography(np.zeros((4, 4)), 1e-6, lvel="none"), "found lvel; allowed: align_lines"),
        (lambda: asperity.Topography(np.zeros((9, 9)), 1e-6).find_summits(), "flat to the rounding"),
        (lambda: asperity.Topography(np.eye(9), 1e-6, level="x").find_summits(), 'level: found `x`; allowed: `none`'),
        (lambda: asperity.generate(64, pixel=1e-6, sigma=1e-8), "found no `spectrum`"),
        (lambda: asperity.generate(4, pixel=1e-6, sigma=1e-8, spectrum=SPECTRUM), "allowed"),
        (lambda: asperity.draw(0, radius=1e-5, sigma=1e-8, density=1e10), "found 0; allowed: at least one"),
        (lambda: asperity.run({"title": "x"}), "found no experiment"),
        (lambda: asperity.run({"title": "x", "notes": object()}), "notes: found a object; allowed"),
        (lambda: asperity.run({"title": "x"}, name="a/b"), 'name: found "a/b"'),
        (lambda: asperity.compare(asperities(), CONTACT), "found no separations, pressures or forces; allowed"),
        (lambda: asperity.compare(asperities(), CONTACT, pressures=1e6, accept={"area": "x"}), 'accept.area: found "x"'),
        (lambda: asperity.compare(asperities(), CONTACT, pressures="1 MPaa"), 'pressures: found "1 MPaa"; allowed'),
        (lambda: asperity.compare(asperities(), CONTACT, separations=2e3), "separations: found 2000"),
        (lambda: asperity.compare(asperities(), CONTACT, pressures=1e6, acept=1), "acept: found the key `acept`"),
        (lambda: asperity.compare({"b": {"population": {"radius": -1}}}, CONTACT, pressures=1e6), "surface b.radius: found -1"),
        (lambda: asperity.compare(3, CONTACT, pressures=1e6), "found a int; allowed: a Topography"),
        (lambda: asperity.reference(asperities(), CONTACT, pressures=1e6), "map"),
    ],
)
def test_errors_say_what_is_allowed(call, message):
    with pytest.raises(ValueError) as error:
        call()
    assert message in str(error.value) and "dictionary, line" not in str(error.value) and "compare." not in str(error.value)


def test_files_as_labs_have_them(tmp_path):
    made = asperity.generate(64, pixel=1e-6, sigma=50e-9, spectrum=SPECTRUM, seed=2)
    nm = made.heights * 1e9
    x, y = np.meshgrid(*[np.arange(64.0)] * 2, indexing="ij")
    points = tmp_path / "points.csv"
    np.savetxt(points, np.column_stack([x.ravel(), y.ravel(), nm.ravel()]), delimiter=",", header="x_um,y_um,z_nm", comments="")
    taken = asperity.Topography.read(points)
    assert np.allclose(taken.raw_heights, made.heights) and np.allclose(taken.pixel, 1e-6)
    with pytest.warns(asperity.AsperityWarning, match="states lengths in um of x and y, nm of z; mm of x and y, nm of z, as `unit` says"):
        assert np.allclose(asperity.Topography.read(points, unit={"xy": "mm", "z": "nm"}).pixel, 1e-3)
    nm[3, 5] = -9999
    matrix = tmp_path / "matrix.csv"
    np.savetxt(matrix, nm, delimiter=",", header=",".join(map(str, range(64))), comments="")
    with pytest.raises(ValueError, match="holds the height -9999 at 1 point.*missing ?= ?-9999"):
        asperity.Topography.read(matrix, pixel=1e-6, unit="nm")
    taken = asperity.Topography.read(matrix, pixel=1e-6, unit="nm", missing=-9999, transpose=True)
    assert np.isnan(taken.raw_heights[3, 5]) and np.isnan(taken.raw_heights).sum() == 1
    assert any("line 1 of its file" in warning for warning in taken.warnings)
    with pytest.raises(ValueError, match="unit: found"):
        asperity.Topography.read(points, unit={"xy": "um"})


def test_an_array_is_no_topography_of_surface_topography():
    with pytest.raises(TypeError, match=r"found ndarray; allowed: .* Topography\(heights, pixel\)"):
        asperity.Topography.from_surface_topography(np.zeros((9, 9)))


def test_surfaces_of_surface_topography():
    made = asperity.generate(64, pixel=1e-6, sigma=50e-9, spectrum=SPECTRUM, seed=2)

    class Like:
        unit, is_periodic, physical_sizes = "µm", True, (64.0, 64.0)

        def heights(self):
            return made.heights * 1e6

    taken = asperity.Topography.from_surface_topography(Like())
    assert taken.periodic and np.allclose(taken.pixel, 1e-6)
    assert len(taken.find_summits()) == len(made.find_summits())
    masked = np.ma.masked_array(made.heights, mask=np.arange(64)[:, None] * np.ones(64) < 8)
    assert len(asperity.Topography(masked, 1e-6).find_summits()) < len(made.find_summits())
    SurfaceTopography = pytest.importorskip("SurfaceTopography")
    theirs = SurfaceTopography.Topography(made.heights * 1e9, (64e3, 64e3), unit="nm", periodic=True)
    taken = asperity.Topography.from_surface_topography(theirs)
    assert np.allclose(taken.find_summits().heights, made.find_summits().heights, rtol=1e-9, atol=1e-18)


def test_positions_are_those_of_the_summits():
    surface = asperity.generate(128, pixel=1e-6, sigma=50e-9, spectrum=SPECTRUM, seed=4)
    found = surface.find_summits()
    at = surface.summit_positions
    assert np.array_equal(surface.heights[at[:, 0], at[:, 1]], found.heights)
    # Radii are those of the mean of the principal curvatures.
    assert np.allclose(1 / found.radii, found.curvatures.mean(axis=0), rtol=1e-12)
    elliptic = asperity.Interface(STEEL, STEEL, "elliptic-zmc")
    assert asperity.deterministic(elliptic, found, separations=1)["pressure_pa"][0] > 0
    assert {check["check"] for check in surface.fitness} and surface.warnings is not None
    assert surface.fit_steps == []


def test_a_fit_removes_spikes_and_says_so():
    heights = asperity.generate(256, pixel=1e-6, sigma=50e-9, spectrum=SPECTRUM, seed=4).heights.copy()
    heights[40::80, 30::90] += 2e-6
    fitted = asperity.Topography(heights, 1e-6, fit="auto")
    first = fitted.fit_steps[0]
    assert (first["check"], first["remedy"], first["result"]) == ("spikes", 'outliers = "remove"', "applied")
    assert next(check for check in fitted.fitness if check["check"] == "spikes")["passed"]
    kept = asperity.Topography(heights, 1e-6, fit="auto", outliers="keep").fit_steps[0]
    assert kept["result"] == "refused" and kept["value_after"] is None


def test_the_interpreter_runs_on():
    count, done = 0, threading.Event()

    def spin():
        nonlocal count
        while not done.is_set():
            count += 1

    large = asperities(4_000_000)
    thread = threading.Thread(target=spin)
    thread.start()
    try:
        before = count
        asperity.deterministic(CONTACT, large, separations=np.linspace(4, -1, 100))
        assert count - before > 1000
    finally:
        done.set()
        thread.join()


def test_results_do_not_depend_on_threads():
    script = (
        "import asperity, numpy as np; steel = asperity.Material(210e9, 0.3, hardness=7.6e9);"
        "a = asperity.draw(300_000, radius=2e-5, sigma=5e-8, density=6e10);"
        "t = asperity.deterministic(asperity.Interface(steel, steel), a, separations=[2, 1], pressures=[1e6]);"
        "print([value.hex() for value in t['pressure_pa'].tolist() + t['separation_m'].tolist()])"
    )
    run = lambda threads: subprocess.run(
        [sys.executable, "-c", script],
        env={**os.environ, "RAYON_NUM_THREADS": threads},
        capture_output=True,
        check=True,
    ).stdout
    assert run("1") == run("2") == run("5") != b""


@pytest.fixture
def ctrl_c():
    """Ctrl-C as in a terminal, also where a shell has started the tests in its background, in which it is ignored."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def test_ctrl_c_ends_the_wait_and_the_work(ctrl_c):
    timer = threading.Timer(0.7, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    start = time.perf_counter()
    with pytest.raises(KeyboardInterrupt):
        surface = asperity.generate(2048, pixel=1e-6, sigma=50e-9, spectrum=SPECTRUM)
        asperity.reference(surface, CONTACT, pressures=list(np.geomspace(1e5, 1e7, 40)))
    assert time.perf_counter() - start < 3
    # The work itself ends at its next sign of progress.
    deadline = time.perf_counter() + 20
    while True:
        before = time.process_time()
        time.sleep(0.5)
        if time.process_time() - before < 0.1:
            break
        assert time.perf_counter() < deadline


def test_a_report_is_written(tmp_path):
    results = asperity.compare(asperities(), CONTACT, pressures=[1e6], report=tmp_path, name="mine", title="Mine")
    page = (tmp_path / "mine" / "report.html").read_text()
    assert results.report == tmp_path / "mine" and "Mine" in page
    answer = results.answer
    assert list(answer.lines)[:3] == ["result", "answer", "difference"] and answer.sentence == answer.lines["answer"]
    assert str(answer).startswith("Result at your load: 16.7 mN on 0.0167 mm² (1 MPa): ") and len(results.answers) == 1
    spec, surfaces = study._spec(CONTACT, asperities())
    spec["compare"]["pressure"] = 1e6
    results = asperity.run({**spec, "figure": {"width": "85 mm"}}, surfaces=surfaces, report=tmp_path, name="sized")
    figures = [path for path in results.report.glob("*.svg") if path.name != "card.svg"]
    assert figures and all('width="85mm"' in path.read_text() for path in figures)


def test_numbers_of_a_program_are_si_however_small():
    """A spec refuses a bare pressure of 500 Pa, an area of 1 m^2 and a sigma of 2 mm; a program may mean them."""
    for pressures in ([200.0, 500.0], np.array([200.0, 500.0]), {"from": 200, "to": 500, "points": 2}):
        results = asperity.compare(asperities(), CONTACT, pressures=pressures, nominal_area=1.0)
        assert sorted(set(results.curves["target"].tolist())) == [200.0, 500.0]
    assert asperity.draw(100, radius=1.0, sigma=2e-3, density=1e4).nominal_area == pytest.approx(1e-2)
