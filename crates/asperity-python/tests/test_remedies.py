"""What messages advise can be passed as an argument: `tests/remedies.toml`, as the program's own test applies it in a spec and on the command line."""

import pathlib
import tomllib
import warnings

import numpy as np
import pytest

import asperity

ROOT = pathlib.Path(__file__).resolve().parents[3]
SIDE = 160
CASES = tomllib.loads((ROOT / "tests/remedies.toml").read_text())["remedy"]
# Keys that Python has as an argument of another name, and those that are no argument: a set of heights and radii is made with `independent`.
ARGUMENTS = {"align-lines": "align_lines", "pressure": "pressures", "force": "forces"}


def waves():
    state = 12345

    def random():
        nonlocal state
        state = (state * 1103515245 + 12345) % (1 << 31)
        return state / (1 << 31)

    x, y = np.meshgrid(np.arange(SIDE), np.arange(SIDE), indexing="ij")
    heights = np.zeros((SIDE, SIDE))
    for _ in range(150):
        shares = [random() for _ in range(3)]
        qx, qy = (np.floor(48 * share) - 24 for share in shares[:2])
        size = np.hypot(qx, qy)
        if 2 <= size <= 24:
            heights += size**-1.8 * np.cos(2 * np.pi * ((qx * x + qy * y) / SIDE + shares[2]))
    return 1e-7 * heights / np.sqrt((heights**2).mean())


def made(name, folder):
    """The file of an input."""
    z = waves()
    i, j = np.meshgrid(np.arange(SIDE), np.arange(SIDE), indexing="ij")
    share = ((i * 7919 + j * 104729 + 13) * 2654435761 % 4294967296) / 4294967296
    if name == "channels":
        return ROOT / "crates/asperity/tests/library/formats/samples/st-nid-1.nid"
    if name in ("matrix", "tall", "marked"):
        if name == "marked":
            z.ravel()[np.arange(z.size) % 900 < 2] = -9999e-6
        np.savetxt(folder / "map.txt", z / (1e-9 if name == "tall" else 1e-6), fmt="%.5f")
        return folder / "map.txt"
    if name == "columns":
        columns = np.column_stack([j.ravel(), i.ravel(), z.ravel() * 1e9])
        np.savetxt(folder / "map.txt", columns, fmt="%g", header="x[px] y[px] z[nm]", comments="")
        return folder / "map.txt"
    z += {
        "good": 0,
        "debris": 3e-6 * ((i < 32) & (share < 0.08)),
        "debris-along-y": 3e-6 * ((j < 32) & (share < 0.08)),
        "spikes": 2e-6 * ((i * SIDE + j) % 4999 == 17),
        "lines": 1e-7 * share[0][np.newaxis, :],
        "form": 2e-7 * (i / 80 - 1) ** 2,
        "long": 4e-7 * np.sin(2 * np.pi * 1.5 * i / SIDE),
        "steps": np.round(z / 1e-8) * 1e-8 - z,
        "ridges": 1e-7 * np.sin(0.9 * j + 2.5 * np.sin(0.37 * j) + 1.7 * np.sin(0.113 * j)) - 0.95 * z,
        "plateaus": np.where((i % 2 == 1) & (j % 2 == 1), np.where(share < 0.1, 1e-12, 1e-9 * (0.5 + share)), 0) - z,
    }[name]
    np.save(folder / "map.npy", z)
    return folder / "map.npy"


def said(path, file, compare, hardness=None, law="zmc"):
    """All that is said of a comparison, and whether it was refused."""
    steel, layer = asperity.Material.named("steel-100Cr6"), asperity.Material.named("PTFE")
    if hardness is not None:
        layer = asperity.Material(layer.young, layer.poisson, hardness=hardness)
    coated = compare.pop("layer", None)
    more = {"layer": layer, "thickness": coated["thickness"]} if coated else {}
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            interface = asperity.Interface(steel, steel, law, **more)
            compare.setdefault("pressures", None if "separations" in compare or "forces" in compare else ["1 MPa"])
            results = asperity.compare(asperity.Topography.read(path, **file), interface, **compare)
        except (ValueError, TypeError) as error:
            return str(error), True
    fitness = list(results.tables["fitness"]["remedy"]) if "fitness" in results.tables else []
    texts = [str(results.answer), *results.warnings, *(str(one.message) for one in caught), str(fitness)]
    return "\n".join(texts), False


@pytest.mark.parametrize("case", [case for case in CASES if case["input"] != "list"], ids=lambda case: f"{case['key']} {case['input']}")
def test_advice_can_be_passed(case, tmp_path):
    key, value, says = case["key"], case["value"], case["says"]
    path = made(case["input"], tmp_path)
    of_file = dict(case.get("file", {}))
    of_compare = {"separations" if name == "separation" else name: one for name, one in case.get("compare", {}).items()}
    before, _ = said(path, dict(of_file), dict(of_compare))
    assert says in before
    argument = ARGUMENTS.get(key, key.split(".")[0])
    assert argument in before
    extra = {}
    if key in ("hardness", "law"):
        extra[key] = value
    elif key in ("models", "statistical", "reference", "pressure", "force"):
        of_compare[argument] = value
    elif "." in key:
        of_file[argument] = {key.split(".")[1]: value}
    else:
        of_file[argument] = value
    after, is_refused = said(path, of_file, of_compare, **extra)
    assert says not in after and not is_refused


def test_a_list_is_said_to_be_independent():
    heights = 48e-9 * np.sin(np.arange(500) ** 2.0)
    steel = asperity.Material.named("steel-100Cr6")
    interface = asperity.Interface(steel, steel, "zmc")

    def of(**more):
        asperities = asperity.Asperities(heights, np.full(500, 2e-5), nominal_area="8e-9 m^2", **more)
        return "\n".join(asperity.compare(asperities, interface, pressures=["1 MPa"]).warnings)

    assert "independent=True" in of()
    assert "independent" not in of(independent=True)
