// SPDX-License-Identifier: GPL-2.0-or-later
#include "sample_classes.hpp"

namespace yade {

YADE_PLUGIN((AbiSample));
CREATE_LOGGER(AbiSample);

void AbiSample::pyHandleCustomCtorArgs(boost::python::tuple& args, boost::python::dict& keywords) {
    if (boost::python::len(args) != 1)
        return;
    keywords["number"] = args[0];
    args = boost::python::tuple();
}

void AbiSample::warn(const std::string& message) {
    LOG_WARN(message);
}

} // namespace yade
