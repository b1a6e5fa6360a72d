"""Arguments: quantities with units, warnings of what is hardly meant, and errors that name them."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from os import PathLike
from typing import Any

import numpy as np

from . import _asperity

# The unit of a number, by the kind of quantity.
_UNITS = {"area": "m^2", "density": "1/m^2", "pressure": "Pa", "stress": "Pa", "force": "N"}

_OF_COMPARE = {"separation": "separations", "pressure": "pressures", "force": "forces"}


class AsperityWarning(UserWarning):
    """Input that is allowed but hardly meant, such as a number that lacks its unit, and caveats of results."""


def warn(messages: Iterable[str]) -> None:
    """Shows warnings, each once, at the line outside this package that has called it."""
    level, frame = 1, sys._getframe(0)
    # Cached properties of this package are called by functools.
    while frame.f_back and frame.f_globals.get("__name__", "").partition(".")[0] in ("asperity", "functools"):
        level, frame = level + 1, frame.f_back
    for message in dict.fromkeys(messages):
        warnings.warn(message, AsperityWarning, stacklevel=level)


def si(name: str, value: Any, kind: str, doubts: list[str] | None = None) -> float:
    """A number or a text with a unit in SI. What makes it hardly meant is added to the doubts, or warned of."""
    number, doubt = _asperity.si(value, name, kind)
    if doubt and doubts is None:
        warn([doubt])
    elif doubt:
        doubts.append(doubt)
    return number


def quantity(name: str, value: Any, kind: str, doubts: list[str] | None = None) -> Any:
    """A quantity, or a list or a sweep of them, as a spec writes them. A spec refuses bare numbers that are hardly meant."""
    if value is None:
        return None
    if isinstance(value, Mapping):
        parts = ("from", "to", "values")
        return {key: quantity(f"{name}.{key}", part, kind, doubts) if key in parts else part for key, part in value.items()}
    if np.ndim(value) > 0:
        return [quantity(name, item, kind, doubts) for item in value]
    return f"{si(name, value, kind, doubts)!r} {_UNITS.get(kind, 'm')}"


def pixel(value: Any) -> tuple[float, float]:
    """The distance of neighbouring points along x and y in m."""
    sides = [value] if np.ndim(value) == 0 else list(value)
    if len(sides) not in (1, 2):
        raise ValueError(f"pixel: found {len(sides)} lengths; allowed: one, or one along x and one along y")
    doubts: list[str] = []
    sides = [si("pixel", side, "pixel", doubts) for side in sides]
    warn(doubts)
    return sides[0], sides[-1]


def check_file(path: str | PathLike[str]) -> None:
    """Raises what Python raises of a file that is missing or cannot be read."""
    with open(path, "rb"):
        pass


@contextmanager
def named() -> Iterator[None]:
    """Names the argument in an error of a spec that was made from arguments."""
    try:
        yield
    except ValueError as error:
        key = getattr(error, "key", None)
        if key is None:
            raise
        name = _argument(key)
        message = str(error).removeprefix(f"{key}: ")
        raise ValueError(f"{name}: {message}" if name else message) from None


def _argument(key: str) -> str:
    table, *rest = key.replace("-", "_").split(".")
    if table == "surface":
        name, _kind, *rest = [*rest, "", ""][: max(len(rest), 2)]
        rest = [part for part in rest if part != "filter"]
        return ".".join([part for part in [*([] if name == "surface" else [f"surface {name}"]), *rest] if part])
    if table == "material":
        return ".".join(["interface", *rest])
    if table != "compare":
        return ".".join([table, *rest])
    if rest and rest[0] in ("rough", "flat", "law", "layer"):
        return ".".join(["interface", *rest]).replace("interface.layer.", "interface.")
    return ".".join([_OF_COMPARE.get(part, part) for part in rest])
