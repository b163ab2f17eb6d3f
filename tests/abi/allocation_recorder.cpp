// SPDX-License-Identifier: GPL-2.0-or-later
// Preloaded into a process, remembers how many bytes operator new was asked for: the exact size of an object
// that another library makes, which malloc alone would round up.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>

namespace {
// One slot for each 16-byte cell of memory, modulo the table: the latest request at an address is what is
// asked for.
constexpr std::size_t slots = std::size_t(1) << 22;
std::uint32_t requested[slots];
std::size_t slot_of(const void* address) {
    return (reinterpret_cast<std::uintptr_t>(address) >> 4) % slots;
}
} // namespace

void* operator new(std::size_t bytes) {
    void* memory = std::malloc(bytes != 0 ? bytes : 1);
    if (memory == nullptr)
        throw std::bad_alloc();
    requested[slot_of(memory)] = static_cast<std::uint32_t>(bytes);
    return memory;
}

// The matching deallocation is the library's own: it frees what malloc gave.
extern "C" std::size_t requested_bytes(const void* address) {
    return requested[slot_of(address)];
}
