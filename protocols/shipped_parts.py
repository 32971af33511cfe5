"""Parts that ship, by the name a protocol gives them, and where their factory is.

The one list of names: protocol files are checked against it, and parts are made from it.
"""

from collections.abc import Mapping
from typing import Literal

LIVE = "live"
"""A living person, in any role; they need a browser."""

DRIVERS: Mapping[str, str] = {
    "human": "participants.human.driver:human_driver",
    "autonomous": "participants.autonomous:autonomous_driver",
    "scripted": "participants.scripted:scripted_driver",
    LIVE: "participants.live.driver:live_driver",
}
IMPAIRMENTS: Mapping[str, str] = {
    "tremor": "participants.impairments.tremor:tremor",
    "weakness": "participants.impairments.weakness:weakness",
    "spasticity": "participants.impairments.spasticity:spasticity",
    "bias": "participants.impairments.bias:bias",
    "delay": "participants.impairments.delay:delay",
}
DEMONSTRATORS: Mapping[str, str] = {
    "attentive": "participants.attentive:attentive_demonstrator",
    LIVE: "participants.live.demonstrator:live_demonstrator",
}
RESPONDENTS: Mapping[str, str] = {
    "ordinal": "participants.respondent:ordinal_respondent",
    LIVE: "participants.live.pages:live_respondent",
}
LAD, CORRECTION, LEVEL = "lad", "lad-correction", "lad-level"
"""The model of the paper; one that learns corrections of the user's command; that and a level."""

WITH_PARAMETERS = (LAD, CORRECTION, LEVEL)
"""Models that take ``parameters``; every other model takes ``options``."""

MODELS: Mapping[str, str] = {
    LAD: "lad.lad_assistant:LADAssistant",
    CORRECTION: "lad.correction:CorrectionAssistant",
    LEVEL: "lad.level:LevelAssistant",
    "taught": "lad.trained:load",
    "linear": "lad.baselines.linear:make",
    "neighbours": "lad.baselines.neighbours:make",
    "network": "lad.baselines.network:make",
    "network-refitted": "lad.baselines.network:make_refitted",
    "memoryless": "lad.baselines.memoryless:make",
}

Role = Literal["driver", "impairment", "demonstrator", "respondent", "model"]

SHIPPED: Mapping[Role, Mapping[str, str]] = {
    "driver": DRIVERS,
    "impairment": IMPAIRMENTS,
    "demonstrator": DEMONSTRATORS,
    "respondent": RESPONDENTS,
    "model": MODELS,
}
"""The names of each role's parts."""

PORTABLE_OPTIONS: Mapping[str, str] = {"scripted": "participants.scripted:portable_options"}
"""For drivers whose options name a file: a function of options and folder that reads it."""


def shipped_factory(role: Role, use: str) -> str | None:
    """Return ``module:factory`` of a shipped part; None for what does not ship.

    Protocols of earlier versions name our simpler models by the place of their factory: that
    closed list stays known, so that their studies are what they were.

    Examples
    --------
    >>> shipped_factory("model", "linear")
    'lad.baselines.linear:make'
    >>> shipped_factory("model", "lad.baselines.linear:make")
    'lad.baselines.linear:make'
    >>> shipped_factory("model", "subprocess:run") is None
    True
    """
    factories = SHIPPED[role]
    if use in factories:
        return factories[use]
    formerly = {factory for name, factory in MODELS.items() if name != LAD}
    return use if role == "model" and use in formerly else None
