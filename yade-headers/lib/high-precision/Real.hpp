// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: in the double build Real is plain double (mangled `d`), and namespace yade::math holds the
// elementary functions. Verified: mangled names of exported functions, such as ScGeom::getIncidentVel.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace yade {

using Real = double;

namespace math {
using std::abs;
using std::acos;
using std::asin;
using std::atan;
using std::atan2;
using std::cbrt;
using std::ceil;
using std::cos;
using std::exp;
using std::floor;
using std::fmod;
using std::hypot;
using std::isfinite;
using std::isinf;
using std::isnan;
using std::log;
using std::log10;
using std::max;
using std::min;
using std::pow;
using std::round;
using std::sin;
using std::sqrt;
using std::tan;
using std::tanh;
} // namespace math

} // namespace yade

#include <lib/high-precision/MathEigenTypes.hpp>
