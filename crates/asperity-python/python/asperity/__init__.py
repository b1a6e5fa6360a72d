"""Contact of rough surfaces in two ways: the statistical integral and the sum over the real asperities.

Numbers are in SI units: m, Pa, N, 1/m^2; a text such as ``"1 um"`` or ``"210 GPa"`` has its own. Separations are d/sigma: the distance of the flat from the mean asperity
height over the standard deviation of the asperity heights.

>>> import asperity
>>> steel = asperity.Material(210e9, 0.3, hardness=7.6e9)
>>> contact = asperity.Interface(steel, steel, "zmc")
>>> population = asperity.Population(radius=20e-6, sigma=48e-9, density=6e10)
>>> curve = asperity.statistical(contact, population, separations=[2.0, 1.0])
>>> curve["pressure_pa"].round(-4)
array([ 2880000., 32700000.])
"""

from ._asperity import (
    Asperities,
    Interface,
    Law,
    Material,
    Population,
    Table,
    __version__,
    deterministic,
    statistical,
)
from . import copies, distributed
from .arguments import AsperityWarning
from .study import Results, compare, reference, run
from .surfaces import Pair, Topography, draw, generate

__all__ = [
    "Asperities",
    "AsperityWarning",
    "Interface",
    "Law",
    "Material",
    "Pair",
    "Population",
    "Results",
    "Table",
    "Topography",
    "__version__",
    "compare",
    "deterministic",
    "distributed",
    "draw",
    "generate",
    "reference",
    "run",
    "statistical",
]
