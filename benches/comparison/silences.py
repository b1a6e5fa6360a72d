"""The longest times that a run goes without a sign of progress, at which it also ends where it is no longer wanted.

python benches/comparison/silences.py [--write] [NAME...]

Runs the specs below, or those named, on files of 100 to 500 MB and surfaces of up to 4096 x 4096 points, by the release build of `silences`, and prints
the stages with the longest silences. `BEFORE=PROGRAM` names a build of an earlier version of `silences`, which each spec is run by first. It needs numpy and 2 GB
on the disk; the files are kept in `SILENCES`, or in the folder of temporary files, for the next run.
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import zipfile

import numpy as np

from timing import ROOT, publish

FOLDER = pathlib.Path(os.environ.get("SILENCES", pathlib.Path(tempfile.gettempdir()) / "silences"))
PIXEL = 1e-6


def heights(side):
    """A self-affine surface, in m, of waves down to 8 pixels."""
    frequency = np.hypot(np.fft.fftfreq(side)[:, None], np.fft.rfftfreq(side)[None, :])
    amplitude = np.maximum(frequency, 16 / side) ** -1.8 * (frequency < 1 / 8)
    waves = np.fft.rfft2(np.random.default_rng(1).standard_normal((side, side))) * amplitude
    surface = np.fft.irfft2(waves, s=(side, side))
    return surface * (1e-7 / surface.std())


def text(path, z, side):
    np.savetxt(path, z * 1e6, fmt="%.7g")


def xyz(path, z, side):
    x, y = np.meshgrid(np.arange(side), np.arange(side))
    np.savetxt(path, np.column_stack([x.ravel(), y.ravel(), z.ravel() * 1e6]), fmt=["%d", "%d", "%.7g"])


def sdf_text(path, z, side):
    head = f"aISO-1.0\nManufacID = none\nNumPoints = {side}\nNumProfiles = {side}\nXscale = 1e-6\nYscale = 1e-6\nZscale = 1e-9\nZresolution = 1e-12\nCompression = 0\nDataType = 7\nCheckType = 0\n*\n"
    with open(path, "w") as out:
        out.write(head)
        np.savetxt(out, z * 1e9, fmt="%.7g")
        out.write("*\n")


def sdf_binary(path, z, side):
    head = b"bISO-1.0" + b"none".ljust(10) + b"010120200000" * 2 + np.array([side, side], "<u2").tobytes()
    head += np.array([PIXEL, PIXEL, 1e-9, 1e-12], "<f8").tobytes() + bytes([0, 7, 0])
    path.write_bytes(head + (z * 1e9).tobytes())


def x3p(path, z, side):
    axis = lambda name, kind, step: f"<{name}><AxisType>{kind}</AxisType><DataType>D</DataType><Increment>{step}</Increment><Offset>0</Offset></{name}>"
    axes = axis("CX", "I", PIXEL) + axis("CY", "I", PIXEL) + axis("CZ", "A", 1)
    matrix = f"<MatrixDimension><SizeX>{side}</SizeX><SizeY>{side}</SizeY><SizeZ>1</SizeZ></MatrixDimension>"
    link = "<DataLink><PointDataLink>bindata/data.bin</PointDataLink></DataLink>"
    main = f'<p:ISO5436_2 xmlns:p="http://www.opengps.eu/2008/ISO5436_2"><Record1><Revision>ISO5436 - 2000</Revision><FeatureType>SUR</FeatureType><Axes>{axes}</Axes></Record1><Record3>{matrix}{link}</Record3></p:ISO5436_2>'
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
        archive.writestr("main.xml", main)
        archive.writestr("bindata/data.bin", z.tobytes())


def gwy(path, z, side):
    item = lambda name, kind, value: name.encode() + b"\0" + kind + value
    size = lambda count: np.uint32(count).tobytes()
    held = lambda name, content: name + b"\0" + size(len(content)) + content
    metre = held(b"GwySIUnit", item("unitstr", b"s", b"m\0"))
    field = b"".join([
        item("xres", b"i", size(side)), item("yres", b"i", size(side)),
        item("xreal", b"d", np.float64(side * PIXEL).tobytes()), item("yreal", b"d", np.float64(side * PIXEL).tobytes()),
        item("si_unit_xy", b"o", metre), item("si_unit_z", b"o", metre), item("data", b"D", size(z.size) + z.tobytes()),
    ])
    channel = item("/0/data", b"o", held(b"GwyDataField", field)) + item("/0/data/title", b"s", b"Height\0")
    path.write_bytes(b"GWYP" + held(b"GwyContainer", channel))


def npy(path, z, side):
    np.save(path, z)


def fortran(path, z, side):
    np.save(path, np.asfortranarray(z))


def asperities(path, count):
    rng = np.random.default_rng(2)
    both = np.column_stack([48e-9 * rng.standard_normal(count), 20e-6 * rng.uniform(0.5, 1.5, count)])
    if path.suffix == ".npy":
        np.save(path, both)
    else:
        np.savetxt(path, both, fmt="%.9g", delimiter=",", header="height,radius", comments="")


MAPS = {
    "map.txt": (text, 4096), "map.xyz": (xyz, 2896), "text.sdf": (sdf_text, 4096), "binary.sdf": (sdf_binary, 4096), "map.x3p": (x3p, 4096),
    "map.gwy": (gwy, 4096), "map.npy": (npy, 4096), "map2048.npy": (npy, 2048), "fortran.npy": (fortran, 4096),
}
LISTS = {"list.csv": 10**7, "list.npy": 3 * 10**7}

STEEL = '[material.steel]\nyoung = "210 GPa"\npoisson = 0.3\nhardness = "7.6 GPa"\n[material.lead]\nyoung = "18 GPa"\npoisson = 0.35\nhardness = "0.17 GPa"\n'
PLAIN = 'rough = "steel"\nflat = "steel"\nlaw = "zmc"\n'
LOADS = 'pressure = { from = "1 MPa", to = "300 MPa", points = 9 }\n'
LAYER = 'layer = { material = "lead", thickness = [0, "50 nm", "inf"] }\n'
SELF_AFFINE = 'points = POINTS\npixel = "1 um"\nspectrum.self-affine = { hurst = 0.8, roll-off = "256 um", cut-off = "8 um" }\nsigma = "100 nm"\n'


def compare(surface, keys="robustness = false\n" + LOADS, more=""):
    return f'title = "t"\nseed = 1\n{STEEL}[compare]\n{PLAIN}{keys}[surface.a.{surface}\n{more}'


def file(name, pixel=True, unit="um"):
    held = '' if not pixel else 'pixel = "1 um"\n' + (f'unit = "{unit}"\n' if unit else '')
    return f'file]\npath = "{name}"\n{held}'


def generated(points, more=""):
    return "generate]\n" + SELF_AFFINE.replace("POINTS", str(points)) + more


SUMS = "attribution = false\nrank-models = false\n" + LOADS
ALL = "robustness = true\n" + LAYER + LOADS
SPECS = {
    "text": compare(file("map.txt")),
    "columns x y z": compare(file("map.xyz", True).replace('pixel = "1 um"\n', "")),
    "SDF, text": compare(file("text.sdf", False)),
    "SDF, binary": compare(file("binary.sdf", False)),
    "X3P": compare(file("map.x3p", False)),
    "Gwyddion": compare(file("map.gwy", False)),
    "NumPy": compare(file("map.npy", True, None)),
    "NumPy, Fortran order": compare(file("fortran.npy", True, None)),
    "filters": compare(file("map.npy", True, None) + 'filter = { s = "5 um", l = "500 um" }\nlevel = "quadratic"\n'),
    "tip, spikes, lines": compare(file("map.npy", True, None) + 'tip = "5 um"\noutliers = "remove"\nalign-lines = "x"\n'),
    "fit": compare(file("map2048.npy", True, None) + 'fit = "auto"\n'),
    "all of a map of 2048": compare(file("map2048.npy", True, None), ALL),
    "all of a map of 4096": compare(file("map.npy", True, None), ALL),
    "list, CSV": compare('asperities]\nfile = "list.csv"\nnominal-area = "100 mm2"\nindependent = true\n', SUMS),
    "list, NumPy": compare('asperities]\nfile = "list.npy"\nnominal-area = "300 mm2"\nindependent = true\n', SUMS),
    "population": compare('population]\nradius = "20 um"\nsigma = "48 nm"\ndensity = "6e10 /m^2"\ncount = 30_000_000\n', SUMS),
    "reference of 2048": compare(generated(2048), 'models = ["statistical", "deterministic", "reference"]\npressure = "50 MPa"\n'),
    "reference, refined": compare(generated(2048), 'models = ["statistical", "deterministic", "reference"]\nreference = { refine = 2 }\npressure = "50 MPa"\n'),
    "generated, Gaussian": compare(generated(4096), LOADS),
    "generated, Johnson": compare(generated(4096, "heights.johnson = { skewness = -1, kurtosis = 4.5 }\n"), LOADS),
    "generated, realisations": compare(generated(2048, "realisations = 4\n"), LOADS),
    "small map": compare(generated(2048).replace('256 um', '2000 um'), LOADS),
    "pair": compare('pair]\na = "b"\nb = "c"\n', LOADS, "".join(f"[surface.{name}.{generated(2048)}" for name in "bc")),
    "sweep": compare(file("map2048.npy", True, None), LOADS) + '[sweep]\n"surface.a.file.filter.s" = ["3 um", "5 um"]\n',
    "tiled": f'title = "t"\nseed = 1\n{STEEL}[surface.a.population]\nradius = "20 um"\nsigma = "48 nm"\ndensity = "6e10 /m^2"\ncount = 100_000_000\n[tiled]\n{PLAIN}separation = {{ from = 5, to = 0, points = 21 }}\n',
    "sampling interval": f'title = "t"\nseed = 1\n{STEEL}[sampling-interval]\n{PLAIN}pressure = ["10 MPa"]\n[surface.a.{file("map2048.npy", True, None)}',
}


def inputs():
    FOLDER.mkdir(exist_ok=True)
    surfaces = {}
    for name, (write, side) in MAPS.items():
        if not (FOLDER / name).exists():
            if side not in surfaces:
                surfaces[side] = heights(side)
            write(FOLDER / name, surfaces[side], side)
    for name, count in LISTS.items():
        if not (FOLDER / name).exists():
            asperities(FOLDER / name, count)


def built():
    """The release build."""
    build = subprocess.run(
        ["cargo", "build", "--release", "-p", "asperity-benches", "--bin", "silences", "--message-format=json"],
        cwd=ROOT, check=True, capture_output=True, text=True,
    )
    messages = map(json.loads, build.stdout.splitlines())
    return [m["executable"] for m in messages if m.get("target", {}).get("name") == "silences"][-1]


def longest(program, name):
    """The stage of the longest silence of a run, its seconds, and those of the whole run."""
    path = FOLDER / (name.replace(",", "").replace(" ", "-") + ".toml")
    path.write_text(SPECS[name])
    found = subprocess.run([program, path], check=True, capture_output=True, text=True).stdout
    stages = [line.split("\t") for line in found.splitlines()]
    if any(len(stage) != 5 for stage in stages):
        sys.exit(found)
    _, stage, seconds, *_ = max(stages, key=lambda stage: float(stage[2]))
    return stage, float(seconds), sum(float(stage[3]) for stage in stages)


def main():
    inputs()
    programs = ([os.environ["BEFORE"]] if "BEFORE" in os.environ else []) + [built()]
    names = [name for name in SPECS if name in sys.argv] or SPECS
    rows = []
    for name in names:
        cells = [name]
        for program in programs:
            stage, seconds, whole = longest(program, name)
            cells += [stage, f"{seconds:.2f}", f"{whole:.0f}"]
        rows.append("| " + " | ".join(cells) + " |")
        print(rows[-1], flush=True)
    head = ["longest silence", "[s]", "whole run [s]"]
    heads = [["before: " + head[0], *head[1:]], head][2 - len(programs) :]
    publish("silences", [
        "| run | " + " | ".join(word for words in heads for word in words) + " |",
        "|---|" + "---|---:|---:|" * len(programs),
        *rows,
    ])


if __name__ == "__main__":
    main()
