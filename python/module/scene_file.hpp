// SPDX-License-Identifier: GPL-2.0-or-later
// A copy of the scene in hand in a file.
#pragma once

#include <string>
#include <vector>

namespace grainfall {

/// Writes what O.save(path) would, in YADE's binary format, but for the engines of these classes. Unlike
/// O.save it leaves O.filename as it is, and engines that are left out do not know of it.
void write_scene(const std::string& path, const std::vector<std::string>& left_out);

} // namespace grainfall
