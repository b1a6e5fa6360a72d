"""Both models against vectors computed at 40 digits."""

import numpy as np

import asperity


def steel_on(row):
    hardness = float(row["hardness"])
    return asperity.Material(float(row["young"]), float(row["poisson"]), hardness=hardness)


def test_statistical(vectors):
    seen = 0
    for row in vectors("statistical"):
        body = steel_on(row)
        population = asperity.Population(float(row["radius"]), float(row["sigma"]), float(row["density"]))
        h = float(row["separation_over_sigma"])
        found = asperity.statistical(asperity.Interface(body, body), population, separations=h)
        limit = 1e-13 if h <= 20 else 2e-13
        for column, wanted in (("area_ratio", "area_ratio"), ("pressure_pa", "pressure")):
            assert abs(found[column][0] / float(row[wanted]) - 1) < limit, (h, column)
        seen += 1
    assert seen > 100


def test_statistical_under_a_layer(vectors):
    body = asperity.Material(210e9, 0.3, hardness=7.6e9)
    seen = 0
    for row in vectors("statistical_coated"):
        layer = asperity.Material(
            float(row["layer_young"]), float(row["layer_poisson"]), hardness=float(row["layer_hardness"])
        )
        contact = asperity.Interface(body, body, layer=layer, thickness=float(row["thickness"]))
        population = asperity.Population(float(row["radius"]), float(row["sigma"]), float(row["density"]))
        found = asperity.statistical(contact, population, separations=float(row["separation_over_sigma"]))
        assert abs(found["pressure_pa"][0] / float(row["pressure"]) - 1) < 1e-12, row
        seen += 1
    assert seen > 10


def test_deterministic(vectors):
    steel = asperity.Material(210e9, 0.3, hardness=7.6e9)
    sets = {}
    for row in vectors("asperities"):
        sets.setdefault(row["set"], []).append((float(row["height"]), float(row["radius"])))
    seen = 0
    for row in vectors("asperity_sums"):
        if float(row["lead_thickness"]) != 0.0:
            continue
        heights, radii = np.array(sets[row["set"]]).T
        asperities = asperity.Asperities(heights.copy(), radii.copy(), 1.0)
        # With a unit of 1 m, separations are absolute.
        separation = float(row["separation"]) - asperities.statistics()["mean_height_m"]
        found = asperity.deterministic(
            asperity.Interface(steel, steel), asperities, separations=separation, sigma=1.0
        )
        assert found["contact_density_per_m2"][0] == float(row["contacts"])
        # The separation itself is rounded: w of the highest asperity loses a few digits.
        for column, wanted in (("area_ratio", "total_area"), ("pressure_pa", "total_load")):
            assert abs(found[column][0] - float(row[wanted])) <= 1e-11 * float(row[wanted])
        seen += 1
    assert seen > 3


def test_laws(vectors):
    seen = 0
    for row in vectors("zmc"):
        modulus, hardness = float(row["reduced_modulus"]), float(row["hardness"])
        # E* is that of a body on a rigid flat, which has no more than a large modulus here.
        rough = asperity.Material(modulus, 1e-9, hardness=hardness)
        flat = asperity.Material(modulus * 1e18, 0.3)
        law = asperity.Law("zmc", transition_ratio=float(row["transition_ratio"]), onset=(0.3 * np.pi) ** 2)
        contact = asperity.Interface(rough, flat, law)
        if abs(contact.reduced_modulus / modulus - 1) > 1e-15:
            continue
        found = contact.contact(float(row["indentation"]), float(row["radius"]))
        assert abs(found["load_n"][0] / float(row["load"]) - 1) < 1e-12, row
        assert abs(found["area_m2"][0] / float(row["area"]) - 1) < 1e-12, row
        assert found["regime"][0] == row["regime"]
        seen += 1
    assert seen > 100
