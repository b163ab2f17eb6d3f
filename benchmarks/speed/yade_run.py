# SPDX-License-Identifier: GPL-2.0-or-later
"""Step a bed in YADE and time it: yade -j1 -n -x benchmarks/speed/yade_run.py <options of `speed.yade_scene`>.

Started by the benchmark, once a sample. Needs the folder `benchmarks` on PYTHONPATH.
"""
import sys

from speed.yade_scene import main

main(sys.argv[1:])
