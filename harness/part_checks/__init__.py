"""Put a part through what a study will ask of it, before it is used in one.

One function for each role, for people's own tests:

>>> from harness.part_checks import check_driver
>>> report = check_driver("gentle:gentle", {"share": 0.8})  # doctest: +SKIP
>>> assert report.passed, report  # doctest: +SKIP

``lad-study check-part`` prints the same report.
"""

from collections.abc import Callable, Mapping

from harness.part_checks.assistant import check_assistant
from harness.part_checks.demonstrator import check_demonstrator
from harness.part_checks.driver import check_driver
from harness.part_checks.impairment import check_impairment
from harness.part_checks.respondent import check_respondent
from harness.part_checks.result import CheckResult, PartReport
from harness.part_checks.setting import Setting
from harness.part_checks.world import check_world

CHECKS: Mapping[str, Callable[..., PartReport]] = {
    "driver": check_driver,
    "assistant": check_assistant,
    "demonstrator": check_demonstrator,
    "respondent": check_respondent,
    "impairment": check_impairment,
    "world": check_world,
}
"""The check of each role."""

__all__ = [
    "CHECKS",
    "CheckResult",
    "PartReport",
    "Setting",
    "check_assistant",
    "check_demonstrator",
    "check_driver",
    "check_impairment",
    "check_respondent",
    "check_world",
]
