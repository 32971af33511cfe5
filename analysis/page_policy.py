"""What a browser lets a page of ours do: nothing but show what is its own."""

import base64
import hashlib


def content_policy(style: str, script: str = "") -> str:
    """Return a content security policy that allows one style sheet and, if any, one script.

    Parameters
    ----------
    style, script
        As they stand in the page, between their tags.
    """
    allowed = f"script-src {_hash(script)}; " if script else ""
    return (
        f"default-src 'none'; img-src data:; style-src {_hash(style)}; {allowed}"
        "base-uri 'none'; form-action 'none'"
    )


def _hash(text: str) -> str:
    return f"'sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()}'"
