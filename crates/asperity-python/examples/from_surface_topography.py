# %% [markdown]
# # From a SurfaceTopography file to a verdict
# A map that SurfaceTopography reads, levelled and filtered by the program, and the question whether the statistical
# model may replace the sum on it.

# %%
import sys
import tempfile
from pathlib import Path

import numpy as np
import SurfaceTopography

import asperity

# %%
# Any file that SurfaceTopography reads: here one that it writes itself.
if len(sys.argv) > 1:
    path = Path(sys.argv[1])
else:
    spectrum = {"self-affine": {"hurst": 0.8, "roll-off": 40e-6, "cut-off": 8e-6}}
    made = asperity.generate(512, pixel=1e-6, sigma=0.2e-6, spectrum=spectrum, seed=3)
    path = Path(tempfile.mkdtemp()) / "surface.nc"
    SurfaceTopography.Topography(made.heights, (512e-6, 512e-6), unit="m", periodic=True).to_netcdf(path)
theirs = SurfaceTopography.read_topography(path)

# %%
surface = asperity.Topography.from_surface_topography(theirs)
print(surface)
print(f"Sq = {surface.roughness['sq_m']:.3g} m, {len(surface.find_summits())} summits")
for check in surface.fitness:
    if not check["passed"]:
        print(f"{check['check']} failed: {check['measure']} = {check['value']:.3g}, threshold {check['threshold']:g}")

# %%
steel = asperity.Material.named("steel-100Cr6")
contact = asperity.Interface(steel, steel, "zmc")
results = asperity.compare(surface, contact, pressures=np.geomspace(1e6, 1e8, 9))
print(results.answer)
for verdict in results.verdicts:
    if verdict["against"] == "deterministic":
        print(f"{verdict['quantity']}, {verdict['from_pa']:.2g} to {verdict['to_pa']:.2g} Pa: {verdict['verdict']}")
