#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Installs, from Debian 12's own archive, what Grainfall needs to build, run and be tested.
# usage: tools/install-dependencies.sh [--check]     --check: only list what is missing (exit 1 if anything is)
set -euo pipefail

run_packages=(yade python3-numpy python3-scipy python3-matplotlib python3-h5py python3-tqdm python3-meshio)
build_packages=(g++ cmake ninja-build make git libeigen3-dev libboost-python-dev libboost-serialization-dev
                libboost-log-dev libboost-thread-dev libboost-system-dev libboost-filesystem-dev
                libboost-iostreams-dev python3-dev pybind11-dev libdeal.ii-dev liblapack-dev libblas-dev libopenblas0-pthread)
test_packages=(libgtest-dev python3-pytest python3-pyelftools python3-vtk9 valgrind clang-format black flake8 chromium)

if [ -r /etc/os-release ] && ! grep -q 'VERSION_ID="12"' /etc/os-release; then
    echo "warning: Grainfall is verified on Debian 12 only; this is $(. /etc/os-release && echo "$PRETTY_NAME")" >&2
fi

missing=()
for package in "${run_packages[@]}" "${build_packages[@]}" "${test_packages[@]}"; do
    dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q '^install ok installed$' || missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then exit 0; fi
if [ "${1:-}" = "--check" ]; then
    echo "missing: ${missing[*]}"
    exit 1
fi

as_root=()
if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || { echo "installing ${missing[*]} needs root: run as root or install sudo" >&2; exit 1; }
    as_root=(sudo)
fi
echo "installing: ${missing[*]}"
"${as_root[@]}" apt-get update -q
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends "${missing[@]}"
