// SPDX-License-Identifier: GPL-2.0-or-later
#include <engines/flat/yade/flat_kernels.hpp>

namespace yade {

const FlatTables& frictionless_flat_kernels() {
    return flat::make_tables<grainfall::laws::NoTangential>();
}

} // namespace yade
