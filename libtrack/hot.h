// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstring>

// Marks the few inner loops that are compiled twice, for any x86-64 and for AVX2; the loader picks. They work on blocks of a fixed number
// of lanes and add lane by lane, so both versions, and every build type, give the same bits.
// Not under sanitizers, whose runtime is not ready yet when the loader asks.
#if defined(__x86_64__) && defined(__GLIBC__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define SWARMFIT_HOT __attribute__((target_clones("avx2", "default")))
#define SWARMFIT_TWO_VERSIONS  // where both are written by hand: __attribute__((target("avx2"))) and ((target("default")))
#else
#define SWARMFIT_HOT
#endif

namespace swarmfit {

// Four numbers that go through one instruction together, and what comparing them gives: -1 where it holds, else 0. Handed about by
// reference only: how they are returned differs between the two versions.
using Lanes = double __attribute__((vector_size(32)));
using LaneMask = std::int64_t __attribute__((vector_size(32)));

inline void load(const double* x, Lanes& lanes) { std::memcpy(&lanes, x, sizeof lanes); }

}  // namespace swarmfit
