"""CSV files for R, and a script that reads them with the right classes."""

from pathlib import Path

from analysis.export.content import Content
from analysis.export.csv_files import CsvFile, write_csv_files
from analysis.export.delimited import Dialect
from analysis.export.field import Field, Kind
from analysis.export.readme import write_about
from analysis.export.registry import Tell

SCRIPT_FILE = "read.R"

R = Dialect(missing="NA", true="TRUE", false="FALSE")
"""As ``read.csv`` reads it."""

_CLASSES: dict[Kind, str] = {
    "string": "character",
    "integer": "integer",
    "number": "numeric",
    "boolean": "logical",
}

_HOW = """\
In R, from this folder:

```r
source("read.R")
boxplot(lap_time_s ~ condition, data = laps[!laps$practice, ])
```

`read.R` gives every column the class of the codebook (left to itself, R makes a column without a
single value logical), columns with a list of allowed values become factors, and every column has
its unit in `attr(x, "unit")`. `seed` is text: R would round it.
"""


def write(content: Content, folder: Path, tell: Tell) -> None:
    """Write CSV files and ``read.R`` into an empty folder."""
    files = write_csv_files(content, folder, tell, R)
    (folder / SCRIPT_FILE).write_text(script(files), encoding="utf-8")
    write_about(content, folder, _HOW)


def script(files: tuple[CsvFile, ...]) -> str:
    """Return the text of ``read.R``: one data frame for each file, by its name."""
    return _HEAD + "\n".join(_read(file) for file in files)


_HEAD = """\
# Reads the tables of the study, each into a data frame of its name.
# Set `folder` first to read from another place than the working directory.
if (!exists("folder")) folder <- "."

described <- function(data, values, units) {
  for (name in names(values)) data[[name]] <- factor(data[[name]], levels = values[[name]])
  for (name in names(units)) attr(data[[name]], "unit") <- units[[name]]
  data
}

"""


def _read(file: CsvFile) -> str:
    classes = ",\n    ".join(f'{f.name} = "{_CLASSES[f.kind]}"' for f in file.fields)
    factors = {f.name: f for f in file.fields if f.values and f.kind == "string"}
    values = ",\n    ".join(f"{name} = c({_quoted(f)})" for name, f in factors.items())
    units = ",\n    ".join(f'{f.name} = "{f.unit}"' for f in file.fields if f.unit)
    return f"""\
# {file.description}
{file.name} <- described(
  read.csv(file.path(folder, "{file.path}"), na.strings = "NA", encoding = "UTF-8", colClasses = c(
    {classes}
  )),
  values = list({values}),
  units = list({units})
)
"""


def _quoted(field: Field) -> str:
    return ", ".join(f'"{value}"' for value in field.values)
