"""What was registered, and what was done."""

from analysis.registration import Registered
from analysis.report.blocks import Block, Caution, Paragraph, Remarks, Section, Shown, table
from analysis.report.numbers import plural
from analysis.results import StudyResults


def registration_section(results: StudyResults) -> Section | None:
    """Return the comparison with the registration; None for a study without one."""
    found = results.registered
    if found is None:
        return None
    blocks: list[Block] = [Paragraph(said_of(found))]
    if found.fault is not None:
        blocks.append(Caution(f"The registration cannot be read: {found.fault}."))
    if len(found.table):
        caption = "What was registered, and what was done."
        blocks.append(table("registration", caption, found.table, _COLUMNS))
    if found.amendments:
        blocks.append(Remarks(found.amendments))
    blocks.append(Paragraph("Every other test on this page is exploratory."))
    return Section("registration", "Registration", tuple(blocks))


def said_of(found: Registered) -> str:
    """Return the sentence of the first screen."""
    if found.fault is not None:
        return f"The study follows the registration {found.digest[:12]}, which cannot be verified."
    kept = (
        "every part was kept"
        if not found.deviations
        else f"{plural(found.deviations, 'part')} deviated"
    )
    amended = f", {plural(len(found.amendments), 'amendment')}" if found.amendments else ""
    if found.before:
        amended += f", {found.before} of {plural(found.recorded, 'session')} before the last one"
    return f"Registered {found.date} (plan {found.digest[:12]}){amended}: {kept}."


_COLUMNS = [
    Shown("part", lambda r: r["part"], words=True),
    Shown("registered", lambda r: r["registered"], words=True),
    Shown("done", lambda r: r["done"], words=True),
    Shown("", lambda r: r["kept"], words=True),
]
