"""Names as BIDS and Psych-DS have them in file names: letters and digits only."""

from collections.abc import Iterable, Mapping


def file_label(name: str) -> str:
    """Return a name's letters and digits; ``x`` for a name without any.

    Two names may have the same label: see ``file_labels``.

    Examples
    --------
    >>> file_label("human-assisted")
    'humanassisted'
    """
    return "".join(c for c in name if c.isascii() and c.isalnum()) or "x"


def file_labels(names: Iterable[str]) -> dict[str, str]:
    """Return the label of each name, none twice, also where upper and lower case are the same.

    A name of letters and digits only keeps its form before others may take it.

    Examples
    --------
    >>> file_labels(["a-1", "a1", "b 2"])
    {'a1': 'a1', 'a-1': 'a1x2', 'b 2': 'b2'}
    """
    labels: dict[str, str] = {}
    taken: set[str] = set()
    for name in sorted(set(names), key=lambda name: (file_label(name) != name, name)):
        label, n = file_label(name), 1
        while label.lower() in taken:
            n += 1
            label = f"{file_label(name)}x{n}"
        taken.add(label.lower())
        labels[name] = label
    return labels


def renamed_text(labels: Mapping[str, str]) -> str:
    """Return lines that say which names differ in file names; empty where none does.

    Examples
    --------
    >>> print(renamed_text({"P1": "P1", "a-1": "a1"}))
    In file names, participant `a-1` is `a1`.
    <BLANKLINE>
    """
    differ = ((name, label) for name, label in sorted(labels.items()) if name != label)
    return "".join(f"In file names, participant `{n}` is `{label}`.\n" for n, label in differ)
