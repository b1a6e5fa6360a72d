"""The integral compared with scipy.integrate.quad, in one run.

    pip install -r benches/comparison/requirements.txt
    python benches/comparison/integral.py            # prints a table; --write puts it into docs/performance.md

Area and load of both cases of Table 1, steel on steel, uncoated, at 50 separations from 4 to 0 sigma; one thread. The comparison
program integrates over w with the density relative to that at the flat, one call between two breakpoints (`points=` is slower),
at a relative tolerance of 1e-13; then the elastic load over w^.5, then with a compiled integrand. Errors are against
mpmath at 30 digits, and against tests/reference/statistical.csv, which reaches from -10 to 35 sigma. This program and
the comparison programs run alternately, 15 times.
"""

import timing  # before NumPy

import csv
import sys
from math import exp, log, pi, sqrt

import mpmath
import numba
import scipy
from scipy import LowLevelCallable
from scipy.integrate import quad

from zmc import CASES, HARDNESS, MODULUS, ONSET, SEPARATIONS, SLOPE, TRANSITION

REACH = 80.0  # twice the number of e-foldings of the density that contribute
ACCURACY = 1e-13  # required of all; also the tolerance passed to quad


def pieces(population):
    """Breakpoints in sigma, and area and load over phi(h) at x = w/sigma between them."""
    first = ONSET * population.radius / population.sigma
    second = TRANSITION * first
    disc = pi * population.radius * population.sigma
    hertz = 4 / 3 * MODULUS * sqrt(population.radius) * population.sigma**1.5
    per_first, per_span = 1 / first, 1 / (TRANSITION - 1)
    plastic, slope = 2 * disc, HARDNESS * SLOPE
    onset = HARDNESS * 0.4

    def elastic_area(x, h):
        return disc * x * exp(-x * (h + 0.5 * x))

    def elastic_load(x, h):
        return hertz * x * sqrt(x) * exp(-x * (h + 0.5 * x))

    def elastic_load_of_root(s, h):
        x = s * s
        return 2 * hertz * x * x * exp(-x * (h + 0.5 * x))

    def between_area(x, h):
        t = (x * per_first - 1) * per_span
        return disc * x * (1 + t * t * (3 - 2 * t)) * exp(-x * (h + 0.5 * x))

    def between_load(x, h):
        u = x * per_first
        t = (u - 1) * per_span
        return (onset + slope * log(u)) * disc * x * (1 + t * t * (3 - 2 * t)) * exp(-x * (h + 0.5 * x))

    def plastic_area(x, h):
        return plastic * x * exp(-x * (h + 0.5 * x))

    def plastic_load(x, h):
        return HARDNESS * plastic * x * exp(-x * (h + 0.5 * x))

    areas = [elastic_area, between_area, plastic_area]
    loads = [elastic_load, between_load, plastic_load]
    return (0.0, first, second), areas, loads, elastic_load_of_root


def compiled(function):
    """An integrand that quad calls without Python."""
    inner = numba.njit(function)

    @numba.cfunc("float64(intc, CPointer(float64))")
    def call(_, arguments):
        return inner(arguments[0], arguments[1])

    return LowLevelCallable(call.ctypes)


def with_quad(population, substituted=False, prepare=lambda function: function):
    """Area ratio and pressure at a separation h = d/sigma; `substituted` takes the elastic load over w^.5."""
    starts, areas, loads, load_of_root = pieces(population)
    areas, loads, load_of_root = [*map(prepare, areas)], [*map(prepare, loads)], prepare(load_of_root)

    def integral(function, start, end, h):
        return quad(function, start, end, args=(h,), epsabs=0, epsrel=ACCURACY, limit=200)[0]

    def respond(h):
        end = REACH / (h + sqrt(h * h + REACH)) if h >= 0 else sqrt(REACH) - h
        area = load = 0.0
        for k, start in enumerate(starts):
            if start >= end:
                break
            to = min(starts[k + 1], end) if k < 2 else end
            area += integral(areas[k], start, to, h)
            if k == 0 and substituted:
                load += integral(load_of_root, 0.0, sqrt(to), h)
            else:
                load += integral(loads[k], start, to, h)
        scale = population.density * exp(-0.5 * h * h) / sqrt(2 * pi)
        return scale * area, scale * load

    return respond


def exact(population, h):
    """Area ratio and pressure by mpmath."""
    mpmath.mp.dps = 30
    number = mpmath.mpf
    h, sigma, b = number(h), number(population.sigma), number(population.radius)
    modulus = number(210e9) / (2 * (1 - number(0.3) ** 2))
    hardness, c = number(HARDNESS), number(TRANSITION)
    first = number("0.09") * mpmath.pi**2 * b * (hardness / modulus) ** 2
    second = c * first

    def area(w):
        x = min(max((w - first) / (second - first), number(0)), number(1))
        return mpmath.pi * b * w * (1 + x * x * (3 - 2 * x))

    def load(w):
        if w <= first:
            return 4 * modulus / 3 * mpmath.sqrt(b) * w * mpmath.sqrt(w)
        return hardness * (1 - number("0.6") * mpmath.log(max(second / w, number(1))) / mpmath.log(c)) * area(w)

    reach = 12
    ends = sorted({number(0), first / sigma, second / sigma, *map(number, range(2, reach + 1, 2))})
    ends = [x for x in ends if x <= reach]
    scale = population.density * mpmath.exp(-h * h / 2) / mpmath.sqrt(2 * mpmath.pi)

    def integral(function):
        return scale * mpmath.quad(lambda x: function(x * sigma) * mpmath.exp(-x * (h + x / 2)), ends)

    return float(integral(area)), float(integral(load))


def vectors(population):
    """Separations of tests/reference/statistical.csv with their area ratios and pressures."""
    lines = (timing.ROOT / "tests" / "reference" / "statistical.csv").read_text().splitlines()
    rows = csv.DictReader(line for line in lines if not line.startswith("#"))
    own = {"young": 210e9, "poisson": 0.3, "hardness": HARDNESS, "radius": population.radius,
           "sigma": population.sigma, "density": population.density}
    rows = [row for row in rows if all(float(row[key]) == value for key, value in own.items())]
    return [float(row["separation_over_sigma"]) for row in rows], [
        (float(row["area_ratio"]), float(row["pressure"])) for row in rows
    ]


def worst(found, wanted):
    return max(abs(a / b - 1) for pair, truth in zip(found, wanted) for a, b in zip(pair, truth))


def main():
    this_program = timing.ThisProgram()

    def answer(case, separations):
        """Seconds per separation of this program, and area ratios and pressures."""
        seconds, *words = this_program("integral", case, *separations)
        rows = [words[7 * k : 7 * k + 7] for k in range(len(separations))]
        return seconds, [(sum(row[1:4]), sum(row[4:7])) for row in rows]

    rows = []
    for case, population in enumerate(CASES):
        truth = [exact(population, h) for h in SEPARATIONS]
        far, vector = vectors(population)
        own = worst(answer(case, SEPARATIONS)[1], truth), worst(answer(case, far)[1], vector)
        slowest = max(answer(case, [h])[0] for h in SEPARATIONS)
        # With the bound of the ratio: only the plain call has one.
        programs = [
            ("quad", with_quad(population), 200),
            ("quad, elastic load over w^.5", with_quad(population, True), None),
            ("the same, compiled by numba", with_quad(population, True, compiled), None),
        ]
        times = timing.alternately(
            lambda _: answer(case, SEPARATIONS)[0],
            [lambda _, program=program: [program(h) for h in SEPARATIONS] for _, program, _ in programs],
        )
        mine, others = times[0], [seconds / len(SEPARATIONS) for seconds in times[1:]]

        def row(name, seconds, ratio, bound, met, errors):
            cells = [f"{1e6 * mine:.2f}", seconds, ratio, *(f"{error:.1e}" for error in (*own, *errors)), bound, met]
            rows.append([population.name, name, *cells])
            print("  ".join(rows[-1]), flush=True)

        verdict = lambda met: "met" if met else "**missed**"
        for (name, program, bound), seconds in zip(programs, others):
            errors = worst(map(program, SEPARATIONS), truth), worst(map(program, far), vector)
            if not max(own[0], errors[0]) <= ACCURACY:
                sys.exit(f"{population.name}, {name}: errors {own[0]:.1e} and {errors[0]:.1e}; allowed: {ACCURACY}")
            met = "" if bound is None else verdict(seconds >= bound * mine)
            limit = "" if bound is None else f"{bound:g}"
            row(name, f"{1e6 * seconds:.1f}", f"{seconds / mine:.0f}", limit, met, errors)
        rows.append([population.name, f"one microsecond (slowest separation {1e6 * slowest:.2f})", f"{1e6 * mine:.2f}",
                     "1", f"{1e-6 / mine:.1f}", *(f"{error:.1e}" for error in own), "", "", "1", verdict(mine <= 1e-6)])

    head = ["task", "comparison program", "this program [µs]", "comparison [µs]", "ratio", "error of this program",
            "from -10 to 35", "error of comparison", "from -10 to 35", "bound", "met"]
    lines = timing.table(head, rows)
    versions = ("SciPy", scipy.__version__), ("numba", numba.__version__), ("mpmath", mpmath.__version__)
    lines += ["", f"Times are per separation, on one thread. {timing.machine(*versions)}"]
    timing.publish("integral", lines)


if __name__ == "__main__":
    main()
