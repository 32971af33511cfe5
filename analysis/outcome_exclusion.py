"""What a rule does that excludes by the outcome itself: the declared results without it."""

from analysis.comparisons import PairedComparison, declared_comparisons
from analysis.frames import StudyFrames, excluded, refused, study_frames


def excluded_as_unfinished(frames: StudyFrames) -> tuple[str, ...]:
    """Return the participants that only the rule ``min_completed_laps`` excludes.

    Who does not finish laps is slow: leaving them out is leaving out an outcome.
    """
    rules = frames.study.protocol.exclusion
    if rules.min_completed_laps is None:
        return ()
    people = frames.everybody
    out = people[excluded(people) & ~refused(people)]
    laps = frames.study.laps.to_pandas()
    laps = laps[laps["participant"].isin(out["participant"])]
    collisions = laps.loc[~laps["practice"].fillna(value=False).astype(bool)]
    total = collisions.groupby("participant")["collisions"].sum()
    most = rules.max_collisions
    return tuple(
        who
        for who, why in zip(out["participant"], out["exclusion_reason"], strict=True)
        if isinstance(why, str)
        and why.startswith("completed ")
        and (most is None or total.get(who, 0) <= most)
    )


def without_the_rule(frames: StudyFrames) -> tuple[PairedComparison, ...]:
    """Return the declared comparisons without the rule ``min_completed_laps``.

    Empty where the rule excludes no one.
    """
    back = excluded_as_unfinished(frames)
    if not back:
        return ()
    return declared_comparisons(study_frames(frames.study, keep=back))
