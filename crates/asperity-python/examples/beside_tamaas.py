# %% [markdown]
# # asperity beside tamaas on one surface
# The same elastic contact by the boundary elements of this package, by those of tamaas, and by the two asperity models.

# %%
import numpy as np
import tamaas

import asperity

points, pixel = 256, 1e-6
spectrum = {"self-affine": {"hurst": 0.8, "roll-off": 64e-6, "cut-off": 16e-6}}
surface = asperity.generate(points, pixel=pixel, sigma=50e-9, spectrum=spectrum, seed=2)
body = asperity.Material(210e9, 0.3)
contact = asperity.Interface(body, body, "hertz")
pressures = np.array([5e6, 1e7, 2e7])

# %%
ours = asperity.reference(surface, contact, pressures=pressures, error=1e-8)
sum_ = asperity.deterministic(contact, surface.find_summits(), pressures=pressures)
integral = asperity.statistical(contact, surface.find_summits().population(), pressures=pressures)

# %%
tamaas.set_log_level(tamaas.LogLevel.warning)
model = tamaas.ModelFactory.createModel(tamaas.model_type.basic_2d, [points * pixel] * 2, [points] * 2)
model.E, model.nu = contact.reduced_modulus, 0.0
theirs = []
for pressure in pressures:
    solver = tamaas.PolonskyKeerRey(model, np.ascontiguousarray(surface.heights), 1e-12)
    solver.solve(pressure)
    theirs.append((model.traction > 0).mean())

# %%
print("area ratio      tamaas   this    corrected   sum     integral")
for row in zip(pressures, theirs, ours["raw_area_ratio"], ours["area_ratio"], sum_["area_ratio"], integral["area_ratio"]):
    print("{:9.2g} Pa   {:.4f}   {:.4f}   {:.4f}   {:.4f}   {:.4f}".format(*row))
assert np.allclose(theirs, ours["raw_area_ratio"], rtol=0.01)
