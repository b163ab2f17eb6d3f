// SPDX-License-Identifier: GPL-2.0-or-later
#include <laws/yade/contact_kernels.hpp>

namespace yade {

const KernelTables& partial_slip_kernels() {
    return kernels::make_tables<grainfall::laws::PartialSlipTangential>();
}

} // namespace yade
