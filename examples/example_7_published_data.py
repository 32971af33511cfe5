"""
Reanalysing a published within-subject data set
===============================================

For people who want to try the statistics on data that they can look up. The package ``pingouin``
ships ratings by Ryan, Wilde & Crist (2013): people said how much they would like to get rid of
insects that were more or less frightening, and more or less disgusting. Each of them rated every
kind: paired differences, like laps in two conditions.
"""

import matplotlib.pyplot as plt
import numpy as np
import pingouin

from analysis.stats.effect_size import cohen_dz
from analysis.stats.holm import holm
from analysis.stats.mean_difference import mean_difference
from analysis.stats.signed_rank import signed_rank
from analysis.stats.tost import paired_tost

# %%
# The data
# --------
#
# One row per rating, 0 to 10; some people left out a kind, and missing ratings stay missing.

data = pingouin.read_dataset("rm_anova")
kind = data.Frighteningness.str.lower() + " fear, " + data.Disgustingness.str.lower() + " disgust"
ratings = data.assign(kind=kind).pivot(index="Subject", columns="kind", values="DesireToKill")
print(ratings.describe().loc[["count", "mean", "std"]].round(2).to_string())

# %%
# Does fright matter, and disgust?
# --------------------------------
#
# Each main effect is a difference of two means per person. The Hodges-Lehmann estimate leads, as in
# the report of a study; p-values are Holm's.

fright = ratings[["high fear, high disgust", "high fear, low disgust"]].mean(axis=1, skipna=False)
fright -= ratings[["low fear, high disgust", "low fear, low disgust"]].mean(axis=1, skipna=False)
disgust = ratings[["high fear, high disgust", "low fear, high disgust"]].mean(axis=1, skipna=False)
disgust -= ratings[["high fear, low disgust", "low fear, low disgust"]].mean(axis=1, skipna=False)

tests = {"fright": signed_rank(fright), "disgust": signed_rank(disgust)}
adjusted = holm([test.p for test in tests.values()])
for (name, test), p in zip(tests.items(), adjusted, strict=True):
    print(f"{name}: {test.estimate:.2f} ({test.low:.2f} to {test.high:.2f}), "
          f"n = {test.n}, p = {p:.2g}")  # fmt: skip

# %%
# Beside another package
# ----------------------
#
# For two levels the F of a repeated-measures analysis of variance is the square of the paired t.
# ``pingouin`` computes the former, ``mean_difference`` the latter: they agree.

complete = data[data.Subject.isin(ratings.dropna().index)]
anova = pingouin.rm_anova(
    complete, dv="DesireToKill", within=["Frighteningness", "Disgustingness"], subject="Subject"
)
f = anova.set_index("Source")["F"]
for name, source in (("fright", "Frighteningness"), ("disgust", "Disgustingness")):
    t = mean_difference({"fright": fright, "disgust": disgust}[name]).statistic
    print(f"{name}: t squared {t**2:.4f}, F {f[source]:.4f}")
    assert np.isclose(t**2, f[source], rtol=1e-6)

# %%
# How large, and is one negligible?
# ---------------------------------
#
# An effect size with its interval, and a test of equivalence: could fright matter by less than half
# a point?

rng = np.random.default_rng(0)
for name, differences in (("fright", fright), ("disgust", disgust)):
    size = cohen_dz(differences, rng)
    same = paired_tost(differences, 0.5)
    print(f"{name}: dz = {size.estimate:.2f} ({size.low:.2f} to {size.high:.2f}), "
          f"within half a point: p = {same.p:.2g}")  # fmt: skip

figure, axes = plt.subplots(figsize=(6, 3.2), layout="constrained")
axes.hist(
    [fright.dropna(), disgust.dropna()], bins=np.arange(-5, 8, 1), label=["fright", "disgust"]
)
axes.axvline(0, color="0.5", linewidth=0.8)
axes.set(xlabel="difference of ratings", ylabel="people")
axes.legend(frameon=False)
