"""In which order laps were driven: from the record, not from the plan."""

from collections import Counter

from analysis.frames import StudyFrames, as_frame, practised

Order = tuple[str, ...]

_PRACTICE = " (practice)"


def driven_orders(frames: StudyFrames) -> Counter[Order]:
    """Return how many analysed participants drove which laps, practice marked as such, in order.

    A participant who left out laps of another's order has not driven another one: who left counts
    with the order that was given, where that is recorded. Laps of
    conditions that the study does not have are left out: they are named elsewhere.
    """
    laps = as_frame(frames.study.laps)
    known = laps["condition"].isin(list(frames.study.protocol.conditions))
    laps = laps[laps["participant"].isin(frames.participants["participant"]) & known]
    marks = practised(laps).map({True: _PRACTICE, False: ""})
    laps = laps.assign(driven=laps["condition"] + marks).sort_values("lap")
    own = {str(who): tuple(of["driven"]) for who, of in laps.groupby("participant", sort=True)}
    given = _given(frames)
    orders = Counter(own.values())
    whole: Counter[Order] = Counter()
    for who, order in sorted(own.items(), key=lambda one: (-len(one[1]), -orders[one[1]])):
        longer = [other for other in whole if part_of(order, other)]
        meant = [other for other in longer if _analysed(other) == given.get(who)] or longer
        whole[max(meant, key=lambda other: orders[other]) if meant else order] += 1
    return whole


def _given(frames: StudyFrames) -> dict[str, str]:
    """Return the order that each participant was given, where it is recorded."""
    people = frames.participants
    if "order" not in people:
        return {}
    recorded = people.dropna(subset=["order"])
    return dict(zip(recorded["participant"], recorded["order"], strict=True))


def _analysed(order: Order) -> str:
    return " > ".join(lap for lap in order if not lap.endswith(_PRACTICE))


def part_of(order: Order, whole: Order) -> bool:
    """Tell whether an order is another one with laps left out.

    Examples
    --------
    >>> part_of(("a", "c"), ("a", "b", "c")), part_of(("c", "a"), ("a", "b", "c"))
    (True, False)
    """
    left = iter(whole)
    return all(condition in left for condition in order)
