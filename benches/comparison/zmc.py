"""Table 1 of Pasaribu and Schipper (2005), steel on steel under the law of Zhao, Maietta and Chang: shared by the comparison
programs of `sums.py` and `integral.py`. The numbers are those of benches/cases.rs."""

import math
from typing import NamedTuple


class Population(NamedTuple):
    name: str
    radius: float  # m
    sigma: float  # m
    density: float  # 1/m^2


CASES = (Population("case 1", 2e-5, 4.8e-8, 6e10), Population("case 2", 1.6e-6, 2.6e-7, 9e10))
SEPARATIONS = [4.0 - 4.0 * k / 49.0 for k in range(50)]  # in sigma

HARDNESS = 7.6e9  # Pa
MODULUS = 1 / ((1 - 0.3**2) / 210e9 + (1 - 0.3**2) / 210e9)  # reduced, Pa
STRAIN = HARDNESS / MODULUS
ONSET = 0.09 * math.pi * math.pi * STRAIN * STRAIN  # w1/b
TRANSITION = 54.0  # w2/w1
SLOPE = 0.6 / math.log(TRANSITION)  # of the mean pressure over H, in ln(w/w1)
