# %% [markdown]
# # A hardness study with pandas and matplotlib
# How much of the load plastic contacts carry, as the hardness of the softer body changes.

# %%
import matplotlib.pyplot as plt
import numpy as np
import pandas as pd

import asperity

spectrum = {"self-affine": {"hurst": 0.8, "roll-off": 64e-6, "cut-off": 8e-6}}
surface = asperity.generate(1024, pixel=1e-6, sigma=0.3e-6, spectrum=spectrum, seed=5)
asperities = surface.find_summits()

# %%
frames = []
for hardness in np.array([1, 2, 4, 8]) * 1e9:
    steel = asperity.Material(210e9, 0.3, hardness=hardness)
    contact = asperity.Interface(steel, steel, "zmc")
    curve = asperity.deterministic(contact, asperities, pressures=np.geomspace(1e6, 1e8, 21))
    frames.append(curve.to_pandas().assign(hardness_gpa=hardness / 1e9))
study = pd.concat(frames)

# %%
table = study.pivot(index="target", columns="hardness_gpa", values="plastic_load_share")
print(table.iloc[::5].round(3))
axes = table.plot(logx=True)
axes.set_xlabel("nominal pressure [Pa]")
axes.set_ylabel("share of the load in plastic contacts")

# %%
# Softer bodies have more load in plastic contacts, at every pressure.
assert (table.diff(axis=1).iloc[:, 1:] <= 0).all().all()
