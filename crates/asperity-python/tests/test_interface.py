"""What a user meets: arrays, tables, errors, threads and interrupts."""

import doctest
import gc
import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Mapping

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


def test_tables_are_mappings_with_units():
    table = asperity.deterministic(CONTACT, asperities(), separations=[2, 1, 0], pressures=1e6)
    assert isinstance(table, Mapping) and len(table) == len(list(table)) == len(table.keys())
    assert table.rows == 4 and table["control"].tolist() == ["separation"] * 3 + ["pressure"]
    assert table["pressure_pa"] is table["pressure_pa"]
    assert "pressure_pa" in table and "x" not in table and table.get("x") is None
    assert table.units["pressure_pa"] == "Pa" and "Nominal pressure" in table.meanings["pressure_pa"]
    assert table["beyond_model"].dtype == bool and dict(table)["area_ratio"].dtype == np.float64
    with pytest.raises(KeyError, match="the columns are model, control"):
        table["x"]
    frame = pytest.importorskip("pandas")
    assert list(table.to_pandas().columns) == list(table)
    assert isinstance(table.to_pandas(), frame.DataFrame)
    pytest.importorskip("xarray")
    assert table.to_xarray()["pressure_pa"].attrs["units"] == "Pa"


def test_a_layer_on_the_rough_body():
    lead = asperity.Material(18e9, 0.35, hardness=170e6)
    bronze = asperity.Material(110e9, 0.34, hardness=1.9e9)
    on_rough = asperity.Interface(STEEL, bronze, layer=lead, thickness=2e-7, on="rough")
    exchanged = asperity.Interface(bronze, STEEL, layer=lead, thickness=2e-7)
    on_flat = asperity.Interface(STEEL, bronze, layer=lead, thickness=2e-7)
    assert (on_rough.on, exchanged.on) == ("rough", "flat")
    assert repr(on_rough).endswith('thickness=2e-7, on="rough")')
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
        (lambda: asperity.deterministic(CONTACT, asperities(), separations=1, tolerance=2), "tolerance: found 2"),
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
        (lambda: asperity.Topography.read("no.npy"), "no.npy"),
        (lambda: asperity.generate(64, pixel=1e-6, sigma=1e-8), "found no `spectrum`"),
        (lambda: asperity.generate(4, pixel=1e-6, sigma=1e-8, spectrum=SPECTRUM), "allowed"),
        (lambda: asperity.draw(0, radius=1e-5, sigma=1e-8, density=1e10), "found 0; allowed: at least one"),
        (lambda: asperity.run("no.toml"), "no.toml: cannot be read"),
        (lambda: asperity.run({"title": "x"}), "found no experiment"),
        (lambda: asperity.run({"title": "x", "notes": object()}), "notes: found a object; allowed"),
        (lambda: asperity.run({"title": "x"}, name="a/b"), 'name: found "a/b"'),
        (lambda: asperity.compare(asperities(), CONTACT), "found no separation, pressure or force"),
        (lambda: asperity.compare(asperities(), CONTACT, pressures=1e6, accept={"area": "x"}), "compare.accept.area"),
        (lambda: asperity.compare(3, CONTACT, pressures=1e6), "found a int; allowed: a Topography"),
        (lambda: asperity.reference(asperities(), CONTACT, pressures=1e6), "map"),
    ],
)
def test_errors_say_what_is_allowed(call, message):
    with pytest.raises(ValueError) as error:
        call()
    assert message in str(error.value)


def test_files_as_labs_have_them(tmp_path):
    made = asperity.generate(64, pixel=1e-6, sigma=50e-9, spectrum=SPECTRUM, seed=2)
    nm = made.heights * 1e9
    x, y = np.meshgrid(*[np.arange(64.0)] * 2, indexing="ij")
    points = tmp_path / "points.csv"
    np.savetxt(points, np.column_stack([x.ravel(), y.ravel(), nm.ravel()]), delimiter=",", header="x_um,y_um,z_nm", comments="")
    taken = asperity.Topography.read(points)
    assert np.allclose(taken.raw_heights, made.heights) and np.allclose(taken.pixel, 1e-6)
    with pytest.raises(ValueError, match=r"x and y in um, z in nm\), and the unit given is mm of x and y, nm of z"):
        asperity.Topography.read(points, unit={"xy": "mm", "z": "nm"})
    nm[3, 5] = -9999
    matrix = tmp_path / "matrix.csv"
    np.savetxt(matrix, nm, delimiter=",", header=",".join(map(str, range(64))), comments="")
    with pytest.raises(ValueError, match="holds the height -9999 at 1 point.*Pass missing=-9999"):
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
    with pytest.raises(ValueError, match="figure"):
        spec, surfaces = study._spec(CONTACT, asperities())
        spec["compare"]["pressure"] = 1e6
        asperity.run({**spec, "figure": {"width": "85 mm", "font": "8 pt"}}, surfaces=surfaces, report=tmp_path)


def test_numbers_of_a_program_are_si_however_small():
    """A spec refuses a bare pressure of 500 Pa, an area of 1 m^2 and a sigma of 2 mm; a program means them."""
    assert study._all_in("Pa", [1.0, "2 MPa", np.float64(3)]) == ["1.0 Pa", "2 MPa", "3.0 Pa"]
    assert study._all_in("Pa", np.array([5, 6])) == ["5.0 Pa", "6.0 Pa"]
    assert study._all_in("Pa", {"from": 1, "to": 4.0, "points": 3}) == {"from": "1.0 Pa", "to": "4.0 Pa", "points": 3}
    assert study._all_in("Pa", None) is None and study._all_in("Pa", {"values": (1,)}) == {"values": ["1.0 Pa"]}
    for pressures in ([200.0, 500.0], np.array([200.0, 500.0]), {"from": 200, "to": 500, "points": 2}):
        results = asperity.compare(asperities(), CONTACT, pressures=pressures, nominal_area=1.0)
        assert sorted(set(results.curves["target"].tolist())) == [200.0, 500.0]
    assert asperity.draw(100, radius=1.0, sigma=2e-3, density=1e4).nominal_area == pytest.approx(1e-2)
