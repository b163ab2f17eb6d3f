// SPDX-License-Identifier: GPL-2.0-or-later
// Makes the classes of an extension known to the YADE that runs: inheritance database, class indices, Python.
#pragma once

#include <string>
#include <vector>

namespace grainfall {

/// Registers every class announced by YADE_PLUGIN since YADE started and not registered yet; returns their
/// names. Needs the interpreter lock. A class that cannot be made or shown to Python is an error naming it.
std::vector<std::string> register_new_classes();

} // namespace grainfall
