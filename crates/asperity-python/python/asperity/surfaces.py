"""Surfaces: height maps with their preparation, random surfaces, and asperities drawn from a population."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from os import PathLike
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _asperity
from ._asperity import Asperities
from .arguments import check_file, named, quantity, si, warn
from .arguments import pixel as _pixel

# The name of a map in memory, which the spec has instead of a path.
_HELD_MAP = "map in memory"

# A number in m, or a text with a unit.
Length = float | str

# Names of units in SurfaceTopography that the program spells in another way.
_UNITS = {"A": 1e-10, "Å": 1e-10, "µm": 1e-6, "μm": 1e-6}


def _key(name: str) -> str:
    return name.replace("_", "-")


def _units(unit: str | dict[str, str]) -> tuple[float, float]:
    """The units of coordinates and heights in m."""
    if isinstance(unit, str):
        return (_asperity.length_unit(unit),) * 2
    if not isinstance(unit, dict) or set(unit) != {"xy", "z"}:
        raise ValueError(f'unit: found {unit!r}; allowed: a unit such as "um", or {{"xy": "um", "z": "nm"}}')
    return _asperity.length_unit(unit["xy"]), _asperity.length_unit(unit["z"])


def axes(ax: Any) -> Any:
    """The axes themselves, or those of a new figure."""
    if ax is not None:
        return ax
    try:
        from matplotlib import pyplot
    except ImportError as error:
        raise ImportError("plot() needs matplotlib, which is not installed: pip install matplotlib") from error
    return pyplot.subplots(layout="constrained")[1]


def _ends(crop: Mapping[str, tuple[Length, Length] | None] | None) -> list[tuple[float, float] | None]:
    """The ends of a part along x and y in m."""
    if crop is not None and (not isinstance(crop, Mapping) or not set(crop) <= {"x", "y"}):
        raise ValueError(f'crop: found {crop!r}; allowed: {{"x": ("10 um", "200 um"), "y": (0, "50 um")}}, or one of both')
    ends: list[tuple[float, float] | None] = []
    for name in "xy":
        given = crop.get(name) if crop else None
        if given is not None and (np.ndim(given) != 1 or len(given) != 2):
            raise ValueError(f'crop.{name}: found {given!r}; allowed: from and to, such as ("10 um", "200 um")')
        ends.append(None if given is None else tuple(si(f"crop.{name}", end, "distance") for end in given))
    return ends


def keys(given: dict[str, Any]) -> dict[str, Any]:
    """Keys of a spec from Python names, without those that are None."""
    return {_key(name): value for name, value in given.items() if value is not None}


class Topography:
    """A height map and how it is prepared before its summits are searched.

    The keywords are the keys of ``[surface.NAME.file]`` in a spec, with the same defaults. A contiguous float64 array is
    not copied, and must not be changed as long as the topography is used.

    Parameters
    ----------
    heights : array_like, shape (nx, ny)
        Heights in m, the first index along x. NaN, infinite and masked points are missing.
    pixel : float or str, or a pair of these
        Distance of neighbouring points along x and y in m, or with its unit: ``"0.8 um"``, as every length here.
    periodic : bool
        Whether the map continues periodically beyond its border, as simulated surfaces do.
    crop : mapping, optional
        The part of the map that is used, by ``"x"`` and ``"y"``, as :meth:`crop` takes them.
    fit : {"auto"}, optional
        Find the preparation that makes the map fit: remedies of the failed checks, one after the other. The keywords below that are
        given are kept; :attr:`fit_steps` says what was done.
    outliers : {"keep", "remove"}
        Whether spikes become missing points.
    align_lines : {"x", "y"}, optional
        The axis along which lines of the scan are set to the same mean height.
    tip : float or str, optional
        Radius of the stylus or tip that traced the map in m: what it added to the summits is eroded.
    level : {"none", "plane", "quadratic", "cubic"}, optional
        Form that is removed; by default a plane, and nothing of a periodic map.
    s, l : float or str, optional
        Nesting indices of Gaussian S and L filters (ISO 16610-61) in m; ``filter={"s": ..., "l": ...}`` is the same.
    neighbours : {"four", "eight"}
        Which neighbours a summit is higher than.

    Raises
    ------
    ValueError
        A map of fewer than 3 x 3 points or without a height, or a pixel that is not positive.

    Warns
    -----
    AsperityWarning
        A pixel or another length that is hardly meant in m; caveats of reading and preparing the map.

    Examples
    --------
    >>> import numpy as np, asperity
    >>> x = np.arange(64) * 1e-6
    >>> heights = 1e-7 * np.sin(6e5 * x)[:, None] * np.cos(7e5 * x) * (1 + 1e4 * x[:, None])
    >>> topography = asperity.Topography(heights, 1e-6)
    >>> len(topography.find_summits())
    78
    """

    def __init__(
        self,
        heights: ArrayLike,
        pixel: Length | tuple[Length, Length],
        *,
        periodic: bool = False,
        crop: Mapping[str, tuple[Length, Length]] | None = None,
        **preparation: Any,
    ) -> None:
        if isinstance(heights, np.ma.MaskedArray):
            heights = heights.astype(np.float64).filled(np.nan)
        raw, ends = _asperity.Map(heights, _pixel(pixel)), _ends(crop)
        part = raw if ends == [None, None] else raw.part(*ends)
        self._begin(part, periodic and part.points == raw.points, preparation)

    def _begin(self, raw: _asperity.Map, periodic: bool, preparation: dict[str, Any]) -> None:
        if isinstance(indices := preparation.get("filter"), Mapping) and set(indices) <= {"s", "l"}:
            preparation = {**{name: value for name, value in preparation.items() if name != "filter"}, **indices}
        allowed = {"fit", "outliers", "align_lines", "tip", "level", "s", "l", "neighbours"}
        if unknown := set(preparation) - allowed:
            raise ValueError(f"found {', '.join(sorted(unknown))}; allowed: {', '.join(sorted(allowed))}")
        self._raw = raw
        self.periodic = bool(periodic)
        doubts: list[str] = []
        lengths = {name: quantity(name, preparation.get(name), "pixel", doubts) for name in ("tip", "s", "l")}
        self._preparation = {name: value for name, value in {**preparation, **lengths}.items() if value is not None}
        warn(doubts)

    def __getstate__(self) -> dict[str, Any]:
        return {name: value for name, value in vars(self).items() if name in ("_raw", "periodic", "_preparation")}

    @classmethod
    def read(
        cls,
        path: str | PathLike[str],
        *,
        pixel: Length | tuple[Length, Length] | None = None,
        unit: str | dict[str, str] | None = None,
        missing: float | str | Sequence[float | str] | None = None,
        channel: str | None = None,
        transpose: bool = False,
        crop: Mapping[str, tuple[Length, Length]] | None = None,
        periodic: bool = False,
        **preparation: Any,
    ) -> Topography:
        """Read a measured map: a file of an instrument, ``.npy``, X3P, SDF, a text matrix or columns x y z.

        Parameters
        ----------
        path : path_like
            The file.
        pixel : float or str, or a pair of these, optional
            Distance of neighbouring points along x and y in m or with its unit, in place of that of the file if it states one. The first
            index of a ``.npy`` is x; in a text x runs along a line.
        unit : str or {"xy": str, "z": str}, optional
            Unit of the lengths in the file such as ``"um"``, or one of coordinates and one of heights, in place of those that
            the file states, which is a warning.
        missing : float, str or sequence of them, optional
            Heights that mark missing points, in the unit of the file, and words of a text that do. An empty sequence: every
            number is a height, although one is far from all others.
        channel : str, optional
            The channel of a file that holds several, by its name there; by default that of the heights.
        transpose : bool
            Whether x and y of the file are exchanged; ``pixel`` is then that of the exchanged map.
        crop : mapping, optional
            The part of the map that is read, by ``"x"`` and ``"y"``, as :meth:`crop` takes them.
        periodic, **preparation
            As of :class:`Topography`.

        Raises
        ------
        FileNotFoundError
            A file that is not there.
        ValueError
            A file that is no height map, or keywords that do not fit it.
        """
        check_file(path)
        if pixel is not None:
            pixel = _pixel(pixel)
        if unit is not None:
            unit = _units(unit)
        if missing is not None:
            marks = [missing] if isinstance(missing, str) else np.atleast_1d(np.asarray(missing, dtype=object)).tolist()
            words = [mark for mark in marks if isinstance(mark, str)]
            missing = ([float(mark) for mark in marks if not isinstance(mark, str)], words)
        ends = _ends(crop)
        raw = _asperity.Map.read(
            path, pixel=pixel, unit=unit, missing=missing, channel=channel, transpose=transpose, crop=ends
        )
        made = cls.__new__(cls)
        made._begin(raw, periodic and ends == [None, None], preparation)
        warn(raw.caveats)
        return made

    @classmethod
    def from_surface_topography(cls, topography: Any, **preparation: Any) -> Topography:
        """Take over a uniform two-dimensional map of SurfaceTopography, or of anything with the same attributes.

        Parameters
        ----------
        topography : object
            With ``heights()``, ``physical_sizes``, ``unit`` (None: m) and ``is_periodic``.
        **preparation
            As of :class:`Topography`.

        Raises
        ------
        TypeError
            An array, or another object without these attributes.
        """
        if not callable(getattr(topography, "heights", None)) or not hasattr(topography, "physical_sizes"):
            raise TypeError(
                f"found {type(topography).__name__}; allowed: a topography of SurfaceTopography, with heights() and "
                "physical_sizes. An array of heights in m is taken by Topography(heights, pixel)"
            )
        unit = getattr(topography, "unit", None) or "m"
        factor = _UNITS[unit] if unit in _UNITS else _asperity.length_unit(unit)
        heights = topography.heights()
        if np.ndim(heights) != 2:
            raise ValueError(f"found {np.ndim(heights)} dimensions; allowed: a uniform two-dimensional map")
        sizes = np.asarray(topography.physical_sizes, dtype=np.float64)
        pixel = tuple((sizes / np.shape(heights) * factor).tolist())
        heights = heights if factor == 1 else heights * factor
        return cls(heights, pixel, periodic=bool(getattr(topography, "is_periodic", False)), **preparation)

    def prepared_with(self, **preparation: Any) -> Topography:
        """The same map with other keywords of the preparation; those not named stay."""
        made = Topography.__new__(Topography)
        made._begin(self._raw, self.periodic, {**self._preparation, **preparation})
        return made

    def crop(
        self, x: tuple[Length, Length] | None = None, y: tuple[Length, Length] | None = None
    ) -> Topography:
        """A part of the map as read, with the same preparation, which then sees this part only; it is not periodic.

        Parameters
        ----------
        x, y : pair of float or str, optional
            From where to before where along each axis, as distances from the first point of the map in m or with their units; all of
            an axis that is left out.

        Examples
        --------
        >>> import asperity
        >>> spectrum = {"self-affine": {"hurst": 0.8, "roll-off": 32e-6, "cut-off": 8e-6}}
        >>> surface = asperity.generate(128, pixel=1e-6, sigma=50e-9, spectrum=spectrum)
        >>> surface.crop(x=(0, "50 um"))
        <Topography: 50 x 128 points of 1e-06 x 1e-06 m>
        """
        made = Topography.__new__(Topography)
        part = self._raw.part(*_ends({"x": x, "y": y}))
        made._begin(part, self.periodic and part.points == self._raw.points, self._preparation)
        return made

    def pair(self, other: Topography, *, shifts: int = 16, rotations: bool = False) -> Pair:
        """This body against another rough one: the sum of both prepared maps at random relative positions.

        Parameters
        ----------
        other : Topography
            The other body, seen from outside; it is turned over, its x axis mirrored. Its material is that of the flat.
        shifts : int
            Number of relative positions, over which results are means.
        rotations : bool
            Whether the other body is also turned at random by 0, 90, 180 or 270 degrees.

        Examples
        --------
        >>> import asperity
        >>> spectrum = {"self-affine": {"hurst": 0.8, "roll-off": 32e-6, "cut-off": 8e-6}}
        >>> ring, liner = (asperity.generate(256, pixel=1e-6, sigma=50e-9, spectrum=spectrum, seed=k) for k in (1, 2))
        >>> steel = asperity.Material(210e9, 0.3, hardness=7.6e9)
        >>> pair = ring.pair(liner, shifts=2)
        >>> results = asperity.compare(pair, asperity.Interface(steel, steel), pressures=[1e7])
        >>> len(results.at_load)
        2
        """
        return Pair((self, other), shifts, rotations)

    def _spec(self) -> tuple[dict[str, Any], dict[str, Any]]:
        """``[surface.NAME]`` and what it names in memory."""
        given = dict(self._preparation)
        indices = {name: given.pop(name) for name in ("s", "l") if name in given}
        table = keys({"path": _HELD_MAP, "periodic": self.periodic, **given})
        if indices:
            table["filter"] = indices
        return {"file": table}, {_HELD_MAP: self._raw}

    @cached_property
    def _surface(self) -> _asperity.Surface:
        table, in_memory = self._spec()
        made = _make(table, in_memory)
        warn(caveat for caveat in made.warnings if caveat not in self._raw.caveats)
        return made

    @property
    def points(self) -> tuple[int, int]:
        """Points along x and y."""
        return tuple(self._raw.points)

    @property
    def pixel(self) -> tuple[float, float]:
        """Distance of neighbouring points along x and y in m."""
        return tuple(self._raw.pixel)

    @property
    def raw_heights(self) -> NDArray[np.float64]:
        """A copy of the heights as read in m, shape (nx, ny); NaN where they are missing."""
        return self._raw.heights()

    @cached_property
    def heights(self) -> NDArray[np.float64]:
        """The prepared heights in m, shape (nx, ny): aligned, levelled and filtered, NaN where they are missing."""
        return self._surface.map.heights()

    def write(self, path: str | PathLike[str], *, prepared: bool = False) -> None:
        """Write the map for other programs; read back it has the same heights, missing points and pixel, to the bit.

        Parameters
        ----------
        path : path_like
            The file; its ending says the format: ``.gwy`` (Gwyddion), ``.x3p`` (ISO 25178-72), ``.xyz`` (text) or ``.npy``, which holds no
            pixel. It is written whole or not at all.
        prepared : bool
            Whether the prepared map is written, instead of the map as read. Read it back with ``level="none"``.

        Examples
        --------
        >>> import asperity, pathlib, tempfile
        >>> spectrum = {"self-affine": {"hurst": 0.8, "roll-off": 32e-6, "cut-off": 8e-6}}
        >>> topography = asperity.generate(64, pixel=1e-6, sigma=50e-9, spectrum=spectrum)
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     path = pathlib.Path(folder) / "surface.gwy"
        ...     topography.write(path)
        ...     again = asperity.Topography.read(path, periodic=True)
        >>> bool((again.heights == topography.heights).all())
        True
        """
        (self._surface.map if prepared else self._raw).write(path)

    def plot(self, ax: Any = None, *, prepared: bool = False) -> Any:
        """Draw the map by matplotlib.

        Parameters
        ----------
        ax : matplotlib Axes, optional
            What it is drawn on; by default a new figure.
        prepared : bool
            Whether the prepared map is drawn, instead of the map as read.

        Returns
        -------
        matplotlib Axes

        Raises
        ------
        ImportError
            Where matplotlib is not installed.
        """
        ax = axes(ax)
        heights = self.heights if prepared else self.raw_heights
        sides = [1e6 * points * pixel for points, pixel in zip(self.points, self.pixel)]
        image = ax.imshow(1e6 * heights.T, origin="lower", extent=(0, sides[0], 0, sides[1]), interpolation="nearest")
        ax.set(xlabel="x (µm)", ylabel="y (µm)")
        ax.figure.colorbar(image, ax=ax, label="height (µm)")
        return ax

    def find_summits(self) -> Asperities:
        """The summits of the prepared map: heights, radii and places in m, with their principal curvatures in 1/m."""
        return self._surface.asperities

    @property
    def summit_positions(self) -> NDArray[np.int64]:
        """Index pairs (ix, iy) of the summits, shape (n, 2), in the order of :meth:`find_summits`."""
        return np.stack(np.unravel_index(self._surface.positions, self.points), axis=-1)

    @cached_property
    def roughness(self) -> dict[str, Any]:
        """Parameters of the prepared map, with the names and units of ``height_map`` in ``summary.json``."""
        return json.loads(self._surface.roughness)

    @cached_property
    def fitness(self) -> list[dict[str, Any]]:
        """The checks whether the map may carry a verdict: spikes, form, lines, steps, resolution."""
        checks = json.loads(self._surface.fitness)
        return [{**check, "remedy": _asperity.in_arguments(check["remedy"] or "")} for check in checks]

    @property
    def fit_steps(self) -> list[dict[str, Any]]:
        """With ``fit="auto"`` the remedies of failed checks in the order in which they were tried, as in ``fit_steps.csv``."""
        return json.loads(self._surface.fit_steps)

    @property
    def warnings(self) -> list[str]:
        """Caveats of the preparation, the search, and how the file was read."""
        return self._surface.warnings

    def __repr__(self) -> str:
        nx, ny = self.points
        dx, dy = self.pixel
        periodic = ", periodic" if self.periodic else ""
        return f"<Topography: {nx} x {ny} points of {dx:.3g} x {dy:.3g} m{periodic}>"


@dataclass(frozen=True)
class Pair:
    """Two rough bodies, as :meth:`Topography.pair` makes them.

    Attributes
    ----------
    bodies : (Topography, Topography)
        Both, each seen from outside.
    shifts : int
        Number of random relative positions.
    rotations : bool
        Whether the second body is turned at random, too.
    """

    bodies: tuple[Topography, Topography]
    shifts: int
    rotations: bool


def _make(table: dict[str, Any], in_memory: dict[str, Any], seed: int = 0, realisation: int = 1) -> _asperity.Surface:
    spec = {"title": "surface", "seed": seed, "surface": {"surface": table}}
    with named():
        return _asperity.make_surface(spec, in_memory, realisation=realisation)


def generate(
    points: int | tuple[int, int],
    *,
    seed: int = 0,
    realisation: int = 1,
    **generation: Any,
) -> Topography:
    """Generate a periodic random rough surface.

    The keywords are the keys of ``[surface.NAME.generate]`` in a spec, with ``_`` for ``-``; a number is in SI units, a
    text such as ``"48 nm"`` has its own. Realisation k of a seed is that of a spec whose surface is called ``surface``.

    Parameters
    ----------
    points : int or (int, int)
        Points along x and y.
    seed : int
        Every random number is drawn from it.
    realisation : int
        Number of the realisation, from 1.
    **generation
        ``pixel`` (m), ``sigma`` (m), ``spectrum``, ``heights``, ``spectrum_of``, ``plateau``, ``summits``,
        ``neighbours``.

    Raises
    ------
    ValueError
        Keys or values that make no surface, or a target that is not reached.

    Examples
    --------
    >>> import asperity
    >>> spectrum = {"self-affine": {"hurst": 0.8, "roll-off": 16e-6, "cut-off": 4e-6}}
    >>> surface = asperity.generate(128, pixel=1e-6, sigma=50e-9, spectrum=spectrum, seed=1)
    >>> surface
    <Topography: 128 x 128 points of 1e-06 x 1e-06 m, periodic>
    """
    points = [points, points] if np.ndim(points) == 0 else list(points)
    doubts: list[str] = []
    generation.update({key: quantity(key, generation[key], key, doubts) for key in ("pixel", "sigma") if key in generation})
    warn(doubts)
    made = _make({"generate": keys({"points": points, **generation})}, {}, seed, realisation)
    topography = Topography.__new__(Topography)
    neighbours = generation.get("neighbours", "four")
    topography._begin(made.map, True, {"level": "none", "neighbours": neighbours})
    return topography


def draw(
    count: int,
    *,
    radius: float | str,
    sigma: float | str,
    density: float | str,
    seed: int = 0,
    realisation: int = 1,
    **population: Any,
) -> Asperities:
    """Draw asperities of one radius from a population.

    The keywords are the keys of ``[surface.NAME.population]`` in a spec, with ``_`` for ``-``.

    Parameters
    ----------
    count : int
        How many asperities are drawn.
    radius, sigma, density : float or str
        Radius and standard deviation of the heights in m, asperities per nominal area in 1/m^2, or with their units.
    seed, realisation : int
        Every random number is drawn from them.
    **population
        ``heights``: a distribution, by default ``"gaussian"``; ``draw``: ``"random"`` or ``"quantiles"``.

    Examples
    --------
    >>> import asperity
    >>> asperity.draw(1000, radius=20e-6, sigma=48e-9, density=6e10)
    <Asperities: 1000 on 1.6666666666666667e-8 m^2>
    """
    doubts: list[str] = []
    kinds = {"radius": (radius, "length"), "sigma": (sigma, "sigma"), "density": (density, "density")}
    table = {name: quantity(name, value, kind, doubts) for name, (value, kind) in kinds.items()}
    warn(doubts)
    table.update(count=count, **population)
    return _make({"population": keys(table)}, {}, seed, realisation).asperities
