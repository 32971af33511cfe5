"""The RO-Crate."""

import hashlib
import json
import os
import shutil
import subprocess

import pytest

VALIDATOR = shutil.which(os.environ.get("ROCRATE_VALIDATOR", "rocrate-validator"))
"""roc-validator wants an older rich than import-linter: it needs an environment of its own."""


def faults(folder):
    """Return what breaks the rules of a crate: entities, links and checksums."""
    graph = json.loads((folder / "ro-crate-metadata.json").read_text())["@graph"]
    entities = {entity["@id"]: entity for entity in graph}
    root = entities["./"]
    found = [f"root lacks {n}" for n in ("name", "description", "license", "datePublished")
             if not root.get(n)]  # fmt: skip
    for entity in graph:
        for value in entity.values():
            for link in value if isinstance(value, list) else [value]:
                target = link.get("@id") if isinstance(link, dict) else None
                if target and target not in entities and not target.startswith("https://w3id.org"):
                    found.append(f"{entity['@id']} refers to {target}, which is not there")
    parts = {part["@id"] for part in root["hasPart"]}
    there = {path.name for path in folder.iterdir()} - {"ro-crate-metadata.json"}
    found += [f"{name} is not listed, or not there" for name in parts ^ there]
    for name in parts & there:
        checksum = hashlib.sha256((folder / name).read_bytes()).hexdigest()
        if entities[name]["sha256"] != checksum:
            found.append(f"{name} is not what was written")
    return found


def test_links_files_and_checksums_agree(exported):
    """Every file is listed with its checksum, and every link leads somewhere."""
    assert faults(exported("ro-crate")) == []


def _change(folder):
    (folder / "laps.csv").write_text("nothing\n")


def _remove(folder):
    (folder / "surveys.csv").unlink()


def _no_licence(folder):
    path = folder / "ro-crate-metadata.json"
    crate = json.loads(path.read_text())
    for entity in crate["@graph"]:
        entity.pop("license", None)
    path.write_text(json.dumps(crate))


@pytest.mark.parametrize("damage", [_change, _remove, _no_licence])
def test_a_damaged_copy_is_refused(damage, exported, tmp_path):
    """A changed file, a missing one, a crate without a licence."""
    copied = shutil.copytree(exported("ro-crate"), tmp_path / "copy")
    damage(copied)
    assert faults(copied)


@pytest.mark.slow
@pytest.mark.skipif(VALIDATOR is None, reason="rocrate-validator is not installed")
@pytest.mark.parametrize("damage", [None, _remove, _no_licence])
def test_the_fields_own_checker_agrees(damage, exported, tmp_path):
    """`rocrate-validator`: the crate is valid, a damaged copy is not.

    It reads the JSON-LD context of the specification from its cache (`rocrate-validator cache
    warm`), or from the network.
    """
    copied = shutil.copytree(exported("ro-crate"), tmp_path / "copy")
    if damage is not None:
        damage(copied)
    command = [str(VALIDATOR), "-y", "--disable-color", "validate", "--offline", "--no-paging"]
    if cache := os.environ.get("ROCRATE_CACHE"):
        command += ["--cache-path", cache]
    ended = subprocess.run(  # noqa: S603  # a checker
        [*command, "-p", "ro-crate-1.2", str(copied)], capture_output=True, text=True, check=False
    )
    if "not available in the HTTP cache" in ended.stdout + ended.stderr:
        pytest.skip("the validator has no copy of the JSON-LD context")
    assert (ended.returncode == 0) == (damage is None), ended.stdout
