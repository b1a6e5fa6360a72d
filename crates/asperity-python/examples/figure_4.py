# %% [markdown]
# # Fig. 4 of Pasaribu and Schipper (2005)
# Real contact area against load by both models on the two surfaces of Table 1, steel on steel.

# %%
import matplotlib.pyplot as plt
import numpy as np

import asperity

steel = asperity.Material(210e9, 0.3, hardness=7.6e9)
contact = asperity.Interface(steel, steel, "zmc")
pressures = np.geomspace(1e6, 1e8, 31)
for case, radius, sigma, density in (("case 1", 20e-6, 48e-9, 6e10), ("case 2", 1.6e-6, 260e-9, 9e10)):
    asperities = asperity.draw(1_000_000, radius=radius, sigma=sigma, density=density)
    integral = asperity.statistical(contact, asperity.Population(radius, sigma, density), pressures=pressures)
    sum_ = asperity.deterministic(contact, asperities, pressures=pressures)
    plt.loglog(integral["load_ratio"], integral["area_ratio"], label=f"{case}, statistical")
    plt.loglog(sum_["load_ratio"], sum_["area_ratio"], "--", label=f"{case}, deterministic")
    ratio = integral["area_ratio"] / sum_["area_ratio"]
    print(f"{case}: statistical over deterministic area {ratio.min():.4f} to {ratio.max():.4f}")

# %%
plt.xlabel("nominal pressure over E*")
plt.ylabel("real over nominal contact area")
plt.legend()
plt.show()
