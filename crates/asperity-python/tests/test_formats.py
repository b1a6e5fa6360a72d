"""Files of instruments read here and by independent readers: heights, pixel, orientation, missing points."""

from pathlib import Path

import gwyfile
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


# The reader, and its name of the channel that is read here by default.
READERS = {
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
        assert np.nanmax(abs(turned - np.nanmean(turned) - heights + np.nanmean(heights))) > 1e-3 * np.nanstd(heights)
