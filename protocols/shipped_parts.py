"""Parts that ship, by the name a protocol gives them, and where their factory is.

The one list of names: protocol files are checked against it, and parts are made from it.
"""

from collections.abc import Mapping

DRIVERS: Mapping[str, str] = {
    "human": "participants.human.driver:human_driver",
    "autonomous": "participants.autonomous:autonomous_driver",
    "scripted": "participants.scripted:scripted_driver",
}
IMPAIRMENTS: Mapping[str, str] = {
    "tremor": "participants.impairments.tremor:tremor",
    "weakness": "participants.impairments.weakness:weakness",
    "spasticity": "participants.impairments.spasticity:spasticity",
    "bias": "participants.impairments.bias:bias",
    "delay": "participants.impairments.delay:delay",
}
DEMONSTRATORS: Mapping[str, str] = {"attentive": "participants.attentive:attentive_demonstrator"}
RESPONDENTS: Mapping[str, str] = {"ordinal": "participants.respondent:ordinal_respondent"}
MODELS: Mapping[str, str] = {
    "lad": "lad.lad_assistant:LADAssistant",
    "lad-correction": "lad.correction:CorrectionAssistant",
}
"""Made from the protocol's parameters of the model."""

PORTABLE_OPTIONS: Mapping[str, str] = {"scripted": "participants.scripted:portable_options"}
"""For drivers whose options name a file: a function of options and folder that reads it."""
