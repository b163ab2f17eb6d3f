# SPDX-License-Identifier: GPL-2.0-or-later
"""A scenario under yade-batch: its options are the columns of the parameter table."""
from __future__ import annotations

import os
import re
from collections.abc import Iterable

from yade import O, params, utils


def batch_row(names: Iterable[str]) -> dict[str, object]:
    """The row of the batch's table that this process runs; each row gets its own folder.

    Parameters
    ----------
    names : iterable of str
        Parameters that the table may have as columns.

    Returns
    -------
    dict
        Those that it has, and ``output``.
    """
    utils.readParamsFromTable(noTableOk=False, **{name: None for name in names})
    row = {name: getattr(params.table, name) for name in names}
    given = {name: value for name, value in row.items() if value is not None}
    row_name = re.sub(r"[^\w.=-]+", "_", str(O.tags["description"])).strip("_")
    given.setdefault("output", os.path.join("results", row_name or O.tags["id"]))
    return given
