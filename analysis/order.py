"""In which order laps were driven: from the record, not from the plan."""

from collections import Counter

from analysis.frames import StudyFrames, as_frame, practised

Order = tuple[str, ...]


def driven_orders(frames: StudyFrames) -> Counter[Order]:
    """Return how many analysed participants drove which laps, practice marked as such, in order.

    A participant who left out laps of another's order has not driven another one. Laps of
    conditions that the study does not have are left out: they are named elsewhere.
    """
    laps = as_frame(frames.study.laps)
    known = laps["condition"].isin(list(frames.study.protocol.conditions))
    laps = laps[laps["participant"].isin(frames.participants["participant"]) & known]
    marks = practised(laps).map({True: " (practice)", False: ""})
    laps = laps.assign(driven=laps["condition"] + marks).sort_values("lap")
    orders = Counter(tuple(own["driven"]) for _, own in laps.groupby("participant", sort=True))
    whole: Counter[Order] = Counter()
    for order, people in sorted(orders.items(), key=lambda found: (-len(found[0]), -found[1])):
        longer = [other for other in whole if part_of(order, other)]
        whole[max(longer, key=lambda other: orders[other]) if longer else order] += people
    return whole


def part_of(order: Order, whole: Order) -> bool:
    """Tell whether an order is another one with laps left out.

    Examples
    --------
    >>> part_of(("a", "c"), ("a", "b", "c")), part_of(("c", "a"), ("a", "b", "c"))
    (True, False)
    """
    left = iter(whole)
    return all(condition in left for condition in order)
