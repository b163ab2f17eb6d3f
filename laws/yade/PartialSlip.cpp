// SPDX-License-Identifier: GPL-2.0-or-later
#include <laws/yade/PartialSlip.hpp>

#include <laws/validation.hpp>

namespace yade {

YADE_PLUGIN((PartialSlip));

// Defined here so that virtual tables and Python registration are compiled once.
PartialSlip::~PartialSlip() = default;

namespace gl = grainfall::laws;

namespace {
constexpr std::size_t numbers_per_piece = 7;
}

void PartialSlip::recall(gl::SlipHistory& history) const {
    history.axis = axis;
    history.pending = pending;
    history.limit_slope = limitSlope;
    history.slides = slides;
    history.coefficient = coefficient;
    history.force_squared = forceSquared;
    history.pieces.count = 0;
    Real start = 0;
    for (const Real* p = pieces.data(); p != pieces.data() + pieces.size(); p += numbers_per_piece) {
        gl::SlipPiece& piece = history.pieces[history.pieces.count++];
        piece.end = p[0];
        piece.mean = gl::Planar(p[1], p[2]);
        piece.slope = gl::Planar(p[3], p[4]);
        piece.residual = p[5];
        piece.joint_residual = p[6];
        piece.stretch = gl::SlipStretch(start, piece.end);
        start = piece.end;
    }
}

void PartialSlip::keep(const gl::SlipHistory& history) {
    axis = history.axis;
    pending = history.pending;
    limitSlope = history.limit_slope;
    slides = history.slides;
    coefficient = history.coefficient;
    forceSquared = history.force_squared;
    pieces.resize(numbers_per_piece * static_cast<std::size_t>(history.pieces.count));
    Real* p = pieces.data();
    for (int i = 0; i < history.pieces.count; ++i) {
        const gl::SlipPiece& piece = history.pieces[i];
        for (const Real number : {piece.end, piece.mean.x(), piece.mean.y(), piece.slope.x(), piece.slope.y(),
                                  piece.residual, piece.joint_residual})
            *p++ = number;
    }
}

void PartialSlip::postLoad(PartialSlip&) {
    const std::size_t most = numbers_per_piece * gl::slip_pieces;
    if (pieces.size() % numbers_per_piece != 0 || pieces.size() > most)
        gl::reject("PartialSlip.pieces", "list of length " + std::to_string(pieces.size()),
                   "of length " + std::to_string(numbers_per_piece) + " n, at most " + std::to_string(most));
}

} // namespace yade
