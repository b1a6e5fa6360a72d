"""Studies over many machines: variations of a spec, or tiles of a surface, on the workers of a Dask cluster.

>>> from asperity import distributed
>>> distributed.combinations({"seed": [1, 2], "compare.law": ["zmc", "hertz"]})[1]
{'seed': 1, 'compare.law': 'hertz'}
"""

from __future__ import annotations

import copy
import itertools
import json
import os
import warnings
import zipfile
from collections.abc import Callable, Iterable, Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import _asperity
from .arguments import check_file
from .study import Results

if TYPE_CHECKING:
    from distributed import Client

Variation = Mapping[str, Any]


def combinations(values: Mapping[str, Iterable[Any]]) -> list[dict[str, Any]]:
    """All combinations of the values of some keys, the last key running fastest.

    Parameters
    ----------
    values : mapping of str to iterable
        The values of each key: ``{"seed": range(64)}`` are 64 realisations, ``{"surface.ground.file.path": paths}`` many
        maps.

    Returns
    -------
    list of dict
        One dictionary of key and value for each combination.
    """
    lists = [list(choices) for choices in values.values()]
    return [dict(zip(values, combination)) for combination in itertools.product(*lists)]


def map(
    spec: str | PathLike[str] | Mapping[str, Any],
    variations: Mapping[str, Iterable[Any]] | Sequence[Variation] | None = None,
    client: Client | None = None,
    *,
    results: str | PathLike[str] | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> list[Results]:
    """Run a spec with other values of some of its keys, each variation on one worker of a Dask cluster.

    All variations are checked before the first one runs. The results are the same to the bit as those of a single machine
    whose vector registers are as wide as the workers'. Dask runs a variation again whose worker was lost. Each worker uses
    all its cores: where several share a machine, set ``RAYON_NUM_THREADS`` in their environment.

    Parameters
    ----------
    spec : path_like or mapping
        A spec file, or a dictionary with the same keys. Paths in it are relative to the folder of the file, or to the working
        directory; the workers must find the files there too.
    variations : mapping of str to iterable, or sequence of mappings, optional
        Values by dotted key: a mapping stands for all its :func:`combinations`. Without them those of ``[sweep]`` of the spec
        (:func:`sweep` makes its one report).
    client : distributed.Client, optional
        Any client: of a ``LocalCluster``, of ``dask_jobqueue.SLURMCluster``, of Kubernetes. Without one the variations run
        here, one after the other.
    results : path_like, optional
        A folder in which each result is kept as soon as it is there. What it holds already, of the same spec, files and
        program, is not run again.
    progress : callable, optional
        Called with the number of results and the number of variations, first with those found in `results`.

    Returns
    -------
    list of Results
        In the order of the variations.

    Raises
    ------
    ValueError
        A variation that cannot run, with its number, its values and the reason.

    Examples
    --------
    >>> import asperity
    >>> spec = {
    ...     "title": "Hardness",
    ...     "material": {"steel": {"young": 210e9, "poisson": 0.3, "hardness": 7.6e9}},
    ...     "surface": {"S": {"population": {"radius": 20e-6, "sigma": 48e-9, "density": 6e10, "count": 10_000}}},
    ...     "compare": {"rough": "steel", "flat": "steel", "law": "zmc", "pressure": 1e6},
    ... }
    >>> hard = asperity.distributed.map(spec, {"material.steel.hardness": [2e9, 7.6e9]})
    >>> [float(results.curves["area_ratio"][0].round(5)) for results in hard]
    [0.00079, 0.00056]
    """
    base, folder, name = _read(spec)
    if variations is None:
        chosen, specs = [], []
        for values, varied in _asperity.variations(base, folder=folder):
            chosen.append(values)
            specs.append(varied)
    else:
        chosen = combinations(variations) if isinstance(variations, Mapping) else [dict(one) for one in variations]
        specs = [_varied(base, variation) for variation in chosen]
    named = [f"variation {number} {variation}" for number, variation in enumerate(chosen, 1)]
    keys = []
    for varied, words in zip(specs, named):
        try:
            keys.append(_asperity.key(varied, name=name, folder=folder))
        except ValueError as error:
            raise ValueError(f"{words}: {error}") from None
    store = None if results is None else _Store(Path(results), name)
    found: list[Results | None] = [store.read(key) if store else None for key in keys]

    def report() -> None:
        if progress is not None:
            progress(sum(result is not None for result in found), len(found))

    def keep(place: int, result: Results) -> None:
        found[place] = result
        if store:
            store.write(keys[place], result)
        report()

    report()
    # Variations that are equal run once.
    places: dict[str, list[int]] = {}
    for place, key in enumerate(keys):
        if found[place] is None:
            places.setdefault(key, []).append(place)
    missing = {key: (specs[those[0]], name, folder) for key, those in places.items()}
    for key, (result, bits) in _answers(_run, missing, name, client):
        if isinstance(result, ValueError):
            raise ValueError(f"{named[places[key][0]]}: {result}") from None
        _warn_of_registers(named[places[key][0]], bits)
        for place in places[key]:
            keep(place, result)
    return [result for result in found if result is not None]


def sweep(
    spec: str | PathLike[str] | Mapping[str, Any],
    client: Client | None = None,
    *,
    report: str | PathLike[str] | None = None,
    results: str | PathLike[str] | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> Results:
    """Run a spec with ``[sweep]`` or ``[tiled]`` on the workers of a Dask cluster, and make its one report.

    A worker runs one variation of the sweep, or sums a few neighbouring tiles of the surface. What it finds is a text that keeps every
    bit; Dask moves it here, where all are added in their order. The spec alone fixes the tiles, so that neither the number of workers nor
    the loss of one changes a digit. Where the mean height and its standard deviation are not known, as of a map or a list, a first pass
    over the tiles finds them.

    Parameters
    ----------
    spec, client, progress
        As for :func:`map`.
    report : path_like, optional
        A folder of reports, in which that of the spec is written.
    results : path_like, optional
        A folder in which what each variation or tile gives is kept as soon as it is there, and not run again.

    Returns
    -------
    Results
        The tables and the answer: the same to the bit as of ``asperity.run`` on one machine whose vector registers
        are as wide as the workers'.

    Raises
    ------
    ValueError
        A spec with neither, or one that cannot run.

    Examples
    --------
    >>> import asperity
    >>> spec = {
    ...     "title": "Hardness",
    ...     "material": {"steel": {"young": 210e9, "poisson": 0.3, "hardness": 7.6e9}},
    ...     "surface": {"S": {"population": {"radius": 20e-6, "sigma": 48e-9, "density": 6e10, "count": 10_000}}},
    ...     "compare": {"rough": "steel", "flat": "steel", "law": "zmc", "pressure": 1e6},
    ...     "sweep": {"material.steel.hardness": [2e9, 7.6e9]},
    ... }
    >>> swept = asperity.distributed.sweep(spec)
    >>> swept.tables["sweep"]["deterministic_area_ratio"].round(5).tolist()
    [0.00079, 0.00056]
    """
    base, folder, name = _read(spec)
    key = _asperity.key(base, name=name, folder=folder)
    count, passes = _asperity.tasks(base, name=name, folder=folder)
    kept = None if results is None else Path(results)
    if kept:
        kept.mkdir(parents=True, exist_ok=True)
    found: list[list[str | None]] = []

    def report_progress() -> None:
        if progress is not None:
            progress(sum(answer is not None for answers in found for answer in answers), passes * count)

    for number in range(passes):
        of_pass = f"{name}-{key[:32]}-{_asperity.register_bits()}-pass-{number + 1}"
        paths = [kept / f"{of_pass}-{task + 1}-of-{count}.json" if kept else None for task in range(count)]
        earlier = list(found)
        answers = [path.read_text() if path and path.exists() else None for path in paths]
        found.append(answers)
        report_progress()
        missing = {
            f"{key}-{number}-{task}": (base, task, earlier, name, folder)
            for task, answer in enumerate(answers)
            if answer is None
        }
        for of_task, (answer, bits) in _answers(_run_task, missing, name, client):
            task = missing[of_task][1]
            if isinstance(answer, ValueError):
                raise answer
            _warn_of_registers(f"task {task + 1}", bits)
            answers[task] = answer
            path = paths[task]
            if path:
                new = path.with_name(f".{path.name}.{os.getpid()}")
                new.write_text(answer)
                os.replace(new, path)
            report_progress()
    return Results(_asperity.results_of_tasks(base, found, key=key, name=name, report=report, folder=folder))


def _read(spec: str | PathLike[str] | Mapping[str, Any]) -> tuple[dict[str, Any], str, str]:
    """A spec as a dictionary, the folder of its paths, and the name of its report."""
    if isinstance(spec, Mapping):
        return dict(spec), os.getcwd(), "asperity"
    path = Path(spec).resolve()
    check_file(path)
    return _asperity.read_spec(path), str(path.parent), path.stem


def _warn_of_registers(name: str, bits: int) -> None:
    own = _asperity.register_bits()
    if bits != own:
        warnings.warn(
            f"{name} ran in vector registers of {bits} bits, this process has {own}: the last digits of sums may differ from those of "
            "a run here",
            stacklevel=3,
        )


def _answers(
    run: Callable[..., tuple[Any, int]], calls: Mapping[str, tuple], name: str, client: Client | None
) -> Iterable[tuple[str, tuple[Any, int]]]:
    """What `run` gives for the arguments of each call, by key, in the order in which it is there."""
    if client is None:
        for key, arguments in calls.items():
            yield key, run(*arguments)
        return
    from distributed import as_completed

    # By the key of the results, so that another call with the same client shares them.
    futures = {
        client.submit(run, *arguments, key=f"asperity-{key}-{name}", pure=True): key
        for key, arguments in calls.items()
    }
    try:
        for future, answer in as_completed(list(futures), with_results=True):
            yield futures[future], answer
    finally:
        client.cancel([future for future in futures if not future.done()])


def _run(spec: dict, name: str, folder: str) -> tuple[Results | ValueError, int]:
    """A variation on its worker; an invalid one is no failure of the worker, and would fail on every other."""
    try:
        return Results(_asperity.run(spec, {}, name=name, folder=folder)), _asperity.register_bits()
    except ValueError as error:
        return error, _asperity.register_bits()


def _run_task(
    spec: dict, task: int, earlier: list[list[str]], name: str, folder: str
) -> tuple[str | ValueError, int]:
    """A task on its worker."""
    try:
        return _asperity.run_task(spec, task, earlier, name=name, folder=folder), _asperity.register_bits()
    except ValueError as error:
        return error, _asperity.register_bits()


def _varied(spec: Mapping[str, Any], variation: Variation) -> dict[str, Any]:
    """The spec with the values of a variation at their dotted keys."""
    varied = copy.deepcopy(dict(spec))
    for key, value in variation.items():
        *tables, last = key.split(".")
        table = varied
        for place, name in enumerate(tables):
            table = table.setdefault(name, {})
            if not isinstance(table, dict):
                above = ".".join(tables[: place + 1])
                raise ValueError(f"{key}: found a value at {above}; allowed: a key of a table")
        table[last] = value
    return varied


class _Store:
    """Results in a folder: one archive each, written whole or not at all, named by what it depends on."""

    def __init__(self, folder: Path, name: str) -> None:
        self.folder, self.name = folder, name
        folder.mkdir(parents=True, exist_ok=True)

    def path(self, key: str) -> Path:
        return self.folder / f"{self.name}-{key[:32]}-{_asperity.register_bits()}.zip"

    def read(self, key: str) -> Results | None:
        try:
            with zipfile.ZipFile(self.path(key)) as archive:
                about = json.loads(archive.read("about.json"))
                if about["key"] != key:
                    return None
                csv = {name: archive.read(name) for name in archive.namelist() if name.endswith(".csv")}
                summary = archive.read("summary.json").decode()
                return Results(_asperity.Run.from_parts(about["kind"], csv, summary, about["warnings"], None))
        # What is not a whole result is run again.
        except (FileNotFoundError, zipfile.BadZipFile, KeyError, json.JSONDecodeError):
            return None

    def write(self, key: str, result: Results) -> None:
        path = self.path(key)
        new = path.with_name(f".{path.name}.{os.getpid()}")
        about = {"key": key, "kind": result.kind, "warnings": result.warnings}
        with zipfile.ZipFile(new, "w", zipfile.ZIP_DEFLATED) as archive:
            archive.writestr("about.json", json.dumps(about))
            archive.writestr("summary.json", result._run.summary)
            for name, content in result.csv.items():
                archive.writestr(name, content)
        os.replace(new, path)
