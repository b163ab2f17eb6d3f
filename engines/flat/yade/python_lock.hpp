// SPDX-License-Identifier: GPL-2.0-or-later
// Holds Python's lock while engines, which run without it, ask Python something.
#pragma once

#include <boost/python/detail/wrap_python.hpp>

namespace yade {

class PythonLock {
public:
    PythonLock() : state_(PyGILState_Ensure()) {}
    ~PythonLock() { PyGILState_Release(state_); }
    PythonLock(const PythonLock&) = delete;

private:
    PyGILState_STATE state_;
};

} // namespace yade
