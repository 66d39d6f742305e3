// SPDX-License-Identifier: GPL-3.0-or-later
// Independent chains of multiply-adds, enough to hide their latency on the cores we know: 4 cycles of two a
// cycle, and 3 + 3 where product and sum are two instructions.
#include "PeakRate.h"

#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "PeakRate.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace physvib::bench::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

double run() {
    const hn::ScalableTag<float> d;
    constexpr int chains = HWY_TARGET == HWY_SSE4 ? 14 : 12;
    const int rounds = static_cast<int>(2'000'000 / (chains * hn::Lanes(d)));
    volatile float seed = 0.25f;
    const auto a = hn::Set(d, seed), b = hn::Set(d, seed * 2);
    hn::Vec<decltype(d)> x[chains];
    for (int c = 0; c < chains; ++c) x[c] = hn::Set(d, seed + static_cast<float>(c));
    for (int r = 0; r < rounds; ++r)
        for (int c = 0; c < chains; ++c) x[c] = hn::MulAdd(x[c], a, b);
    for (int c = 1; c < chains; ++c) x[0] = hn::Add(x[0], x[c]);
    volatile float sink = hn::GetLane(x[0]);
    static_cast<void>(sink);
    return static_cast<double>(rounds) * chains * static_cast<double>(hn::Lanes(d));
}

} // namespace physvib::bench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace physvib::bench {

double multiplyAdds(InstructionSet set) {
    if (!isAvailable(set)) return 0.0;
    switch (set) {
#if HWY_TARGETS & HWY_SSE4
    case InstructionSet::sse4: return N_SSE4::run();
#endif
#if HWY_TARGETS & HWY_AVX2
    case InstructionSet::avx2: return N_AVX2::run();
#endif
#if HWY_TARGETS & HWY_AVX3
    case InstructionSet::avx512: return N_AVX3::run();
#endif
#if HWY_TARGETS & HWY_NEON
    case InstructionSet::neon: return N_NEON::run();
#endif
#if HWY_TARGETS & HWY_SCALAR
    case InstructionSet::scalar: return N_SCALAR::run();
#endif
    default: return 0.0;
    }
}

} // namespace physvib::bench
#endif
