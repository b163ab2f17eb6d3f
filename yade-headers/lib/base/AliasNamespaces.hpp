// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: inside namespace yade, `py` means boost::python. Verified: it is how YADE's own classes spell it.
#pragma once

namespace boost::python {}

namespace yade {
namespace py = ::boost::python;
}
