// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: the std and boost names that YADE code uses unqualified inside namespace yade; shared_ptr is
// boost::shared_ptr; mask_t is int (no arbitrary masks in the Debian build); cast macros do no checking.
// Verified: mangled names of exported functions (boost::shared_ptr, Body::maskOk(int)).
#pragma once

// Boost.Python 1.74 itself leans on what Boost deprecates; without these two every file prints its notes.
#ifndef BOOST_BIND_GLOBAL_PLACEHOLDERS
#define BOOST_BIND_GLOBAL_PLACEHOLDERS
#endif
#ifndef BOOST_ALLOW_DEPRECATED_HEADERS
#define BOOST_ALLOW_DEPRECATED_HEADERS
#endif
#include <boost/python.hpp>

#include <lib/base/AliasNamespaces.hpp>
#include <lib/high-precision/Real.hpp>

#include <boost/shared_ptr.hpp>
#include <iostream>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#ifndef YADE_PTR_CAST
#define YADE_PTR_CAST ::boost::static_pointer_cast
#endif
#ifndef YADE_CAST
#define YADE_CAST static_cast
#endif
#ifndef YADE_PTR_DYN_CAST
#define YADE_PTR_DYN_CAST ::boost::dynamic_pointer_cast
#endif

namespace yade {

using boost::shared_ptr;
using std::cerr;
using std::cout;
using std::endl;
using std::invalid_argument;
using std::logic_error;
using std::make_pair;
using std::pair;
using std::runtime_error;
using std::string;
using std::swap;
using std::vector;

using mask_t = int;

const Real NaN = std::numeric_limits<Real>::signaling_NaN();

/// Angle between two unit vectors.
template <typename Scalar>
Scalar unitVectorsAngle(const Vector3<Scalar>& a, const Vector3<Scalar>& b) {
    return std::acos(a.dot(b));
}

} // namespace yade
