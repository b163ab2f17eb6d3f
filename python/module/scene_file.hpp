// SPDX-License-Identifier: GPL-2.0-or-later
// A copy of the scene in hand in a file.
#pragma once

#include <string>

namespace grainfall {

/// Writes what O.save(path) would, in YADE's binary format; unlike it, leaves O.filename as it is.
void write_scene(const std::string& path);

} // namespace grainfall
