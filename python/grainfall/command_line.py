# SPDX-License-Identifier: GPL-2.0-or-later
"""What every scenario script does around its run: read options or a row of a batch, run, say how it went."""
from __future__ import annotations

import os
import sys
from collections.abc import Callable
from typing import Any

from yade import utils

from grainfall.batch import batch_row
from grainfall.options import OptionTable

#: Exit codes: a value or a state that cannot be used; stopped by Ctrl-C (128 + SIGINT).
REFUSED, STOPPED = 2, 130


def run_script(
    table: OptionTable, description: str, epilog: str, run: Callable[..., Any], stopped: str
) -> None:
    """Run a scenario with the options of the command line or of the batch's row; end the process if it did not finish.

    Parameters
    ----------
    table : OptionTable
        The scenario's options; its `prog` heads the messages.
    description, epilog : str
        Around the options in the help.
    run : callable
        Takes the options given as keywords. A returned dictionary with a true ``interrupted`` counts as stopped.
    stopped : str
        What to say where Ctrl-C has left no results.
    """
    exit_code = _run(table, description, epilog, run, stopped)
    if exit_code:
        # At once: taking down YADE's threads could change the code.
        sys.stdout.flush()
        os._exit(exit_code)


def _run(
    table: OptionTable, description: str, epilog: str, run: Callable[..., Any], stopped: str
) -> int:
    """As `run_script`; the exit code."""
    parser = table.parser(description, epilog)
    try:
        if utils.runningInBatch():
            given = batch_row(table.by_name)
        else:
            given = vars(parser.parse_args(sys.argv[1:]))
        result = run(**given)
    except ValueError as error:
        print(f"{table.prog}: error: {error}", file=sys.stderr)
        return REFUSED
    except KeyboardInterrupt:
        print(f"{table.prog}: {stopped}", file=sys.stderr)
        return STOPPED
    interrupted = isinstance(result, dict) and result.get("interrupted")
    return STOPPED if interrupted else 0
