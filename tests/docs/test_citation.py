"""The files that say what this is and how to cite it agree."""

import json
import tomllib
from pathlib import Path

import pytest
import yaml

ROOT = Path(__file__).parents[2]
CITATION = yaml.safe_load((ROOT / "CITATION.cff").read_text("utf-8"))
CODEMETA = json.loads((ROOT / "codemeta.json").read_text("utf-8"))
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
(PAPER,) = CITATION["references"]
SAME = {
    "version": (CITATION["version"], CODEMETA["version"], PROJECT["version"]),
    "title": (CITATION["title"], CODEMETA["name"]),
    "description": (CODEMETA["description"], PROJECT["description"]),
    "licence": (
        CITATION["license"],
        CODEMETA["license"].rpartition("/")[2],
        PROJECT["license"],
    ),
    "day": (CITATION["date-released"], CODEMETA["dateModified"]),
    "authors": (
        [author["name"] for author in CITATION["authors"]],
        [author["name"] for author in CODEMETA["author"]],
        [author["name"] for author in PROJECT["authors"]],
    ),
    "keywords": (CITATION["keywords"], CODEMETA["keywords"]),
    "Python": (CODEMETA["runtimePlatform"], f"Python {PROJECT['requires-python']}"),
    "paper": (PAPER["title"], CODEMETA["referencePublication"]["name"]),
    "paper's authors": (
        [(person["given-names"], person["family-names"]) for person in PAPER["authors"]],
        [
            (person["givenName"], person["familyName"])
            for person in CODEMETA["referencePublication"]["author"]
        ],
    ),
    "paper's year": (
        str(PAPER["year"]),
        CODEMETA["referencePublication"]["datePublished"],
    ),
}


@pytest.mark.parametrize("fact", SAME)
def test_every_fact_is_the_same_everywhere(fact):
    """What CITATION.cff, codemeta.json and pyproject.toml all say, they say alike."""
    first, *others = SAME[fact]
    assert first
    assert all(other == first for other in others)
