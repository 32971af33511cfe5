"""The page that comes with every export: what it is, what is left out, and the licence."""

from pathlib import Path, PurePath

from analysis.export.content import Content, Table, left_out
from protocols.files.dump import plain_yaml
from protocols.record.header import Origin
from protocols.versions import package_versions

README_FILE = "README.md"
LICENCE_FILE = "LICENSE"
STUDY_FILE = "study.yaml"

_FROM: dict[Origin, str] = {
    "simulated": "Synthetic participants, simulated.",
    "live": "Living people took part.",
    "elsewhere": "Recorded by other programs.",
}


def write_about(
    content: Content, folder: Path, how_to_read: str, *, name: str = README_FILE
) -> None:
    """Write README, licence and the study's own description into a folder.

    Parameters
    ----------
    content
        What is exported.
    folder
        Where to.
    how_to_read
        What is particular to the format (Markdown).
    name
        Of the README.
    """
    (folder / name).write_text(readme(content, how_to_read), encoding="utf-8")
    (folder / LICENCE_FILE).write_text(content.licence.text, encoding="utf-8")
    (folder / STUDY_FILE).write_text(study_text(content), encoding="utf-8")


def study_text(content: Content) -> str:
    """Return protocol, course and questionnaires as YAML; nothing about the computer in use."""
    header = content.study.header.model_dump(mode="json", by_alias=True)
    kept = ("schema", "origin", "seed", "digest", "protocol", "instruments", "course")
    protocol = header["protocol"]
    protocol["live"]["completion"] = None  # a recruitment platform pays for its code
    for model in protocol["models"].values():
        if model["path"] is not None:  # of a computer that is nobody else's
            model["path"] = PurePath(model["path"]).name
    return plain_yaml({name: header[name] for name in kept})


def readme(content: Content, how_to_read: str) -> str:
    """Return the text of the README (Markdown)."""
    protocol = content.study.protocol
    tables = (content.participants, content.laps, content.surveys, content.items)
    return "\n".join(
        [
            f"# {protocol.title}",
            "",
            protocol.description or "An assistance study with a smart wheelchair.",
            "",
            _in_short(content),
            "",
            "## Reading it",
            "",
            how_to_read.strip(),
            "",
            "`study.yaml` holds protocol, course and questionnaires.",
            "",
            "## What is left out",
            "",
            *_privacy(content),
            "",
            "## Columns",
            "",
            *(line for table in tables for line in column_list(table)),
            "## Licence",
            "",
            content.licence.text.strip(),
            "",
        ]
    )


def _in_short(content: Content) -> str:
    return (
        f"{_FROM[content.study.header.origin]} {len(content.people)} participants, "
        f"{len(content.laps.rows)} laps on the course {content.study.course_names}. "
        f"Exported by lad-study {_version()}."
    )


def _version() -> str:
    return package_versions(("lad-study",)).get("lad-study", "")


def _privacy(content: Content) -> list[str]:
    absent = len(content.study.participants) - len(content.people)
    times = "- calendar times: every time counts from the start of its lap"
    tables = "In tables of text, an apostrophe stands before text that begins with =, +, - or @."
    listed = [f"- {words}" for words in left_out(content)]
    if absent:
        listed.append(f"- {absent} participants whose consent does not cover it")
    people = content.unique_people
    return [
        *listed,
        times,
        "",
        tables,
        "",
        f"{people} of {len(content.people)} people are the only ones with their age (as given "
        "here), gender and handedness"
        + ("." if content.living else "; they are synthetic: nobody can be found out."),
    ]


def column_list(table: Table) -> list[str]:
    """Return a table's columns as a Markdown list under a heading."""
    entries = [
        f"- `{f.name}`{f' ({f.unit})' if f.unit else ''}: {f.description}" for f in table.fields
    ]
    return [f"### {table.name}", "", *entries, ""]
