"""Studies over the workers of a Dask cluster: the results of one process, whatever becomes of a worker."""

import os
import pickle
import signal

import asperity
import numpy
import pytest
from asperity.distributed import combinations

VARIATIONS = {"seed": range(6), "compare.law": ["zmc", "hertz"]}


@pytest.fixture
def spec(tmp_path):
    path = tmp_path / "study.toml"
    path.write_text(
        """
        title = "study"
        [material.steel]
        young = "210 GPa"
        poisson = 0.3
        hardness = "7.6 GPa"
        [surface.S.population]
        radius = "20 um"
        sigma = "48 nm"
        density = "6e10 /m^2"
        count = 50_000
        [compare]
        rough = "steel"
        flat = "steel"
        law = "zmc"
        pressure = { from = "1 MPa", to = "10 MPa", points = 5 }
        """
    )
    return path


@pytest.fixture
def client():
    distributed = pytest.importorskip("distributed")
    with (
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as cluster,
        distributed.Client(cluster) as client,
    ):
        yield client


def content(results):
    return [(one.kind, one.csv, one.summary, one.warnings) for one in results]


def test_variations_are_the_runs_of_their_specs(spec):
    found = asperity.distributed.map(spec, VARIATIONS)
    assert len(found) == 12
    for variation, results in zip(combinations(VARIATIONS), found):
        changed = asperity._asperity.read_spec(spec)
        changed["seed"], changed["compare"]["law"] = variation["seed"], variation["compare.law"]
        assert asperity.run(changed, name="study").csv == results.csv
    assert found[0].csv != found[2].csv


def test_results_pass_between_processes(spec):
    (results,) = asperity.distributed.map(spec, [{"seed": 3}])
    results.tables
    copy = pickle.loads(pickle.dumps(results))
    assert content([copy]) == content([results])
    assert copy.curves["pressure_pa"].tolist() == results.curves["pressure_pa"].tolist()


def test_a_killed_worker_changes_no_byte(spec, client, tmp_path):
    before = client.run(os.getpid)
    done = []

    def kill_one(count, of):
        done.append(count)
        if count == 2:
            os.kill(next(iter(before.values())), signal.SIGKILL)

    found = asperity.distributed.map(spec, VARIATIONS, client, results=tmp_path / "kept", progress=kill_one)
    assert content(found) == content(asperity.distributed.map(spec, VARIATIONS))
    assert done == list(range(13))
    client.wait_for_workers(2, timeout=60)
    assert set(client.run(os.getpid).values()) != set(before.values())


def test_a_study_goes_on_where_it_was_left(spec, tmp_path):
    kept = tmp_path / "kept"
    whole = asperity.distributed.map(spec, VARIATIONS, results=kept)
    files = sorted(kept.iterdir())
    assert len(files) == 12
    files[3].unlink()
    files[7].write_bytes(files[7].read_bytes()[:100])
    done = []
    again = asperity.distributed.map(spec, VARIATIONS, results=kept, progress=lambda count, of: done.append(count))
    assert done == [10, 11, 12]
    assert content(again) == content(whole)
    # Another spec shares nothing; equal variations run once.
    done.clear()
    spec.write_text(spec.read_text().replace("50_000", "1_000"))
    one = asperity.distributed.map(
        spec, [{"seed": 1}, {"seed": 1}], results=kept, progress=lambda count, of: done.append(count)
    )
    assert done == [0, 1, 2]
    assert one[0].csv == one[1].csv


def test_files_are_found_beside_the_spec(tmp_path):
    for number in (1, 2):
        (tmp_path / f"list-{number}.csv").write_text(f"height,radius\n0,1e-5\n{number}e-8,1e-5\n3e-8,2e-5\n")
    spec = tmp_path / "lists.toml"
    spec.write_text(
        """
        title = "lists"
        [material.steel]
        young = "210 GPa"
        poisson = 0.3
        hardness = "7.6 GPa"
        [surface.S.asperities]
        file = "list-1.csv"
        nominal-area = "1 mm^2"
        [compare]
        rough = "steel"
        flat = "steel"
        law = "zmc"
        separation = [1, 0]
        """
    )
    files = {"surface.S.asperities.file": [f"list-{number}.csv" for number in (1, 2)]}
    found = asperity.distributed.map(spec, files)
    assert found[0].csv == asperity.run(spec).csv
    assert found[1].csv != found[0].csv


@pytest.mark.parametrize(
    ("variation", "words"),
    [
        ({"compare.law": "zmx"}, ["variation 2", "compare.law': 'zmx'", "zmc"]),
        ({"material.steel.young": -1.0}, ["variation 2", "young", "allowed"]),
        ({"title.of": 1}, ["found a value at title"]),
    ],
)
def test_a_variation_that_cannot_run_is_named_before_anything_runs(spec, variation, words):
    done = []
    with pytest.raises(ValueError) as refused:
        asperity.distributed.map(spec, [{}, variation], progress=lambda count, of: done.append(count))
    assert all(word in str(refused.value) for word in words), refused.value
    assert done == []


def test_what_only_a_run_finds_names_its_variation(spec, client):
    with pytest.raises(ValueError, match="variation 2.*1e15"):
        asperity.distributed.map(spec, [{}, {"compare.pressure": 1e15}], client)


SWEEP = """
[sweep]
seed = [1, 2]
"material.steel.hardness" = ["2 GPa", "8 GPa"]
find = { key = "material.steel.hardness", quantity = "area", ratio = 1.2, to = "8 GPa", at = "5 MPa" }
"""


def test_a_sweep_on_a_cluster_is_that_of_one_process(spec, client, tmp_path):
    spec.write_text(spec.read_text() + SWEEP)
    whole = asperity.run(spec, report=tmp_path / "whole")
    done = []
    swept = asperity.distributed.sweep(
        spec, client, report=tmp_path / "swept", results=tmp_path / "kept", progress=lambda *counts: done.append(counts)
    )
    assert done == [(count, 4) for count in range(5)]
    assert (swept.csv, swept.warnings, repr(swept.answer)) == (whole.csv, whole.warnings, repr(whole.answer))
    tables = [(tmp_path / folder / "study" / "sweep.csv").read_bytes() for folder in ("whole", "swept")]
    assert tables[0] == tables[1]
    # What is kept is not run again.
    done.clear()
    asperity.distributed.sweep(spec, results=tmp_path / "kept", progress=lambda *counts: done.append(counts))
    assert done == [(4, 4)]


TILED = """
title = "tiles"
material.steel = { young = "210 GPa", poisson = 0.3, hardness = "7.6 GPa" }
surface.S.KIND
[tiled]
rough = "steel"
flat = "steel"
law = "zmc"
separation = [2, 1, 0]
"""
POPULATION = 'population = { radius = "20 um", sigma = "48 nm", density = "6e10 /m^2", count = 200_000, realisations = 5 }'
MAP = 'file = { path = "map.npy", pixel = "1 um", level = "none" }'


@pytest.mark.parametrize(("surface", "passes"), [(POPULATION, 1), (MAP, 2)])
def test_tiles_on_a_cluster_are_those_of_one_process(surface, passes, client, tmp_path):
    """Also where a worker is killed, in the last pass."""
    numpy.save(tmp_path / "map.npy", 1e-8 * numpy.random.default_rng(1).normal(size=(700, 100)))
    spec = tmp_path / "tiles.toml"
    spec.write_text(TILED.replace("KIND", surface))
    whole = asperity.run(spec, report=tmp_path / "whole")
    before = client.run(os.getpid)
    done = []

    def kill_one(count, of):
        done.append(count)
        if len(done) == of - 2:
            os.kill(next(iter(before.values())), signal.SIGKILL)

    tiled = asperity.distributed.sweep(
        spec, client, report=tmp_path / "tiled", results=tmp_path / "kept", progress=kill_one
    )
    assert (tiled.csv, tiled.warnings) == (whole.csv, whole.warnings)
    assert len(set(done)) == done[-1] + 1 and done[-1] % passes == 0
    assert len(list((tmp_path / "kept").iterdir())) == done[-1]
    # What is kept is not run again.
    all_tasks = done[-1]
    done.clear()
    again = asperity.distributed.sweep(spec, results=tmp_path / "kept", progress=lambda count, of: done.append(count))
    assert again.csv == whole.csv and done[-1] == all_tasks and len(done) == passes


def test_the_variations_of_a_sweep_can_be_run_by_themselves(spec):
    spec.write_text(spec.read_text() + SWEEP)
    found = asperity.distributed.map(spec)
    assert len(found) == 4
    explicit = asperity.distributed.map(
        asperity._asperity.variations(asperity._asperity.read_spec(spec))[0][1],
        {"seed": [1, 2], "material.steel.hardness": ["2 GPa", "8 GPa"]},
    )
    assert [one.csv for one in found] == [one.csv for one in explicit]


def test_what_is_no_sweep_is_refused(spec):
    with pytest.raises(ValueError, match=r"found no \[sweep\]"):
        asperity.distributed.map(spec)
    with pytest.raises(ValueError, match=r"has no tasks; allowed: .*\[sweep\]"):
        asperity.distributed.sweep(spec)
