"""Files of instruments read here and by independent readers: heights, pixel, orientation, missing points."""

from pathlib import Path

import gwyfile
import h5py
import numpy as np
import pytest
import SurfaceTopography
from SurfaceTopography.Support.UnitConversion import get_unit_conversion_factor

import asperity

SAMPLES = Path(__file__).resolve().parents[2] / "asperity/tests/library/formats/samples"


def by_surface_topography(path, channel):
    """Heights and pixel in m, by SurfaceTopography."""
    reader = SurfaceTopography.open_topography(str(path))
    names = [found.name for found in reader.channels]
    topography = reader.topography(channel_index=names.index(channel) if channel else 0)
    unit = get_unit_conversion_factor(topography.unit, "m")
    heights = np.ma.filled(topography.heights().astype(np.float64), np.nan) * unit
    return heights, [size * unit for size in topography.pixel_size]


def by_gwyfile(path, channel):
    """The same by gwyfile, which leaves masks alone."""
    channels = gwyfile.util.get_datafields(gwyfile.load(str(path)))
    field = channels[channel]
    return field.data.T, [field.xreal / field.data.shape[1], field.yreal / field.data.shape[0]]


def by_h5py(path, channel):
    """The same of a file of Zygo, whose heights are in fringes."""
    with h5py.File(path) as file:
        (surface,) = file["Data/Surface"].values()
        factors = ("Wavelength", "Interferometric Scale Factor", "Obliquity Factor")
        factor = np.prod([surface.attrs[name][0] for name in factors])
        missing = surface.attrs["No Data"][0]
        numbers = surface[()]
        key = "Data Context.Lateral Resolution:Value"
        pixel = next(group.attrs[key][0] for group in file["Attributes"].values() if key in group.attrs)
    heights = np.where(numbers >= missing, np.nan, numbers).T * factor
    return heights, [pixel, pixel]


# The reader, and its name of the channel that is read here by default.
READERS = {
    "asylum.ibw": (by_surface_topography, "HeightTrace"),
    "jpk-map.jpk": (by_surface_topography, "Height"),
    "nanosurf.gwy": (by_gwyfile, "Topography"),
    "park.tiff": (by_surface_topography, "Topography"),
    "st-al3d-1.al3d": (by_surface_topography, None),
    "st-bcrf-1.bcrf": (by_surface_topography, None),
    "st-di-3.spm": (by_surface_topography, "ZSensor"),
    "st-metropro-1.dat": (by_surface_topography, None),
    "st-nid-1.nid": (by_surface_topography, "Scan forward (Z-Axis)"),
    "st-opd-1.opd": (by_surface_topography, "Raw"),
    "st-plu-1.plu": (by_surface_topography, None),
    "st-sur-2.sur": (by_surface_topography, None),
    "zygo_test.datx": (by_h5py, None),
}


def test_every_sample_has_an_independent_reader():
    samples = {path.name for path in SAMPLES.iterdir()} - {"README.md"}
    assert samples == set(READERS)


@pytest.mark.parametrize("name", READERS)
def test_files_are_read_as_by_others(name):
    read, channel = READERS[name]
    wanted, pixel = read(SAMPLES / name, channel)
    found = asperity.Topography.read(SAMPLES / name, missing=[])
    heights = found.raw_heights
    assert found.pixel == pytest.approx(pixel, rel=1e-12)
    assert np.array_equal(np.isnan(heights), np.isnan(wanted))
    # Offsets differ by convention.
    difference = (heights - np.nanmean(heights)) - (wanted - np.nanmean(wanted))
    assert np.nanmax(abs(difference)) <= 1e-9 * np.ptp(wanted[np.isfinite(wanted)])
    # A mirrored or turned map would pass were it symmetric.
    for turned in (wanted[::-1], wanted[:, ::-1]):
        difference = (turned - np.nanmean(turned)) - (heights - np.nanmean(heights))
        assert np.nanmax(abs(difference)) > 1e-3 * np.nanstd(heights)
