"""Tables of `experiment export interface` in CalculiX: two blocks of one element each, pressed and heated through the joint.

The pressure over the closure of an interaction with a tabular overclosure, and the heat flow of the one that conducts, are those of
the exported curve. Needs `ccx` (Debian: calculix-ccx), and the program in EXPERIMENT or target/debug.
"""

import csv
import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
PROGRAM = os.environ.get("EXPERIMENT", str(ROOT / "target/debug/experiment"))

pytestmark = pytest.mark.skipif(
    not (shutil.which("ccx") and Path(PROGRAM).exists()), reason="needs ccx and the program"
)

SPEC = """
title = "Joint"
seed = 3
[material]
steel = { from = "steel-C45-normalised" }
[compare]
rough = "steel"
flat = "steel"
law = "zmc"
conductance = "thermal"
shear-strength = { tau0 = "200 MPa" }
pressure = { from = "1 MPa", to = "20 MPa", points = 25 }
[surface.ground.population]
radius = "20 um"
sigma = "48 nm"
density = "6e10 /m^2"
count = 20000
"""

NODES = [
    (first + number, x, y, z)
    for first, bottom in ((1, 0.0), (11, 1.0))
    for number, (x, y, z) in enumerate(
        [(x, y, z) for z in (bottom, bottom + 1.0) for x, y in ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0))]
    )
]


def model(interaction, contact, closing):
    """Two cubes of 1 mm, the upper one pressed down by `closing` (mm) and 100 K hotter on top."""
    nodes = "\n".join(f"{number},{x},{y},{z}" for number, x, y, z in NODES)
    return f"""*INCLUDE, INPUT=joint.inp
*NODE, NSET=ALL
{nodes}
*NSET, NSET=BOTTOM
1,2,3,4
*NSET, NSET=TOP
15,16,17,18
*NSET, NSET=JOINT
5,11
*ELEMENT, TYPE=C3D8, ELSET=LOWER
1,1,2,3,4,5,6,7,8
*ELEMENT, TYPE=C3D8, ELSET=UPPER
2,11,12,13,14,15,16,17,18
*MATERIAL, NAME=STEEL
*ELASTIC
210000.,0.3
*CONDUCTIVITY
50.
*SOLID SECTION, ELSET=LOWER, MATERIAL=STEEL
*SOLID SECTION, ELSET=UPPER, MATERIAL=STEEL
*SURFACE, NAME=SLAVE, TYPE=ELEMENT
UPPER, S1
*SURFACE, NAME=MASTER, TYPE=ELEMENT
LOWER, S2
*CONTACT PAIR, INTERACTION={interaction}, TYPE={contact} TO SURFACE
SLAVE, MASTER
*INITIAL CONDITIONS, TYPE=TEMPERATURE
ALL, 0.
*STEP, NLGEOM, INC=1000
*COUPLED TEMPERATURE-DISPLACEMENT, STEADY STATE
0.1, 1.
*BOUNDARY
ALL, 1, 2, 0.
BOTTOM, 3, 3, 0.
TOP, 3, 3, {-closing}
BOTTOM, 11, 11, 0.
TOP, 11, 11, 100.
*NODE PRINT, NSET=JOINT
U, NT
*NODE PRINT, NSET=TOP
RF, RFL
*END STEP
"""


def last(text, heading, rows):
    """The numbers of the last table under a heading, without its node numbers."""
    table = text.rsplit(heading, 1)[1].split("\n")[2 : 2 + rows]
    # Fortran leaves out the E of exponents of three digits.
    number = lambda value: float(re.sub(r"(?<=\d)([+-]\d{3})$", r"E\1", value))
    return [[number(value) for value in line.split()[1:]] for line in table]


def solved(folder, interaction, contact, closing):
    """Pressure (MPa), closure (mm), heat flow (mW) and temperature difference (K) of the joint."""
    (folder / "model.inp").write_text(model(interaction, contact, closing))
    run = subprocess.run(["ccx", "model"], cwd=folder, capture_output=True, text=True)
    assert "ERROR" not in run.stdout, run.stdout
    text = (folder / "model.dat").read_text()
    (_, _, lower), (_, _, upper) = last(text, "displacements", 2)
    (cold,), (hot,) = last(text, "temperatures", 2)
    forces, heats = last(text, "forces", 4), last(text, "heat generation", 4)
    return -sum(force[2] for force in forces), lower - upper, sum(heat[0] for heat in heats), hot - cold


@pytest.fixture(scope="module")
def joint(tmp_path_factory):
    """A folder with the tables, and the columns of the CSV: pressure, closure and conductance in MPa, mm and mW/(mm^2 K)."""
    folder = tmp_path_factory.mktemp("joint")
    (folder / "joint.toml").write_text(SPEC)
    for form in ("calculix", "csv"):
        command = [PROGRAM, "export", "interface", "joint.toml", "--format", form, "--units", "mm", "--quiet"]
        subprocess.run(command, cwd=folder, check=True)
    lines = [line for line in (folder / "joint.csv").read_text().split("\n") if not line.startswith("#")]
    rows = list(csv.DictReader(lines))
    columns = [[float(row[name]) for row in rows] for name in ("pressure", "closure", "thermal_conductance")]
    return folder, columns


def at(x, xs, ys):
    """Between two points of a table."""
    place = max(k for k in range(len(xs) - 1) if xs[k] <= x)
    return ys[place] + (ys[place + 1] - ys[place]) * (x - xs[place]) / (xs[place + 1] - xs[place])


@pytest.mark.parametrize("closing", [8e-5, 1.2e-4, 2e-4])
def test_the_pressure_is_that_of_the_curve(joint, closing):
    folder, (pressures, closures, _) = joint
    text = (folder / "joint.inp").read_text()
    lead = float(re.search(r"Closure 0 is (\S+) further out", text).group(1))
    pressure, closure, _, _ = solved(folder, "JOINT", "NODE", closing)
    assert pressure == pytest.approx(at(closure - lead, closures, pressures), rel=1e-2)
    assert pressure > pressures[0]


@pytest.mark.parametrize("closing", [8e-5, 1.2e-4, 2e-4])
def test_the_heat_flow_is_that_of_the_curve(joint, closing):
    folder, (pressures, _, conductances) = joint
    pressure, _, heat, jump = solved(folder, "JOINT-HEAT", "SURFACE", closing)
    assert heat / jump == pytest.approx(at(pressure, pressures, conductances), rel=1e-2)
    # Two blocks of 1 mm and the joint in series.
    assert heat == pytest.approx(100 / (2 / 50 + 1 / at(pressure, pressures, conductances)), rel=1e-2)


def test_a_table_of_another_curve_is_noticed(joint):
    folder, (pressures, _, conductances) = joint
    pressure, _, heat, jump = solved(folder, "JOINT-HEAT", "SURFACE", 2e-4)
    assert abs(heat / jump / at(0.9 * pressure, pressures, conductances) - 1) > 0.02
