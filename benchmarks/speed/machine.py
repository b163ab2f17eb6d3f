# SPDX-License-Identifier: GPL-2.0-or-later
"""Which machine it is, and how much of it others use while we measure."""
from __future__ import annotations

import os
import platform
import resource
import time


def description() -> dict[str, str | int]:
    """Processor, cores, system."""
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        models = [line.split(":", 1)[1].strip() for line in file if line.startswith("model name")]
    return {
        "processor": models[0] if models else platform.machine(),
        "cores": os.cpu_count() or 1,
        "system": platform.platform(),
        "date": time.strftime("%Y-%m-%d"),
    }


class OthersWatch:
    """Mean number of processors that programs other than ours (and our ended children) keep busy."""

    def __init__(self) -> None:
        self._tick = os.sysconf("SC_CLK_TCK")
        self._time, self._all, self._ours = time.monotonic(), self._busy(), self._own()

    def busy(self) -> float:
        """Processors busy with others' work since the start, or the last call."""
        now, everything, ours = time.monotonic(), self._busy(), self._own()
        others = (everything - self._all) - (ours - self._ours)
        mean = others / max(now - self._time, 1e-9)
        self._time, self._all, self._ours = now, everything, ours
        return max(0.0, mean)

    def _busy(self) -> float:
        """Processor time of all programs since the system started [s]; stolen time counts as others'."""
        with open("/proc/stat", encoding="ascii") as file:
            user, nice, system, _, _, irq, softirq, steal = map(int, file.readline().split()[1:9])
        return (user + nice + system + irq + softirq + steal) / self._tick

    @staticmethod
    def _own() -> float:
        total = 0.0
        for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN):
            used = resource.getrusage(who)
            total += used.ru_utime + used.ru_stime
        return total
