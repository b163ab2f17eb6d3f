// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: layout of OpenMPArrayAccumulator<Real> (64 bytes), one chunk of memory a thread, indexed by
// omp_get_thread_num(). Verified: tests/abi reads O.energy's sums through it.
#pragma once

#include <lib/base/Math.hpp>

#include <numeric>
#include <omp.h>

namespace yade {

/// Sums kept apart by thread. Owned and resized by the library; here only read and added to.
template <typename T>
class OpenMPArrayAccumulator {
public:
    size_t size() const { return elements; }
    T get(size_t i) const {
        return std::accumulate(chunks.begin(), chunks.end(), T(0),
                               [i](T sum, const T* chunk) { return sum + chunk[i]; });
    }
    void set(size_t i, const T& value) {
        for (T* chunk : chunks)
            chunk[i] = T(0);
        chunks[0][i] = value;
    }
    void add(size_t i, const T& difference) { chunks[omp_get_thread_num()][i] += difference; }
    void reset(size_t i) { set(i, T(0)); }

private:
    int cacheLineBytes;
    size_t threads;
    int perCacheLine;
    std::vector<T*> chunks;
    size_t elements;
    size_t cacheLines;
};

} // namespace yade
