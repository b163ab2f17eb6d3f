// SPDX-License-Identifier: GPL-2.0-or-later
// Elastic tangential displacement over the contact's face, kept as a few straight pieces.
//
// The contact is a row of independent springs (laws/partial_slip.hpp). The spring that touches first at the
// overlap y = s^2 stands at s on both sides of the centre, s in m^0.5, with ds as its share of the contact;
// tau(y) is how far it is stretched, in m, in the direction of the force. A piece is linear in y:
//
//   tau(y) = mean + slope (y - centre),   centre = mean of y over the piece
//
// so that  integral tau ds = mean width  and  integral tau^2 ds = mean^2 width + slope^2 spread, all weighted
// with ds. Pieces of one loop of Mindlin and Deresiewicz are straight; those of a path along which the
// direction or the ratio of shear to approach changes are not, and each step adds one. So neighbours are
// joined into their best straight line, which keeps the force to rounding and can only lower the energy.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>

namespace grainfall::laws {

// Vector in the plane of the contact.
using Planar = Eigen::Matrix<double, 2, 1, Eigen::DontAlign>;

// The part of the contact between the roots `from` and `to` of the overlap.
struct SlipStretch {
    double width;  // m^0.5
    double centre; // m
    double spread; // m^2.5, integral of (y - centre)^2 ds

    // Named, or -frounding-math has them computed every time.
    static constexpr double third = 1.0 / 3, forty_fifth = 1.0 / 45;

    SlipStretch() = default;
    SlipStretch(double from, double to)
        : width(to - from), centre(third * (from * from + from * to + to * to)),
          spread(forty_fifth * width * width * width * (4 * from * from + 7 * from * to + 4 * to * to)) {}
};

struct SlipPiece {
    Planar mean;     // m
    Planar slope;    // -
    double end;      // m^0.5; the piece begins where the one before it ends, the first at 0
    double residual; // m^2.5, integral of (what was joined into it - piece)^2
    // m^2.5, the residual if it were joined with the next piece outwards; negative: not known. Equal shifts
    // of both do not change it.
    double joint_residual;
    SlipStretch stretch; // follows from the ends
};

// `count` pieces in a row, outwards, of `Capacity`. What lies beyond them is neither set nor copied.
template <int Capacity>
struct SlipPieces {
    int count = 0;
    std::array<SlipPiece, Capacity> piece;

    SlipPieces() = default;
    SlipPieces(const SlipPieces& other) { take(other); }
    SlipPieces& operator=(const SlipPieces& other) {
        take(other);
        return *this;
    }
    template <int Other>
    void take(const SlipPieces<Other>& other) {
        count = other.count;
        for (int i = 0; i < count; ++i)
            (*this)[i] = other[i];
    }

    SlipPiece& operator[](int i) { return piece[static_cast<std::size_t>(i)]; }
    const SlipPiece& operator[](int i) const { return piece[static_cast<std::size_t>(i)]; }
    double rim() const { return count > 0 ? (*this)[count - 1].end : 0.0; }

    void add(const SlipStretch& stretch, const Planar& mean, const Planar& slope, double end,
             double residual) {
        if (count > 0)
            (*this)[count - 1].joint_residual = -1;
        (*this)[count++] = {mean, slope, end, residual, -1, stretch};
    }
    // A piece of another row, shifted; with the one before it added likewise, their joint residual still
    // holds.
    void add_shifted(const SlipPiece& source, const Planar& mean) {
        (*this)[count] = source;
        (*this)[count++].mean = mean;
    }
    Planar integral() const {
        Planar sum = Planar::Zero();
        for (int i = 0; i < count; ++i)
            sum += (*this)[i].mean * (*this)[i].stretch.width;
        return sum;
    }
    // m^2.5; what the joining of pieces has given away is no longer in it.
    double integral_of_square() const {
        double sum = 0;
        for (int i = 0; i < count; ++i) {
            const SlipPiece& p = (*this)[i];
            sum += p.mean.squaredNorm() * p.stretch.width + p.slope.squaredNorm() * p.stretch.spread;
        }
        return sum;
    }
};

// The straight line nearest to two neighbours together. Its residual counts from what the pieces stood for
// before they were joined from others: projections onto lines nest.
inline double joint_residual(const SlipPiece& inner, const SlipPiece& outer) {
    const SlipStretch &one = inner.stretch, &two = outer.stretch;
    const double lever = one.width * two.width / (one.width + two.width);
    const double distance = two.centre - one.centre;
    const Planar rise = outer.mean - inner.mean;
    const double spread = one.spread + two.spread + lever * distance * distance;
    const double loss = one.spread * two.spread * (outer.slope - inner.slope).squaredNorm() +
                        lever * (one.spread * (rise - distance * inner.slope).squaredNorm() +
                                 two.spread * (rise - distance * outer.slope).squaredNorm());
    return inner.residual + outer.residual + loss / spread;
}

// `start` is where the inner one begins.
inline SlipPiece joined(const SlipPiece& inner, const SlipPiece& outer, double start) {
    const SlipStretch &one = inner.stretch, &two = outer.stretch;
    const double width = one.width + two.width;
    const double lever = one.width * two.width / width;
    const double distance = two.centre - one.centre;
    const Planar rise = outer.mean - inner.mean;
    SlipPiece result;
    result.mean = inner.mean + (two.width / width) * rise;
    result.slope = (one.spread * inner.slope + two.spread * outer.slope + (lever * distance) * rise) /
                   (one.spread + two.spread + lever * distance * distance);
    result.end = outer.end;
    result.residual = inner.joint_residual;
    result.joint_residual = -1;
    result.stretch = SlipStretch(start, outer.end);
    return result;
}

// Joins neighbours until `limit` pieces are left, each time those that lose least; before that, all that lose
// less than `negligible` (m^2.5).
template <int Capacity>
void join_pieces(SlipPieces<Capacity>& pieces, int limit, double negligible) {
    for (int i = 0; i + 1 < pieces.count; ++i) {
        if (pieces[i].joint_residual < 0)
            pieces[i].joint_residual = joint_residual(pieces[i], pieces[i + 1]);
    }
    while (pieces.count > 1) {
        int best = 0;
        for (int i = 1; i + 1 < pieces.count; ++i) {
            if (pieces[i].joint_residual < pieces[best].joint_residual)
                best = i;
        }
        if (pieces.count <= limit && !(pieces[best].joint_residual <= negligible))
            return;
        pieces[best] = joined(pieces[best], pieces[best + 1], best > 0 ? pieces[best - 1].end : 0.0);
        --pieces.count;
        for (int i = best + 1; i < pieces.count; ++i)
            pieces[i] = pieces[i + 1];
        if (best > 0)
            pieces[best - 1].joint_residual = joint_residual(pieces[best - 1], pieces[best]);
        if (best + 1 < pieces.count)
            pieces[best].joint_residual = joint_residual(pieces[best], pieces[best + 1]);
    }
}

// A straight line tau over y - centre.
struct SlipLine {
    double centre;
    Planar mean, slope;

    Planar at(double y) const { return mean + (y - centre) * slope; }
};

// Springs may hold up to  slope (depth - y): what Coulomb's law grants them, given as a displacement.
struct SlipLimit {
    double slope;      // -
    double depth;      // m, the overlap
    double negligible; // m^2.5, integral of an error squared that does not matter

    double at(double y) const { return slope * (depth - y); }
};

// Where a line meets the limit:  |tau|^2 - limit^2 = square z^2 + 2 half z + constant = 0,  z = y - centre.
struct SlipCrossing {
    double centre, square, half, constant, root;

    SlipCrossing(const SlipLine& line, const SlipLimit& limit) : centre(line.centre) {
        const double room = limit.depth - centre;
        const double limit_square = limit.slope * limit.slope;
        square = line.slope.squaredNorm() - limit_square;
        half = line.mean.dot(line.slope) + limit_square * room;
        constant = line.mean.squaredNorm() - limit_square * room * room;
        // half^2 - square * constant without the cancellation.
        const double cross = line.mean.x() * line.slope.y() - line.mean.y() * line.slope.x();
        root = std::sqrt(
            std::max(0.0, limit_square * (line.mean + room * line.slope).squaredNorm() - cross * cross));
    }
    // Going outwards, the depth y at which slip begins and the one at which it ends.
    double begin() const { return centre + (half > 0 ? -constant / (half + root) : (root - half) / square); }
    double finish() const { return centre + (half < 0 ? constant / (root - half) : -(half + root) / square); }
};

// Adds the stretch [from, to], all of which slips: the limit along the direction of `trial`.
//
// Where that direction turns, the curve is replaced by its nearest straight line, with three Gauss points in
// s (exact for a direction that stays); where a line is too poor the stretch is halved, while `spare` pieces
// last.
template <int Capacity>
void add_slip(SlipPieces<Capacity>& out, double from, double to, const SlipLine& trial,
              const SlipLimit& limit, int& spare) {
    constexpr double straight = 1e-8; // rad
    const SlipStretch stretch(from, to);
    const double middle = 0.5 * (from + to), reach = 0.77459666924148337704 * 0.5 * stretch.width;
    const double depth[3] = {(middle - reach) * (middle - reach), middle * middle,
                             (middle + reach) * (middle + reach)};
    const Planar tau[3] = {trial.at(depth[0]), trial.at(depth[1]), trial.at(depth[2])};
    const double turn = tau[0].x() * tau[2].y() - tau[0].y() * tau[2].x();
    if (std::abs(turn) <= straight * tau[0].dot(tau[2])) {
        const double length = tau[1].norm();
        const Planar direction = length > 0 ? Planar(tau[1] / length) : Planar(Planar::Zero());
        out.add(stretch, limit.at(stretch.centre) * direction, -limit.slope * direction, to, 0);
        return;
    }

    constexpr double weight[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
    Planar curve[3], mean = Planar::Zero(), slope = Planar::Zero();
    for (int j = 0; j < 3; ++j) {
        const double length = tau[j].norm();
        curve[j] = length > 0 ? Planar((limit.at(depth[j]) / length) * tau[j]) : Planar(Planar::Zero());
        mean += weight[j] * curve[j];
        slope += (weight[j] * (depth[j] - stretch.centre)) * curve[j];
    }
    slope *= stretch.width / stretch.spread;
    double residual = 0;
    for (int j = 0; j < 3; ++j)
        residual += weight[j] * (curve[j] - mean - (depth[j] - stretch.centre) * slope).squaredNorm();
    residual *= stretch.width;
    if (residual > limit.negligible && spare > 0) {
        --spare;
        add_slip(out, from, middle, trial, limit, spare);
        add_slip(out, middle, to, trial, limit, spare);
        return;
    }
    out.add(stretch, mean, slope, to, residual);
}

// Adds [from, to] of `source` (null: springs new in touch) as it would be if all of it stuck, `trial`, with
// what exceeds the limit cut off along its direction. At most three pieces, besides those that it takes from
// `spare`. Returns whether any of it was within.
//
// |tau| - limit is convex in y, so that what is within is one stretch.
template <int Capacity>
bool add_limited(SlipPieces<Capacity>& out, double from, double to, const SlipPiece* source,
                 const SlipLine& trial, const SlipLimit& limit, int& spare) {
    const double low = from * from, high = to * to;
    const auto slips = [&](double y) {
        const double allowed = limit.at(y);
        return trial.at(y).squaredNorm() > allowed * allowed;
    };
    const bool slips_inside = slips(low), slips_outside = slips(high);
    if (!slips_inside && !slips_outside && source && to == source->end) {
        out.add_shifted(*source, trial.mean);
        return true;
    }
    double stick_from = from, stick_to = to;
    if (slips_inside || slips_outside) {
        const SlipCrossing crossing(trial, limit);
        const double begin = crossing.begin(), finish = crossing.finish();
        if (slips_inside && slips_outside && !(low < finish && finish < begin && begin < high))
            stick_to = from;
        if (slips_inside)
            stick_from = std::sqrt(std::clamp(finish, low, high));
        if (slips_outside)
            stick_to = std::min(stick_to, std::sqrt(std::clamp(begin, low, high)));
    }
    if (!(stick_to > stick_from)) {
        add_slip(out, from, to, trial, limit, spare);
        return false;
    }
    if (stick_from > from)
        add_slip(out, from, stick_from, trial, limit, spare);
    const SlipStretch stretch(stick_from, stick_to);
    out.add(stretch, trial.at(stretch.centre), trial.slope, stick_to, source ? source->residual : 0);
    if (to > stick_to)
        add_slip(out, stick_to, to, trial, limit, spare);
    return true;
}

} // namespace grainfall::laws
