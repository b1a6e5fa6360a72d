"""Conductance, friction and tables of joints against the program."""

import pickle
import subprocess

import numpy as np
import pytest

import asperity

SPEC = """
title = "Comparison"
seed = 3

[material.rough]
young = 120e9
poisson = 0.34
hardness = 1e9
resistivity = 1.7e-8
thermal-conductivity = 400

[material.flat]
young = 120e9
poisson = 0.34
hardness = 1e9
resistivity = 1.7e-8
thermal-conductivity = 400

[compare]
rough = "rough"
flat = "flat"
law = "zmc"
pressure = [1e6, 3e6, 1e7]
conductance = { electrical = { film = "1e-13 ohm m^2" }, thermal = {} }
shear-strength = { tau0 = 20e6, alpha = 0.05 }

[surface.surface.population]
radius = 2e-5
sigma = 4.8e-8
density = 6e10
count = 20000
"""


@pytest.fixture(scope="module")
def copper():
    return asperity.Material(120e9, 0.34, hardness=1e9, resistivity=1.7e-8, thermal_conductivity=400)


@pytest.fixture(scope="module")
def results(copper):
    return asperity.compare(
        {"population": {"radius": "20 um", "sigma": "48 nm", "density": 6e10, "count": 20_000}},
        asperity.Interface(copper, copper),
        pressures=[1e6, 3e6, 1e7],
        quantities=["electrical-conductance", "thermal-conductance", "friction"],
        conductance={"electrical": {"film": "1e-13 ohm m^2"}},
        shear_strength={"tau0": 20e6, "alpha": 0.05},
        seed=3,
    )


def test_materials_conduct(copper):
    assert (copper.resistivity, copper.thermal_conductivity) == (1.7e-8, 400)
    assert repr(copper).endswith("resistivity=1.7e-8, thermal_conductivity=4e2)")
    assert asperity.Material.named("copper").resistivity > 1e-8
    with pytest.raises(ValueError, match="resistivity 0 ohm m"):
        asperity.Material(1e9, 0.3, resistivity=0)


def test_quantities_are_those_of_the_program(results, report):
    by_program = report(SPEC, "joint")
    for name in ("curves.csv", "comparison.csv", "results.csv"):
        assert results.csv[name] == (by_program / name).read_bytes(), name
    assert {"conductance", "friction"} <= set(results.answer.lines)
    friction, area = results.curves["friction"], results.curves["area_ratio"]
    assert np.allclose(friction, 20e6 * area / results.curves["pressure_pa"] + 0.05, rtol=1e-12)


def test_tables_of_joints_are_those_of_the_program(results, experiment, tmp_path):
    spec = tmp_path / "asperity.toml"
    spec.write_text(SPEC)
    for arguments in (["csv", "deterministic", "si"], ["calculix", "statistical", "mm"]):
        form, model, units = arguments
        out = tmp_path / form
        out.mkdir()
        options = ["--format", form, "--model", model, "--units", units, "--out", out, "--quiet"]
        subprocess.run([experiment, "export", "interface", spec, *options], check=True)
        written = {path.name: path.read_text() for path in out.iterdir()}
        assert results.to_interface_table(form, model=model, units=units) == written


def test_what_has_no_table_says_so(results):
    with pytest.raises(ValueError, match="format: found \"ansys\"; allowed: csv, calculix"):
        results.to_interface_table("ansys")
    with pytest.raises(ValueError, match="no load of the reference model"):
        results.to_interface_table(model="reference")
    with pytest.raises(ValueError, match="results of another process"):
        pickle.loads(pickle.dumps(results)).to_interface_table()


def test_quantities_that_cannot_be_asked_for(copper):
    contact = asperity.Interface(copper, copper)
    surface = asperity.draw(1000, radius=2e-5, sigma=4.8e-8, density=6e10)
    with pytest.raises(ValueError, match="quantities: found 'wear'"):
        asperity.compare(surface, contact, pressures=[1e6], quantities=["wear"])
    with pytest.raises(ValueError, match="'friction' without a shear strength"):
        asperity.compare(surface, contact, pressures=[1e6], quantities=["friction"])
    steel = asperity.Material(210e9, 0.3)
    with pytest.raises(ValueError, match="resistivity"):
        asperity.compare(
            surface, asperity.Interface(steel, steel), pressures=[1e6], quantities="electrical-conductance"
        )


def test_two_rough_bodies(copper):
    spectrum = {"self-affine": {"hurst": 0.8, "roll-off": 32e-6, "cut-off": 8e-6}}
    bodies = [asperity.generate(256, pixel=1e-6, sigma=50e-9, spectrum=spectrum, seed=seed) for seed in (1, 2)]
    results = asperity.compare(bodies[0].pair(bodies[1], shifts=2), asperity.Interface(copper, copper), pressures=[1e6, 1e7])
    assert set(results.curves["surface"]) == {"surface"} and set(results.curves["realisation"]) == {1, 2}
    with pytest.raises(ValueError, match="allowed: 1 to 1000"):
        asperity.compare(bodies[0].pair(bodies[1], shifts=0), asperity.Interface(copper, copper), pressures=[1e6])
