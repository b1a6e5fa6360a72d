"""What comes with the package: licences, also of what is linked into it, and its bill of materials."""

import json
from importlib.metadata import distribution

PACKAGE = distribution("asperity")


def text(name):
    """A file beside the package's metadata."""
    found = PACKAGE.read_text(name)
    assert found, name
    return found


def test_licences_come_with_the_package():
    assert PACKAGE.metadata["License-Expression"] == "MIT OR Apache-2.0"
    assert "Permission is hereby granted" in text("licenses/LICENSE-MIT")
    assert "Apache License" in text("licenses/LICENSE-APACHE")
    others = text("licenses/THIRD-PARTY-LICENSES")
    for name in ("rustfft ", "pyo3 ", "zlib-rs ", "uPlot "):
        assert name in others, name


def test_its_bill_of_materials_names_what_is_linked():
    paths = [str(path) for path in PACKAGE.files if path.parent.name == "sboms"]
    materials = json.loads(text(f"sboms/{paths[0].rpartition('/')[2]}"))
    assert materials["bomFormat"] == "CycloneDX"
    assert {"asperity", "rustfft", "pyo3"} <= {one["name"] for one in materials["components"]}
