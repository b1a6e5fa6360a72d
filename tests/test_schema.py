"""What the schema of specs, by which editors complete and check them, allows and refuses."""
import json
from pathlib import Path

import jsonschema
import pytest
import tomli

PROJECT = Path(__file__).parents[1]
# `cargo test` compares it with the schema that the program has.
SCHEMA = json.loads((PROJECT / "docs/spec.schema.json").read_text())
SPECS = [*sorted((PROJECT / "experiments").glob("*.toml")), PROJECT / "src/template.toml"]
VALID = """title = "t"
material.a = { young = "1 GPa", poisson = 0.3 }
[laws]
rough = "a"
flat = "a"
law = ["hertz", "zmc"]
asperity.radius = "1 um"
indentation = [1, 2]
pressure = "1 MPa"
"""


def faults(value, schema=SCHEMA):
    return [f"{list(fault.path)}: {fault.message}" for fault in jsonschema.Draft7Validator(schema).iter_errors(value)]


def with_examples(schema):
    """The schemas within a schema that have examples or a default, which editors insert."""
    if isinstance(schema, dict):
        if "examples" in schema or "default" in schema:
            yield schema
        schema = list(schema.values())
    if isinstance(schema, list):
        for below in schema:
            yield from with_examples(below)


@pytest.mark.parametrize("path", SPECS, ids=lambda path: path.stem)
def test_every_spec_that_is_read_is_allowed(path):
    assert faults(tomli.loads(path.read_text())) == []


@pytest.mark.parametrize(
    ("text", "wrong"),
    [
        ('title = "t"\n', ""),
        ('title = "t"\n', 'title = "t"\ntitel = "u"\n'),
        ("poisson = 0.3", "poisson = 0.51"),
        ("poisson = 0.3", 'poisson = "0.3"'),
        ('young = "1 GPa"', "young = -1"),
        ("young = ", "youngs = "),
        ('"hertz"', '"herz"'),
        ('"zmc"', "{ zmc = { ratio = 2 } }"),
        ("[laws]", "[law]"),
        ("[1, 2]", "{ from = 1, to = 2 }"),
        ("[1, 2]", "[]"),
        ("\n[laws]", "\n[limit]\n[laws]"),
    ],
)
def test_what_is_refused_when_read_is_refused(text, wrong):
    assert faults(tomli.loads(VALID)) == []
    assert text in VALID
    assert faults(tomli.loads(VALID.replace(text, wrong)))


def test_examples_and_defaults_are_allowed():
    schemas = list(with_examples(SCHEMA))
    assert len(schemas) > 150
    for schema in schemas:
        for value in [*schema.get("examples", []), *([schema["default"]] if "default" in schema else [])]:
            assert faults(value, schema) == [], schema
