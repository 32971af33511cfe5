"""Hold the model against reference vectors: ``python bench/conformance.py FILE.npz ...``.

Beside each ``NAME.npz`` lies a ``NAME.json`` with its hyperparameters; the format is described in
``tests/data/conformance/README.md``. Prints, per prefix, the largest differences and the number
of mismatched events, and ends with 1 when a tolerance is missed, 2 when a file cannot be read.
"""

import argparse
import json
import sys
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from lad.hyperparameters import GPHyperparameters
from lad.likelihood import probability_of_help
from lad.stork_gp import StorkGP
from lad.stream import Learning, learn_stream, predict_stream

Arrays = Mapping[str, np.ndarray]
FOR_COMPARISON_ONLY = "otlmatlab_"


@dataclass(frozen=True)
class Tolerance:
    """Largest absolute difference allowed; None for events that may differ."""

    mean: float
    variance: float
    events: int | None


TABLE = {
    "A": Tolerance(1e-8, 1e-9, events=0),
    "B": Tolerance(1e-6, 1e-7, events=0),
    "B3": Tolerance(1e-2, 1e-3, events=None),
    "C": Tolerance(1e-6, 1e-7, events=0),
}


@dataclass(frozen=True)
class Differences:
    """What one prefix of a file differs by: maxima of absolute differences, and counts."""

    mean: float
    variance: float
    probability: float
    novelty: float
    events: int
    deletions: int
    sizes: int
    basis: int

    def missed(self, tolerance: Tolerance) -> list[str]:
        """Name what is out of tolerance; NaN is."""
        names = []
        if not max(self.mean, self.probability) <= tolerance.mean:
            names.append("mean")
        if not self.variance <= tolerance.variance:
            names.append("variance")
        wrong = self.events + self.deletions + self.sizes + self.basis
        if tolerance.events is not None and wrong > tolerance.events:
            names.append("events")
        return names


class UnreadableVectorsError(ValueError):
    """A file that is not in the format of the reference vectors."""


def tolerance_of(name: str) -> Tolerance:
    """Choose the row of the table: by the name's beginning, its longest match first."""
    for key in sorted(TABLE, key=len, reverse=True):
        if name.startswith(key):
            return TABLE[key]
    raise UnreadableVectorsError(f"{name}: allowed are names that begin with A, B or C")


def prefixes(arrays: Arrays) -> Iterator[str]:
    """Name the runs a file holds: '' or such as 'cap400_'."""
    for key in arrays:
        prefix = key.removesuffix("mean")
        if prefix != key and (not prefix or prefix.endswith("_")) and prefix + "var" in arrays:
            yield prefix


def hyperparameters(header: Mapping[str, Any], prefix: str) -> GPHyperparameters:
    """Read one run's hyperparameters in the paper's notation: one set, or one per prefix."""
    hyper = header["hyper"]
    paper = (hyper if "paper" in hyper else hyper[prefix.rstrip("_")])["paper"]
    return GPHyperparameters(
        lengthscales=paper["lengthscales"],
        noise_variance=paper["noise_variance"],
        capacity=paper["capacity"],
        recursion_depth=paper["tau"],
        temporal_scale=paper["sigma_rho"],
        signal_variance=paper["signal_variance"],
        novelty=paper["novelty_threshold"],
    )


def largest(found: np.ndarray, wanted: np.ndarray) -> float:
    """Largest absolute difference."""
    return float(np.abs(np.asarray(found) - wanted.reshape(np.shape(found))).max())


def probabilities(learning: Learning, noise: float) -> np.ndarray:
    """Probability of +1 before each step was learnt."""
    before = learning.predictions
    pairs = zip(before.mean[:, 0], before.latent_variance, strict=True)
    return np.array([probability_of_help(mean, latent, noise) for mean, latent in pairs])


def compare(
    arrays: Arrays, prefix: str, hyper: GPHyperparameters, model: Callable[..., Any] = StorkGP
) -> Differences:
    """Run one prefix of a file through a model and measure what differs."""
    probit = f"{prefix}prob" in arrays
    process = model(hyper, "probit" if probit else "gaussian", arrays["Y"].shape[1])
    wanted = {
        key.removeprefix(prefix): value for key, value in arrays.items() if key.startswith(prefix)
    }
    learning = learn_stream(process, arrays["X"], arrays["Y"])
    ids = process.times
    after = predict_stream(process, arrays["Xp"])
    before = learning.predictions
    return Differences(
        mean=max(largest(before.mean, wanted["mean"]), largest(after.mean, wanted["pmean"])),
        variance=max(
            largest(before.variance, wanted["var"]), largest(after.variance, wanted["pvar"])
        ),
        probability=largest(probabilities(learning, hyper.noise_variance), wanted["prob"])
        if probit
        else 0.0,
        novelty=largest(learning.novelty, wanted["gamma"]),
        events=int((learning.kind != wanted["event"]).sum()),
        deletions=int((learning.deleted_time != wanted["did"]).sum()),
        sizes=int((learning.n_basis != wanted["n"]).sum()),
        basis=len(set(ids.tolist()) ^ set(wanted["final_ids"].tolist())),
    )


def read(path: Path) -> tuple[dict[str, Any], dict[str, np.ndarray]]:
    """Read the JSON and the arrays of one set."""
    try:
        header = json.loads(path.with_suffix(".json").read_text())
        with np.load(path, allow_pickle=False) as archive:
            return header, {name: archive[name] for name in archive.files}
    except Exception as error:
        raise UnreadableVectorsError(f"{path}: cannot be read ({error})") from error


def check(path: Path) -> bool:
    """Check one file, print its lines, and return whether all comparisons hold."""
    tolerance = tolerance_of(path.name)
    header, arrays = read(path)
    runs = [prefix for prefix in prefixes(arrays) if prefix != FOR_COMPARISON_ONLY]
    if not runs:
        raise UnreadableVectorsError(
            f"{path}: holds no run; wanted are arrays such as mean and var"
        )
    good = True
    for prefix in runs:
        try:
            found = compare(arrays, prefix, hyperparameters(header, prefix))
        except (KeyError, IndexError, ValueError) as error:
            raise UnreadableVectorsError(f"{path}, {prefix or 'no prefix'}: {error!r}") from error
        missed = found.missed(tolerance)
        good = good and not missed
        allowed = "exact" if tolerance.events is not None else "may differ"
        print(
            f"{path.stem:<22} {prefix.rstrip('_') or '-':<9}"
            f" mean {found.mean:.1e} (<= {tolerance.mean:.0e})"
            f"  variance {found.variance:.1e} (<= {tolerance.variance:.0e})"
            f"  probability {found.probability:.1e}  novelty {found.novelty:.1e}"
            f"  mismatched events {found.events}, deletions {found.deletions},"
            f" sizes {found.sizes}, final basis vectors {found.basis} ({allowed})"
            f"  {'MISSED: ' + ', '.join(missed) if missed else 'met'}"
        )
    return good


def main(arguments: list[str] | None = None) -> int:
    """Check every file named on the command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("files", nargs="+", type=Path, metavar="FILE.npz")
    results = []
    for path in parser.parse_args(arguments).files:
        try:
            results.append(check(path))
        except UnreadableVectorsError as error:
            print(error, file=sys.stderr)
            return 2
    return 0 if all(results) else 1


if __name__ == "__main__":
    sys.exit(main())
