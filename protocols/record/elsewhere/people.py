"""Ids of participants as different programs write them: one person, or two."""

import re
import unicodedata
from collections import Counter
from collections.abc import Iterable, Mapping

import pyarrow as pa
import pyarrow.compute as pc


def one_form(participant: str) -> str:
    """Return an id in one form: letters with marks as one character, no blanks around it.

    Examples
    --------
    >>> one_form("Rene\u0301 ") == "Ren\u00e9"
    True
    """
    return unicodedata.normalize("NFC", participant).strip()


def same_people(known: Iterable[str]) -> dict[str, str]:
    """Return ids by their one form, as the table of participants writes them; only unique ones."""
    known = list(known)
    count = Counter(map(one_form, known))
    return {one_form(name): name for name in known if count[one_form(name)] == 1}


def twins(known: Iterable[str]) -> list[str]:
    """Return the ids that differ from another one only in what nobody sees.

    Examples
    --------
    >>> twins(["01", "02", "01 "])
    ['01', "'01 '"]
    """
    known = list(known)
    count = Counter(map(one_form, known))
    return sorted((repr_if_odd(name) for name in known if count[one_form(name)] > 1), reverse=True)


def with_known_ids(table: pa.Table, known: Iterable[str]) -> tuple[pa.Table, int]:
    """Return a table with the ids of the table of participants, and in how many rows they differed.

    Two ids are one person's where they differ in blanks around them, or in how letters with marks
    are coded: a person does not see either. Other likenesses are not trusted (``probably``).
    """
    names = set(known)
    ids = table["participant"].to_pylist()
    strangers = {name for name in ids if name not in names}
    people = same_people(names) if strangers else {}
    taken_for: Mapping[str, str] = {
        name: people[one_form(name)] for name in strangers if one_form(name) in people
    }
    if not taken_for:
        return table, 0
    place = table.schema.get_field_index("participant")
    mended = pa.array([taken_for.get(name, name) for name in ids], pa.string())
    changed = sum(name in taken_for for name in ids)
    return table.set_column(place, table.schema.field(place), mended), changed


def probably(stranger: str, known: Iterable[str]) -> str | None:
    """Return who may be meant by an unknown id; None when it may be no one, or several.

    Letter case, zeros in front, and text before the number are ignored.

    Examples
    --------
    >>> probably("sub-01", ["01", "02"]), probably("001", ["1", "2"]), probably("x", ["1"])
    ('01', '1', None)
    """
    wanted = _core(stranger)
    alike = [name for name in known if _core(name) == wanted and name != stranger]
    return alike[0] if wanted and len(alike) == 1 else None


def _core(name: str) -> str:
    text = one_form(name).casefold()
    number = re.fullmatch(r"\D*?[\W_a-z]*?0*(\d+)", text)
    return number.group(1) if number else re.sub(r"[\W_]+", "", text)


def strangers(ids: Iterable[str], known: Iterable[str]) -> tuple[int, str]:
    """Return how many of some rows are of people who are not known, and these with a guess each.

    Returns
    -------
    tuple[int, str]
        The rows, and such as ``001 (1?), GHOST``; at most five names.
    """
    known = set(known)
    count = Counter(name for name in ids if name not in known)
    return sum(count.values()), named(count, known)


def named(unknown: Iterable[str], known: Iterable[str]) -> str:
    """Return unknown ids, each with who may be meant; at most five of them."""
    known, unknown = list(known), sorted(unknown)
    guesses = ((name, probably(name, known)) for name in unknown[:5])
    said = [repr_if_odd(name) + (f" ({guess}?)" if guess else "") for name, guess in guesses]
    return ", ".join(said) + (f", ... ({len(unknown)} in all)" if len(unknown) > 5 else "")


def repr_if_odd(name: str) -> str:
    """Return an id as it is, or in quotes where blanks or unseen characters would mislead."""
    odd = name != one_form(name) or not name.isprintable()
    return ascii(name) if odd else name


def column_of(table: pa.Table, name: str) -> list[str]:
    """Return a column of text as a list, missing ones left out."""
    values: list[str] = pc.drop_null(table[name]).to_pylist()
    return values
