"""A frame as the content of a CSV file."""

import pandas as pd

from protocols.files.csv_text import harmless


def csv_file(frame: pd.DataFrame) -> bytes:
    """Return a frame as CSV with full precision, its text harmless in a spreadsheet.

    Missing values are empty cells.
    """
    written = frame.copy(deep=False)
    for place, dtype in enumerate(written.dtypes):
        if not pd.api.types.is_numeric_dtype(dtype):
            cells = written.iloc[:, place]
            written.isetitem(
                place, cells.astype(object).map(harmless, na_action="ignore").to_numpy()
            )
    written.columns = pd.Index([harmless(name) for name in frame.columns])
    return written.to_csv(index=False, lineterminator="\n").encode()
