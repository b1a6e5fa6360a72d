"""What the program exports, read by others: maps by gwyfile and SurfaceTopography."""

import json
import subprocess

import gwyfile
import numpy as np
import pytest
import SurfaceTopography

import asperity

# Its multiple over its number is another pixel.
PIXEL = (13e-7, 9e-7)


def heights():
    """A map with a slope and missing points, not symmetric in any direction."""
    x, y = np.meshgrid(np.arange(60.0), np.arange(48.0), indexing="ij")
    z = 4e-8 * np.sin(1.1 * x + 0.3 * y) * np.cos(1.3 * y) + 1e-9 * x + 2e-10 * y
    z[7:9, 30] = np.nan
    return z


@pytest.fixture(scope="module")
def exported(experiment, tmp_path_factory):
    """A folder with the map after each step, in every format."""
    folder = tmp_path_factory.mktemp("export")
    np.save(folder / "map.npy", heights())
    pixel = ", ".join(map(str, PIXEL))
    for form in ("gwy", "x3p", "xyz", "npy"):
        command = [experiment, "export", "map", "map.npy", "--pixel", pixel, "--format", form, "--out", "out", "--quiet"]
        subprocess.run(command, cwd=folder, check=True)
    return folder / "out"


def same(found, wanted):
    return np.array_equal(found, wanted, equal_nan=True)


@pytest.fixture(scope="module")
def levelled(exported):
    """The map after the last step."""
    return np.load(exported / "map-levelled.npy")


def test_arrays_are_those_of_the_package(exported, levelled):
    assert same(np.load(exported / "map-measured.npy"), heights())
    assert same(levelled, asperity.Topography(heights(), PIXEL).heights)
    notes = json.loads((exported / "map-levelled.json").read_text())
    assert (tuple(notes["pixel_m"]), notes["Preparation"]) == (PIXEL, 'level = "plane"')


@pytest.mark.parametrize("step", ["measured", "levelled"])
def test_gwy_by_gwyfile(exported, levelled, step):
    container = gwyfile.load(str(exported / f"map-{step}.gwy"))
    field = gwyfile.util.get_datafields(container)["Height"]
    # Line after line, the first y at the top.
    assert same(field.data.T, heights() if step == "measured" else levelled)
    assert (field.si_unit_xy["unitstr"], field.si_unit_z["unitstr"]) == ("m", "m")
    assert (field.xreal / 60, field.yreal / 48) == pytest.approx(PIXEL, rel=1e-15)
    meta = container["/0/meta"]
    assert meta["Step"] == step and meta["File"].startswith("map.npy, SHA-256 ")


@pytest.mark.parametrize("ending", ["gwy", "x3p"])
def test_maps_by_surface_topography(exported, levelled, ending):
    topography = SurfaceTopography.read_topography(str(exported / f"map-levelled.{ending}"))
    assert same(np.ma.filled(topography.heights().astype(float), np.nan), levelled)
    assert topography.pixel_size == pytest.approx(PIXEL, rel=1e-12)


def test_columns_by_numpy(exported, levelled):
    x, y, z = np.loadtxt(exported / "map-levelled.xyz").T
    found = np.full(levelled.shape, np.nan)
    found[np.rint(x / PIXEL[0]).astype(int), np.rint(y / PIXEL[1]).astype(int)] = z
    assert same(found, levelled)


def test_maps_that_the_package_writes_are_read_back(tmp_path):
    topography = asperity.Topography(heights(), PIXEL)
    for ending in ("gwy", "x3p", "xyz"):
        for prepared in (False, True):
            path = tmp_path / f"a.{ending}"
            topography.write(path, prepared=prepared)
            again = asperity.Topography.read(path, level="none")
            assert again.pixel == topography.pixel
            assert same(again.raw_heights, topography.heights if prepared else topography.raw_heights)
    with pytest.raises(ValueError, match=r'ends in ".png"; allowed: .npy, .x3p, .gwy, .xyz'):
        topography.write(tmp_path / "a.png")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.gwy", "a.x3p", "a.xyz"]


SPEC = """
title = "tables"
seed = 3
material.steel = { young = 210e9, poisson = 0.3, hardness = 7.6e9 }
[compare]
rough = "steel"
flat = "steel"
law = "zmc"
separation = [2.5, 1.5]
pressure = [1e6, 1e7]
models = ["statistical", "deterministic", "reference"]
[surface.a.generate]
points = 128
pixel = 1e-6
sigma = 50e-9
realisations = 2
spectrum.self-affine = { hurst = 0.8, roll-off = 32e-6, cut-off = 8e-6 }
"""


def test_contact_patches_by_gwyfile(experiment, tmp_path):
    (tmp_path / "a.toml").write_text(SPEC)
    command = [experiment, "export", "patches", "a.toml", "--realisation", "2", "--pressure", "10 MPa", "--quiet"]
    subprocess.run(command, cwd=tmp_path, check=True)
    container = gwyfile.load(str(tmp_path / "a-2-contact.gwy"))
    fields = gwyfile.util.get_datafields(container)
    pressures, patches = (fields[name].data for name in ("Contact pressure", "Contact patches"))
    assert fields["Contact pressure"].si_unit_z["unitstr"] == "Pa"
    assert pressures.mean() == pytest.approx(1e7, rel=1e-9)
    assert np.array_equal(pressures > 0, patches > 0)
    assert patches.max() == len(np.unique(patches)) - 1 == int(container["/0/meta"]["Patches"])
    # The highest points are in contact.
    assert (pressures > 0)[np.unravel_index(fields["Height"].data.argmax(), pressures.shape)]
