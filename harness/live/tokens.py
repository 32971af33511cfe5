"""Links that say who may sit where: signed, revocable, and never logged."""

import base64
import hashlib
import hmac
import itertools
import secrets
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Literal

Role = Literal["participant", "demonstrator", "experimenter"]
ROLES: dict[str, Role] = {"p": "participant", "d": "demonstrator", "x": "experimenter"}
LETTERS: dict[Role, str] = {role: letter for letter, role in ROLES.items()}


@dataclass(frozen=True, slots=True)
class Grant:
    """What a token allows.

    Attributes
    ----------
    role
        Which page it opens.
    person
        The participant it is for, e.g. P0001; None for anyone with the link.
    nonce
        Names the token, so that it can be revoked.
    """

    role: Role
    person: str | None
    nonce: str


class Tokens:
    """Issues and checks tokens.

    Parameters
    ----------
    secret
        At least 16 bytes; anyone who has it can issue tokens.
    revoked
        Names of the tokens that allow nothing any more.

    Examples
    --------
    >>> tokens = Tokens(b"a secret of at least 16 bytes")
    >>> tokens.read(tokens.issue("participant", "P0001")).person
    'P0001'
    >>> tokens.read("d.P0001.AAAA.forged") is None
    True
    >>> before = tokens.link("demonstrator")
    >>> tokens.revoke(tokens.read(before).nonce)
    >>> tokens.read(before) is None, tokens.read(tokens.link("demonstrator")).nonce
    (True, 'link-demonstrator-2')
    """

    def __init__(self, secret: bytes, revoked: Iterable[str] = ()) -> None:
        if len(secret) < 16:
            raise ValueError("a secret needs at least 16 bytes")
        self._secret = secret
        self._revoked = set(revoked)

    def issue(self, role: Role, person: str | None = None, nonce: str | None = None) -> str:
        """Return a token; the same nonce gives the same token."""
        text = f"{LETTERS[role]}.{person or ''}.{nonce or secrets.token_urlsafe(9)}"
        return f"{text}.{self._signature(text)}"

    def link(self, role: Role) -> str:
        """Return the token of a role's printed link: the first that was not revoked."""
        names = (f"link-{role}" + (f"-{n}" if n > 1 else "") for n in itertools.count(1))
        return self.issue(role, nonce=next(name for name in names if name not in self._revoked))

    def read(self, token: str) -> Grant | None:
        """Return what a token allows; None for one that is forged, damaged or revoked."""
        text, _, signature = token.rpartition(".")
        if not hmac.compare_digest(self._signature(text).encode(), signature.encode()):
            return None
        letter, person, nonce = text.split(".")
        if nonce in self._revoked:
            return None
        return Grant(ROLES[letter], person or None, nonce)

    def revoke(self, nonce: str) -> None:
        """Have a token, and every copy of it, allow nothing any more."""
        self._revoked.add(nonce)

    @property
    def revoked(self) -> tuple[str, ...]:
        """Names of the tokens that allow nothing any more, sorted."""
        return tuple(sorted(self._revoked))

    def _signature(self, text: str) -> str:
        digest = hmac.new(self._secret, text.encode("utf-8", "replace"), hashlib.sha256).digest()
        return base64.urlsafe_b64encode(digest[:18]).decode()
