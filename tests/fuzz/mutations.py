"""Small harms to a file of text: what an editor, a disk, a colleague or an enemy may do to it."""

import random

WORDS = (
    "null", "true", "-1", "1e308", ".nan", ".inf", "-0", "0", "9" * 400, "''", "[]", "{}", "~",
    "'x'", "subprocess:run", "os:path", "&a [*a]", "*nowhere", "!!python/object:os.system x",
    "<<: {a: 1}", "\u202e\U0001f600", "x" * 5000, "1_0", "0x1F", "2026-01-01", "yes", "999", "1000",
    '"\\n"', "- - - 1", "? [a]", "|", ">", "%YAML 1.1", "---", "...", "{a: 1, a: 2}", "../../etc",
)  # fmt: skip


def mutated(text: str, rng: random.Random) -> bytes:
    """Return a text with one to three harms done to it, as bytes."""
    content = text.encode()
    for _ in range(rng.randint(1, 3)):
        content = rng.choice(HARMS)(content, rng)
    return content


def _line(content, rng):
    lines = content.split(b"\n")
    return lines, rng.randrange(len(lines))


def drop_line(content, rng):
    """Leave a line out."""
    lines, i = _line(content, rng)
    return b"\n".join(lines[:i] + lines[i + 1 :])


def repeat_line(content, rng):
    """Write a line twice."""
    lines, i = _line(content, rng)
    return b"\n".join([*lines[: i + 1], *lines[i:]])


def swap_lines(content, rng):
    """Put two lines in each other's place."""
    lines, i = _line(content, rng)
    j = rng.randrange(len(lines))
    lines[i], lines[j] = lines[j], lines[i]
    return b"\n".join(lines)


def other_value(content, rng):
    """Put something else behind a colon, a dash or a comma."""
    lines, i = _line(content, rng)
    for mark in (b": ", b"- ", b", "):
        before, found, _ = lines[i].partition(mark)
        if found:
            lines[i] = before + mark + rng.choice(WORDS).encode()
            break
    return b"\n".join(lines)


def other_number(content, rng):
    """Change a digit."""
    digits = [i for i, byte in enumerate(content) if 48 <= byte <= 57]
    if not digits:
        return content
    i = rng.choice(digits)
    return content[:i] + rng.choice([b"0", b"9", b"-", b".", b"e", b"99999"]) + content[i + 1 :]


def indent(content, rng):
    """Move a line in or out."""
    lines, i = _line(content, rng)
    lines[i] = lines[i][1:] if rng.random() < 0.5 else rng.choice([b" ", b"  ", b"\t"]) + lines[i]
    return b"\n".join(lines)


def cut(content, rng):
    """Lose the end."""
    return content[: rng.randrange(len(content) + 1)]


def odd_byte(content, rng):
    """Overwrite a byte."""
    if not content:
        return content
    i = rng.randrange(len(content))
    return content[:i] + bytes([rng.randrange(256)]) + content[i + 1 :]


def misspell(content, rng):
    """Lose a letter."""
    letters = [i for i, byte in enumerate(content) if chr(byte).isalpha()]
    if not letters:
        return content
    i = rng.choice(letters)
    return content[:i] + content[i + 1 :]


HARMS = (
    drop_line, repeat_line, swap_lines, other_value, other_value, other_number, other_number,
    indent, cut, odd_byte, misspell,
)  # fmt: skip
