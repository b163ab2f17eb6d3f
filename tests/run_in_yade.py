# SPDX-License-Identifier: GPL-2.0-or-later
"""Run pytest inside a YADE process and leave with pytest's exit code.

usage: PYTHONPATH=build/python yade -n -x [-j2] tests/run_in_yade.py -- [pytest arguments]
       PYTHONPATH=build/python python3 tests/run_in_yade.py [-j2] -- [pytest arguments]

Called by a plain Python, the script starts YADE itself and drops the lines of YADE's banner, which
are printed before any script is reached; called by YADE it runs pytest at once. In both cases the
last line printed is pytest's own.
"""
from __future__ import annotations

import os
import re
import subprocess
import sys

BANNER = re.compile(
    r"^(Welcome to Yade|Using python version|TCP python prompt|XMLRPC info provider|Running script|"
    r"Warning: no X rendering)"
)


def run_pytest(arguments: list[str]) -> None:
    """Run pytest in this process; does not return.

    The interpreter is left at once: a thread of YADE's remote server, or a destructor run while the
    interpreter is taken down, may neither print after pytest's last line nor change the exit code.
    """
    import pytest

    code = int(pytest.main(arguments))
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(code)


def run_yade(yade_options: list[str], pytest_arguments: list[str]) -> int:
    """Start YADE on this file, pass its output on without the banner, return its exit code."""
    command = [
        "yade",
        "-n",
        "-x",
        *yade_options,
        os.path.abspath(__file__),
        "--",
        *pytest_arguments,
    ]
    # Threads of small scenes mostly wait for each other; spinning would starve them on a shared core.
    environment = {"OMP_WAIT_POLICY": "passive", **os.environ}
    process = subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=environment
    )
    in_banner = True
    for line in process.stdout:
        in_banner = in_banner and BANNER.match(line) is not None
        if not in_banner:
            print(line, end="", flush=True)
    return process.wait()


def split_at_dashes(arguments: list[str]) -> tuple[list[str], list[str]]:
    """Return what stands before and after the first ``--``; without one all is for pytest."""
    if "--" not in arguments:
        return [], arguments
    at = arguments.index("--")
    return arguments[:at], arguments[at + 1 :]


if __name__ == "__main__":
    before, after = split_at_dashes(sys.argv[1:])
    if hasattr(sys, "yade_argv"):  # set by YADE's start script, which also swallows the first "--"
        run_pytest(before + after)
    else:
        sys.exit(run_yade(before, after))
