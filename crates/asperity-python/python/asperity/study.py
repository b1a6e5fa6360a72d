"""Specs from Python: comparisons, the boundary element reference, and any experiment of the program."""

from __future__ import annotations

import html
import json
import re
import textwrap
from collections.abc import Mapping, Sequence
from functools import cached_property
from os import PathLike
from typing import Any

import numpy as np

from . import _asperity
from ._asperity import Asperities, Interface, Material, Table
from .arguments import check_file, named, quantity, warn
from .surfaces import Pair, Topography, axes, keys

Surface = Topography | Pair | Asperities | Mapping[str, Any]


class Answer:
    """What a report says first.

    Attributes
    ----------
    sentence : str
        The answer in one or two sentences.
    lines : dict of str to str
        The card of one case by ``result``, ``conductance``, ``friction``, ``answer``, ``difference``, ``why``, ``instead``,
        ``nearer`` and ``certainty``, as far as each has something to say; empty of several cases.
    labels : dict of str to str
        The labels of these lines.
    """

    def __init__(self, answer: Mapping[str, Any]) -> None:
        lines = answer.get("lines", [])
        self.sentence: str = answer["sentence"]
        self.lines = {line["key"]: " ".join(line["texts"]) for line in lines}
        self.labels = {line["key"]: line["label"] for line in lines}

    def __str__(self) -> str:
        return "\n".join(f"{self.labels[key]}: {text}" for key, text in self.lines.items()) or self.sentence

    def __repr__(self) -> str:
        return f"<Answer: {self.sentence}>"

    def _repr_html_(self) -> str:
        words = lambda text: re.sub("`([^`]*)`", r"<code>\1</code>", html.escape(text, quote=False))
        rows = "".join(f"<dt><b>{words(self.labels[key])}</b></dt><dd>{words(text)}</dd>" for key, text in self.lines.items())
        return f"<dl>{rows}</dl>" if rows else f"<p>{words(self.sentence)}</p>"


class Results:
    """What an experiment gives.

    Attributes
    ----------
    kind : str
        The kind of the experiment, such as ``"compare"``.
    tables : dict of str to Table
        The tables of the report by name: ``tables["curves"]`` is ``curves.csv``.
    summary : dict
        The content of ``summary.json``.
    warnings : list of str
        Caveats, which are warned of, too.
    report : Path or None
        The folder of the report, where one was written.
    """

    def __init__(self, run: _asperity.Run, doubts: Sequence[str] | None = None) -> None:
        # With doubts, which may be none, it was asked for by arguments, and speaks of them instead of keys.
        self._run = run
        self._doubts = doubts
        self.kind = run.kind
        self.warnings = list(dict.fromkeys([*(doubts or ()), *map(self._told, run.warnings)]))
        self.report = run.report

    def __reduce__(self) -> tuple:
        return Results, (self._run, self._doubts)

    def __deepcopy__(self, memo: Any) -> Results:
        # Its tables of joints do not go elsewhere, and nothing of a run changes.
        return Results(self._run, self._doubts)

    def _told(self, message: str) -> str:
        return message if self._doubts is None else _asperity.in_arguments(message)

    @cached_property
    def tables(self) -> dict[str, Table]:
        return self._run.tables()

    @cached_property
    def summary(self) -> dict[str, Any]:
        return json.loads(self._run.summary)

    @property
    def csv(self) -> dict[str, bytes]:
        """The files of the tables, as the program writes them."""
        return self._run.csv()

    @property
    def curves(self) -> Table:
        """The curves of all models: ``curves.csv``."""
        return self.tables["curves"]

    @cached_property
    def answer(self) -> Answer:
        """The answer as the report gives it: the card of one case, or a sentence; ``print`` shows it."""
        answer = self.summary["answer"]
        lines = [{**line, "texts": [self._told(text) for text in line["texts"]]} for line in answer.get("lines", [])]
        return Answer({"sentence": self._told(answer["sentence"]), "lines": lines})

    @property
    def answers(self) -> list[dict[str, Any]]:
        """May the integral replace the sum: one entry for each surface, law and layer thickness."""
        return self.summary.get("answers", [])

    @property
    def at_load(self) -> list[dict[str, Any]]:
        """What each model says at the load, or at the middle one of several: contact area, contacts, pressure, shares of the load."""
        return self.summary.get("results", [])

    @property
    def on_map(self) -> Table | None:
        """What holds on the surface itself, without an interval, by quantity and range of loads: ``on_map.csv``."""
        return self.tables.get("on_map")

    @property
    def verdicts(self) -> list[dict[str, Any]]:
        """What holds of such surfaces: one entry for each quantity and range of loads with one verdict."""
        return self.summary.get("verdicts", [])

    @property
    def attribution(self) -> Table | None:
        """The difference between the models divided among its causes: ``attribution.csv``."""
        return self.tables.get("attribution")

    def to_interface_table(
        self,
        format: str = "csv",
        *,
        model: str = "deterministic",
        units: str = "si",
        beyond: bool = False,
    ) -> dict[str, str]:
        """The joint for other programs: pressure over closure, conductance and friction over pressure, as far as they were asked for.

        Parameters
        ----------
        format : {"csv", "calculix"}
            A table that every program takes, or keywords of CalculiX.
        model : {"statistical", "deterministic", "reference"}
            The model of the table.
        units : {"si", "mm"}
            m, Pa and W, or mm, MPa and mW.
        beyond : bool
            Whether loads that are not admissible are in it, marked.

        Returns
        -------
        dict of str to str
            Files by name: of the values and of the ends of their 95 % intervals, as ``experiment export interface`` writes them.

        Raises
        ------
        ValueError
            Results without loads or of fewer than two admissible ones, or results that come from another process.
        """
        return self._run.interface_files(format, model, units, beyond)

    def plot(self, quantity: str = "area_ratio", *, over: str = "pressure_pa", ax: Any = None) -> Any:
        """Draw the curves by matplotlib: a line for each model, surface and case.

        Parameters
        ----------
        quantity, over : str
            Columns of ``curves`` along y and x.
        ax : matplotlib Axes, optional
            What they are drawn on; by default a new figure.

        Returns
        -------
        matplotlib Axes

        Raises
        ------
        ImportError
            Where matplotlib is not installed.
        ValueError
            Results without curves, or a column that they do not have.
        """
        if (curves := self.tables.get("curves")) is None:
            raise ValueError(f"found results of {self.kind}, which have no curves; allowed: results of asperity.compare")
        numbers = [name for name, unit in curves.units.items() if unit not in ("text", "true/false")]
        for name in (quantity, over):
            if name not in numbers:
                raise ValueError(f"found the column {name!r}; allowed: {', '.join(numbers)}")
        ax = axes(ax)
        names = curves.keys()
        # What tells the curves apart, as texts: a case without a layer has NaN for its thickness.
        texts = [[f"{value:g}" if isinstance(value, float) else str(value) for value in curves[name].tolist()] for name in names]
        parts = [text for text in texts[: names.index("model")] if len(set(text)) > 1]
        labels = np.array([", ".join(label) for label in zip(*parts, texts[names.index("model")])])
        for label in dict.fromkeys(labels.tolist()):
            x, y = (curves[name][labels == label].astype(float) for name in (over, quantity))
            order = np.argsort(x)
            ax.plot(x[order], y[order], marker=".", label=label)
        for name, scale in ((over, ax.set_xscale), (quantity, ax.set_yscale)):
            scale("log" if (curves[name] > 0).all() else "linear")
        ax.set(xlabel=over, ylabel=quantity)
        ax.legend()
        return ax

    def __repr__(self) -> str:
        return f"<Results of {self.kind}: {textwrap.shorten(self.answer.sentence, 160, placeholder=' …')}>"

    def _repr_html_(self) -> str:
        return self.answer._repr_html_()


def run(
    spec: str | PathLike[str] | Mapping[str, Any],
    *,
    surfaces: Mapping[str, Surface] | None = None,
    name: str = "asperity",
    report: str | PathLike[str] | None = None,
) -> Results:
    """Run a spec: a file, or a dictionary with the same keys.

    Numbers are in SI units, texts such as ``"48 nm"`` have their own. All kinds run except ``evidence``, which the program
    ``experiment`` runs.

    Parameters
    ----------
    spec : path_like or mapping
        The spec. Paths in a dictionary are relative to the working directory.
    surfaces : mapping, optional
        Surfaces in memory that are added to a dictionary as ``[surface.NAME]``.
    name : str
        Name of the report of a dictionary; that of a file is called after the file.
    report : path_like, optional
        A folder in which the report (page, figures, tables) is written, in a folder of its own.

    Raises
    ------
    ValueError
        A spec that cannot run, with its key, and with the line of a file.
    FileNotFoundError
        A spec, or a file that a dictionary names, that is not there.
    OSError
        A report that cannot be written.
    """
    return _run(spec, surfaces or {}, name, report, None)


def _run(
    spec: str | PathLike[str] | Mapping[str, Any],
    surfaces: Mapping[str, Surface],
    name: str,
    report: str | PathLike[str] | None,
    doubts: Sequence[str] | None,
) -> Results:
    warn(doubts or ())
    in_memory: dict[str, Any] = {}
    if isinstance(spec, Mapping):
        spec = {**spec}
        if surfaces:
            tables = dict(spec.get("surface", {}))
            for key, surface in _with_bodies(surfaces).items():
                tables[key], own = _table(key, surface)
                in_memory.update(own)
            spec["surface"] = tables
        _check_files(spec, in_memory)
    elif surfaces:
        raise ValueError("surfaces: allowed only with a spec that is a dictionary")
    elif isinstance(spec, (str, PathLike)):
        check_file(spec)
    results = Results(_asperity.run(spec, in_memory, name=name, report=report, of_arguments=doubts is not None), doubts)
    warn(warning for warning in results.warnings if warning not in (doubts or ()))
    return results


def _check_files(spec: Mapping[str, Any], in_memory: Mapping[str, Any]) -> None:
    for kind, key in (("file", "path"), ("asperities", "file")):
        for surface in dict(spec.get("surface", {})).values():
            table = surface.get(kind) if isinstance(surface, Mapping) else None
            path = table.get(key) if isinstance(table, Mapping) else None
            if isinstance(path, (str, PathLike)) and path not in in_memory:
                check_file(path)


def _table(name: str, surface: Surface) -> tuple[dict[str, Any], dict[str, Any]]:
    """A surface as ``[surface.NAME]``, and what it names in memory."""
    if isinstance(surface, Topography):
        table, in_memory = surface._spec()
        (raw,) = in_memory.values()
        path = f"map {name}"
        return {"file": {**table["file"], "path": path}}, {path: raw}
    if isinstance(surface, Asperities):
        path = f"list {name}"
        table = {"file": path, "nominal-area": f"{surface.nominal_area!r} m^2", "independent": surface.independent}
        return {"asperities": table}, {path: surface}
    if isinstance(surface, Mapping):
        return {_hyphens(key): value for key, value in surface.items()}, {}
    raise ValueError(
        f"surface {name}: found a {type(surface).__name__}; allowed: a Topography, Asperities, or a dictionary such as "
        "{'population': {...}}"
    )


def _with_bodies(surfaces: Mapping[str, Surface]) -> dict[str, Surface]:
    """The surfaces, with both bodies of each pair before it."""
    made: dict[str, Surface] = {}
    for key, surface in surfaces.items():
        if isinstance(surface, Pair):
            names = [f"{key}-a", f"{key}-b"]
            made.update(zip(names, surface.bodies))
            surface = {"pair": dict(zip("ab", names), shifts=surface.shifts, rotations=surface.rotations)}
        made[key] = surface
    return made


def _hyphens(name: str) -> str:
    return name.replace("_", "-")


def _in(unit: str, value: float | None) -> str | None:
    # A spec refuses bare numbers that are hardly meant; here they have been warned of.
    return None if value is None else f"{value!r} {unit}"


def _material(material: Material) -> dict[str, Any]:
    return keys(
        {
            "young": _in("Pa", material.young),
            "poisson": material.poisson,
            "hardness": _in("Pa", material.hardness),
            "yield_strength": _in("Pa", material.yield_strength),
            "resistivity": _in("ohm m", material.resistivity),
            "thermal_conductivity": _in("W/(m K)", material.thermal_conductivity),
        }
    )


def _spec(interface: Interface, surface: Surface | Mapping[str, Surface]) -> tuple[dict, dict]:
    law = {_hyphens(name): value for name, value in interface.law.given.items()}
    compare: dict[str, Any] = {
        "rough": "rough",
        "flat": "flat",
        "law": {interface.law.name: law} if law else interface.law.name,
    }
    materials = {"rough": _material(interface.rough), "flat": _material(interface.flat)}
    if interface.layer is not None:
        thickness = interface.thickness
        thickness = "inf" if thickness == float("inf") else _in("m", float(thickness))
        # A list of one: no curve without the layer beside it.
        compare["layer"] = {"material": "layer", "thickness": [thickness], "rule": interface.rule, "on": interface.on}
        materials["layer"] = _material(interface.layer)
    kinds = {"generate", "population", "file", "asperities", "pair"}
    single = not isinstance(surface, Mapping) or set(surface) & kinds
    surfaces = {"surface": surface} if single else dict(surface)
    return {"title": "Comparison", "material": materials, "compare": compare}, surfaces


def _ask(quantities: Sequence[str], options: dict[str, Any]) -> None:
    """Adds to options of ``[compare]`` what asks for the quantities."""
    conductances = {f"{name}-conductance": name for name in ("electrical", "thermal")}
    allowed = [*conductances, "friction"]
    for quantity in [quantities] if isinstance(quantities, str) else quantities:
        if quantity not in allowed:
            raise ValueError(f"quantities: found {quantity!r}; allowed: {', '.join(allowed)}")
        if quantity == "friction" and "shear_strength" not in options:
            raise ValueError(
                "quantities: found 'friction' without a shear strength; allowed: with shear_strength, such as "
                "{'tau0': 20e6, 'alpha': 0.05}"
            )
        if quantity in conductances:
            name, asked = conductances[quantity], options.get("conductance", {})
            if not isinstance(asked, Mapping):
                asked = dict.fromkeys([asked] if isinstance(asked, str) else asked, {})
            options["conductance"] = {name: {}, **asked}


def compare(
    surface: Surface | Mapping[str, Surface],
    interface: Interface,
    *,
    separations: Sequence[float] | Mapping[str, Any] | None = None,
    pressures: Sequence[float] | Mapping[str, Any] | None = None,
    forces: Sequence[float] | Mapping[str, Any] | None = None,
    quantities: Sequence[str] = (),
    seed: int = 0,
    title: str = "Comparison",
    name: str = "asperity",
    report: str | PathLike[str] | None = None,
    **options: Any,
) -> Results:
    """Compare both models on the same surface, with verdicts and the causes of their difference.

    Parameters
    ----------
    surface : Topography, Pair, Asperities, dict, or mapping of names to these
        What is pressed against the flat; a dictionary is ``[surface.NAME]`` of a spec, such as ``{"population": {...}}``.
    interface : Interface
        Bodies, law and layer.
    separations : sequence or dict, optional
        d/sigma, or ``{"from": 4, "to": 0, "points": 41}``. At least one of separations, pressures and forces is needed.
    pressures, forces : sequence or dict, optional
        Nominal pressures in Pa; forces on the nominal area in N. Every value may have its unit: ``["1 MPa", "10 MPa"]``.
    quantities : sequence of str
        What is compared besides separation, area and stiffness: ``"electrical-conductance"`` and ``"thermal-conductance"``, of
        materials with a resistivity or thermal conductivity, and ``"friction"``, with ``shear_strength``.
    seed : int
        Every random number is drawn from it.
    title, name, report
        Title of the report, name of its folder, and the folder in which it is written, if any.
    **options
        Further keys of ``[compare]``, with ``_`` for ``-``: ``models``, ``reference``, ``statistical``, ``accept``,
        ``robustness``, ``attribution``, ``rank_models``, ``lines``; ``nominal_area`` in m^2;
        ``shear_strength={"tau0": 20e6, "alpha": 0.05}`` with ``tau0`` in Pa; ``conductance`` with films and the medium in
        the gap, such as ``{"thermal": {"gap-conductivity": "0.026 W/(m K)"}}``.

    Returns
    -------
    Results
        With ``answer``, ``at_load``, ``on_map``, ``verdicts``, ``attribution`` and ``curves``.

    Raises
    ------
    ValueError
        Values that cannot run, or a load that a model does not reach.

    Warns
    -----
    AsperityWarning
        Numbers whose unit is hardly SI, and caveats of the results: what ``warnings`` of the results lists.

    Examples
    --------
    >>> import asperity
    >>> steel = asperity.Material(210e9, 0.3, hardness=7.6e9)
    >>> asperities = asperity.draw(20_000, radius=20e-6, sigma=48e-9, density=6e10, seed=1)
    >>> results = asperity.compare(asperities, asperity.Interface(steel, steel), pressures=[1e6, 1e7])
    >>> results.curves["model"].tolist()
    ['statistical', 'statistical', 'deterministic', 'deterministic']
    """
    if separations is None and pressures is None and forces is None:
        raise ValueError("found no separations, pressures or forces; allowed: at least one of them")
    spec, surfaces = _spec(interface, surface)
    doubts: list[str] = []
    pressures = quantity("pressures", pressures, "pressure", doubts)
    forces = quantity("forces", forces, "force", doubts)
    spec["compare"].update(keys({"separation": separations, "pressure": pressures, "force": forces}))
    if "nominal_area" in options:
        options["nominal_area"] = quantity("nominal_area", options["nominal_area"], "area", doubts)
    if isinstance(strength := options.get("shear_strength"), Mapping) and "tau0" in strength:
        tau0 = quantity("shear_strength.tau0", strength["tau0"], "stress", doubts)
        options["shear_strength"] = {**strength, "tau0": tau0}
    _ask(quantities, options)
    spec["compare"].update(keys(options))
    if any(isinstance(one, Pair) for one in surfaces.values()):
        spec["compare"]["surfaces"] = list(surfaces)
    spec.update(seed=seed, title=title)
    with named():
        return _run(spec, surfaces=surfaces, name=name, report=report, doubts=doubts)


def reference(
    surface: Topography | Mapping[str, Any],
    interface: Interface,
    *,
    pressures: Sequence[float] | Mapping[str, Any],
    seed: int = 0,
    **options: Any,
) -> Table:
    """The boundary element reference on the height map itself, without asperities.

    Parameters
    ----------
    surface : Topography or dict
        A surface with a height map.
    interface : Interface
        Bodies, law and layer; where the law yields, the pressure is limited by the hardness.
    pressures : sequence or dict
        Nominal pressures in Pa.
    seed : int
        Every random number is drawn from it.
    **options
        Keys of ``reference`` in a spec: ``error``, ``cap``, ``boundary``, ``refine``, ``loads``.

    Returns
    -------
    Table
        The columns of ``curves.csv``; those about asperities are NaN.

    Raises
    ------
    ValueError
        A surface without a map, or values that cannot run.
    """
    chosen = {"reference": keys(options)} if options else {}
    results = compare(surface, interface, pressures=pressures, seed=seed, models=["reference"], **chosen)
    return results.curves
