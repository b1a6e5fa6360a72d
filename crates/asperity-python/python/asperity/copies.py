"""How objects are copied and sent to other processes, as joblib and Dask do."""

from __future__ import annotations

import copyreg
import functools
import math
from typing import Any

from ._asperity import Asperities, Interface, Law, Material, Population


def _text(value: float | None, unit: str) -> Any:
    # A number without a unit may be warned of; the text of a number has all its digits.
    return f"{value!r} {unit}" if value is not None and math.isfinite(value) and abs(value) >= 1e-30 else value


def _made(made: type, arguments: tuple, **keywords: Any) -> tuple:
    return functools.partial(made, **keywords), arguments


def _material(one: Material) -> tuple:
    others = {"hardness": "Pa", "yield_strength": "Pa", "resistivity": "ohm m", "thermal_conductivity": "W/(m K)"}
    values = {name: _text(getattr(one, name), unit) for name, unit in others.items()}
    return _made(Material, (_text(one.young, "Pa"), one.poisson), **values)


def _interface(one: Interface) -> tuple:
    layer = {"layer": one.layer, "thickness": _text(one.thickness, "m"), "rule": one.rule, "on": one.on}
    return _made(Interface, (one.rough, one.flat, one.law), **layer)


def _asperities(one: Asperities) -> tuple:
    others = {"curvatures": one.curvatures, "places": one.places, "independent": one.independent}
    return _made(Asperities, (one.heights, one.radii, _text(one.nominal_area, "m^2")), **others)


def _population(one: Population) -> tuple:
    return Population, (_text(one.radius, "m"), _text(one.sigma, "m"), _text(one.density, "1/m^2"), one.heights)


copyreg.pickle(Material, _material)
copyreg.pickle(Law, lambda one: _made(Law, (one.name,), **one.given))
copyreg.pickle(Interface, _interface)
copyreg.pickle(Asperities, _asperities)
copyreg.pickle(Population, _population)
