"""Whether a study may be handed on, and under which licence."""

from dataclasses import dataclass
from pathlib import Path

import pyarrow as pa
import pyarrow.compute as pc

from protocols.files.errors import InputError
from protocols.files.suggestion import allowed
from protocols.record.amendment import plan_number
from protocols.record.reader import Study
from protocols.registration import REGISTRATION, read_registration
from protocols.shipped import locate_text

_CREATIVE = "https://creativecommons.org"
_NAMES = {
    "CC0-1.0": ("Creative Commons Zero 1.0 Universal", f"{_CREATIVE}/publicdomain/zero/1.0/"),
    "CC-BY-4.0": ("Creative Commons Attribution 4.0", f"{_CREATIVE}/licenses/by/4.0/"),
    "CC-BY-SA-4.0": (
        "Creative Commons Attribution Share-Alike 4.0", f"{_CREATIVE}/licenses/by-sa/4.0/"),
    "CC-BY-NC-4.0": (
        "Creative Commons Attribution Non-Commercial 4.0", f"{_CREATIVE}/licenses/by-nc/4.0/"),
    "PDDL-1.0": (
        "Open Data Commons Public Domain Dedication 1.0",
        "https://opendatacommons.org/licenses/pddl/1-0/"),
    "ODC-By-1.0": (
        "Open Data Commons Attribution 1.0", "https://opendatacommons.org/licenses/by/1-0/"),
    "ODbL-1.0": (
        "Open Data Commons Open Database 1.0", "https://opendatacommons.org/licenses/odbl/1-0/"),
}  # fmt: skip

DEFAULT_LICENCE = "CC0-1.0"
"""Of simulated people's data: nobody's rights are in it."""

LICENCES = tuple(_NAMES)
"""Identifiers (SPDX) of the licences for data that are known by name."""


SYNTHETIC = ("synthetic", "scripted")
"""Kinds of participants who are nobody."""


@dataclass(frozen=True, slots=True)
class Licence:
    """Under what a copy may be used.

    Attributes
    ----------
    name
        Its SPDX identifier, or ``LicenseRef-`` and a file's name.
    title
        As a person reads it.
    url
        Where its text stands; empty for a text of one's own.
    text
        What goes into the file ``LICENSE``.
    """

    name: str
    title: str
    url: str
    text: str


def licence_of(given: str | None, *, living: bool) -> Licence:
    """Return the licence a person chose, or the default for simulated people's data.

    Parameters
    ----------
    given
        One of ``LICENCES``, or a text file; None when nothing was chosen.
    living
        Whether living people took part: there is no default then.

    Raises
    ------
    InputError
        When nothing was chosen for living people's data, or there is no such licence or file.
    """
    if given is None:
        if living:
            raise InputError(
                "--licence: missing; data of living people need one; "
                f"allowed: {', '.join(LICENCES)}, or a text file"
            )
        given = DEFAULT_LICENCE
    if given in _NAMES:
        title, url = _NAMES[given]
        return Licence(given, title, url, f"{title} ({given})\n\nThe text: {url}\n")
    path = Path(given)
    if not path.is_file():
        raise InputError(f"--licence: {given!r}; {allowed(given, LICENCES, ['a text file'])}")
    return Licence(f"LicenseRef-{path.stem}", path.stem, "", locate_text(given, None))


def has_living(study: Study) -> bool:
    """Tell whether living people took part, or may have: who does not say is taken as living."""
    kinds = set(study.participants["kind"].to_pylist())
    return study.header.origin == "live" or not kinds <= set(SYNTHETIC)


def check_sharing(study: Study) -> None:
    """Refuse to hand on living people's data without a consent that allows it.

    Raises
    ------
    InputError
        Says what is missing.
    """
    consent = study.protocol.consent
    if not has_living(study) or (consent is not None and consent.sharing):
        return
    has = "there is none" if consent is None else f"version {consent.version} does not say so"
    raise InputError(
        f"{study.folder}: living people took part, and their consent must allow sharing ({has}); "
        "allowed: a study with 'consent: {sharing: true}' in its protocol"
    )


def may_be_shared(study: Study, *, living: bool) -> pa.ChunkedArray:
    """Return for each participant whether the consent given covers the row.

    A living person's consent must be on record, and be to a text that allows sharing: of an
    amended study, the text that was the plan's when the person took part. A refusal holds for
    everybody.

    Raises
    ------
    InputError
        When an amended study of living people has no registration that can be read.
    """
    people = study.participants
    agreed = pc.fill_null(people["consented"], not living)
    if not living or not study.header.amended:
        return agreed
    chain = read_registration(study.folder / REGISTRATION)
    allows = [protocol.consent is not None and protocol.consent.sharing
              for protocol in chain.protocols]  # fmt: skip
    plans = [plan_number(study.header, name) for name in people["participant"].to_pylist()]
    return pc.and_(agreed, pa.array([allows[number] for number in plans], pa.bool_()))
