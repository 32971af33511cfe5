"""CSV files for R."""

import re
import shutil
import subprocess

import pytest

R = shutil.which("Rscript")

CHECK = """
source("read.R")
for (name in c("participants", "laps", "surveys", "steps")) {
  data <- get(name)
  cat(name, nrow(data), sep = " ")
  cat("\\n")
  for (column in names(data)) {
    cat(name, column, class(data[[column]])[1], sum(is.na(data[[column]])), sep = " ")
    cat("\\n")
  }
}
options(digits = 17)
cat("sum", sum(steps$x_m), sum(laps$lap_time_s), laps$seed[1], attr(laps$lap_time_s, "unit"))
"""


@pytest.mark.skipif(R is None, reason="R is not installed")
def test_r_reads_classes_rows_and_values(exported, study, tmp_path):
    """Classes of the codebook, as many rows and gaps as recorded, and the same sums."""
    copied = shutil.copytree(exported("r"), tmp_path / "r")
    (copied / "check.R").write_text(CHECK)
    ended = subprocess.run(  # noqa: S603  # R itself
        [str(R), "check.R"], cwd=copied, capture_output=True, text=True, check=False
    )
    assert ended.returncode == 0, ended.stderr
    said = ended.stdout
    assert f"participants {len(study.participants)}\n" in said
    assert f"surveys {len(study.surveys)}\n" in said
    tables = [study.steps(lap["participant"], lap["lap"]) for lap in study.laps.to_pylist()]
    assert f"steps {sum(map(len, tables))}\n" in said
    assert "laps completed logical 0" in said
    assert "laps withdrawal" not in said
    assert f"laps basis_vectors_when integer {len(study.laps)}\n" in said
    gaps = sum(table["h"].null_count for table in tables)
    assert f"steps h integer {gaps}\n" in said
    assert "laps end_reason factor 0" in said
    x, time, seed, unit = re.search(r"sum (\S+) (\S+) (\d+) (\w+)", said).groups()
    assert float(x) == pytest.approx(sum(sum(t["x_m"].to_pylist()) for t in tables), abs=1e-9)
    assert float(time) == pytest.approx(sum(study.laps["lap_time_s"].to_pylist()), abs=1e-9)
    assert (int(seed), unit) == (study.laps["seed"][0].as_py(), "s")


def test_truth_and_gaps_are_written_as_r_writes_them(exported):
    """TRUE, FALSE and NA."""
    text = (exported("r") / "laps.csv").read_text()
    assert ",TRUE," in text
    assert ",NA," in text
    assert "true" not in text
