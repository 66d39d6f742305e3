// SPDX-License-Identifier: MIT
// The vector kernels of the mode bank and the limiter: one source, compiled per instruction set by Highway,
// chosen at run time.
//
// Lanes hold polynomial coefficients as (sine, cosine) pairs, so one 64-bit broadcast of an amplitude (re,
// im) serves both products. A panel of 16 floats times a few channels stays in registers while modes are
// read; after 64 modes it is added to sums in double precision. Every lane does the same operations in the
// same order whatever the vector's width, and no set fuses a product with its sum: all agree to the bit.
#include "Core/Modes/TileKernels.h"
#include "Core/Trigonometry.h"

#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "Core/Modes/TileKernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "Core/Actuators/LimiterKernels.inc"
#include <numbers>

#if HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128 // these two use renderScalar
HWY_BEFORE_NAMESPACE();
namespace physvib::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// a b + c and c - a b, with the product rounded. Loads and broadcasts bound these loops: fused operations
// were no faster (Docs/platforms.md).
template <class V>
HWY_INLINE V mulAdd(V a, V b, V c) {
    return hn::Add(hn::Mul(a, b), c);
}
template <class V>
HWY_INLINE V negMulAdd(V a, V b, V c) {
    return hn::Sub(c, hn::Mul(a, b));
}

using Panel = hn::CappedTag<float, 16>; // eight coefficients
using Line = hn::CappedTag<float, 8>;   // the amplitudes of four channels
using Doubles = hn::CappedTag<double, 8>;
constexpr std::size_t frames = tiles::frames, panelFloats = 16;
constexpr std::size_t chunkModes = 64;    // amplitudes and rows of this many modes fit into the first-level
                                          // cache
constexpr std::size_t chunkChannels = 16; // channels of one pass over the rows

// Channels whose sums stay in registers: 8 sums hide the latency of a multiply-add.
constexpr std::size_t group = HWY_TARGET == HWY_AVX3                             ? 8
                              : HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_NEON ? 4
                                                                                 : 2;

struct Rows {
    const float* first = nullptr; // this panel of the first mode
    std::size_t stride = 0;
    std::size_t count = 0;
};

// sums[channel * sumStride + k] += coefficient k of the panel, over all rows.
template <std::size_t channels, std::size_t floats>
HWY_INLINE void addPanel(const Rows& rows, const float* amplitudes, std::size_t amplitudeStride, double* sums,
                         std::size_t sumStride) {
    const Panel d;
    const hn::Repartition<double, Panel> pairs;
    constexpr std::size_t lanes = hn::MaxLanes(Panel()), vectors = floats / lanes;
    hn::Vec<Panel> sum[channels][vectors];
    for (std::size_t j = 0; j < channels; ++j)
        for (std::size_t v = 0; v < vectors; ++v) sum[j][v] = hn::Zero(d);
    const float* row = rows.first;
    for (std::size_t i = 0; i < rows.count; ++i, row += rows.stride, amplitudes += amplitudeStride) {
        hn::Vec<Panel> part[vectors];
        for (std::size_t v = 0; v < vectors; ++v) part[v] = hn::Load(d, row + v * lanes);
        for (std::size_t j = 0; j < channels; ++j) {
            double pair; // two floats copied as one value; never used as a number
            hwy::CopySameSize(reinterpret_cast<const double*>(amplitudes + 2 * j), &pair);
            const auto z = hn::BitCast(d, hn::Set(pairs, pair));
            for (std::size_t v = 0; v < vectors; ++v) sum[j][v] = mulAdd(z, part[v], sum[j][v]);
        }
    }
    const hn::Half<Panel> half;
    const hn::Rebind<double, hn::Half<Panel>> wide;
    for (std::size_t j = 0; j < channels; ++j)
        for (std::size_t v = 0; v < vectors; ++v) {
            const auto both = hn::Add(sum[j][v], hn::Shuffle2301(sum[j][v]));
            double* at = sums + j * sumStride + v * lanes / 2;
            hn::StoreU(hn::Add(hn::LoadU(wide, at),
                               hn::PromoteTo(wide, hn::LowerHalf(half, hn::ConcatEven(d, both, both)))),
                       wide, at);
        }
}

// z = amplitude * carrier for `count` modes and the channels of `lines` lines.
HWY_INLINE void multiplyByCarrier(const TileLayer& layer, const std::int32_t* slots, std::size_t count,
                                  std::size_t firstLine, std::size_t lines, float* z) {
    const Line d;
    constexpr std::size_t lanes = hn::MaxLanes(Line());
    for (std::size_t i = 0; i < count; ++i, z += lines * 8) {
        const auto slot = static_cast<std::size_t>(slots[i]);
        const auto re = hn::Set(d, layer.carrierRe[slot]), im = hn::Set(d, layer.carrierIm[slot]);
        const float* from =
            layer.amplitudes + slot * static_cast<std::size_t>(layer.floatsPerSlot) + firstLine * 16;
        for (std::size_t l = 0; l < lines; ++l)
            for (std::size_t k = 0; k < 8; k += lanes)
                hn::Store(mulAdd(im, hn::Load(d, from + l * 16 + 8 + k),
                                 hn::Mul(re, hn::Load(d, from + l * 16 + k))),
                          d, z + l * 8 + k);
    }
}

// One panel (of `floats`) of a chunk, for all channels.
template <std::size_t floats>
HWY_INLINE void addToAll(const Rows& panel, const float* z, std::size_t zStride, std::size_t channels,
                         double* sums, std::size_t sumStride) {
    std::size_t j = 0;
    if constexpr (group >= 8)
        for (; j + 8 <= channels; j += 8)
            addPanel<8, floats>(panel, z + 2 * j, zStride, sums + j * sumStride, sumStride);
    if constexpr (group >= 4)
        for (; j + 4 <= channels; j += 4)
            addPanel<4, floats>(panel, z + 2 * j, zStride, sums + j * sumStride, sumStride);
    for (; j + 2 <= channels; j += 2)
        addPanel<2, floats>(panel, z + 2 * j, zStride, sums + j * sumStride, sumStride);
    if (j < channels) addPanel<1, floats>(panel, z + 2 * j, zStride, sums + j * sumStride, sumStride);
}

// One chunk, panel by panel; two at once where there are registers for it.
void addChunk(const Rows& rows, std::size_t rowFloats, const float* z, std::size_t zStride,
              std::size_t channels, double* sums, std::size_t sumStride) {
    std::size_t p = 0;
    if constexpr (HWY_TARGET == HWY_AVX3)
        for (; p + 2 * panelFloats <= rowFloats; p += 2 * panelFloats)
            addToAll<2 * panelFloats>({rows.first + p, rows.stride, rows.count}, z, zStride, channels,
                                      sums + p / 2, sumStride);
    for (; p < rowFloats; p += panelFloats)
        addToAll<panelFloats>({rows.first + p, rows.stride, rows.count}, z, zStride, channels, sums + p / 2,
                              sumStride);
}

void addModes(const TileLayer& layer, const TileModes& modes, std::size_t firstChannel, std::size_t channels,
              double* sums, std::size_t sumStride) {
    HWY_ALIGN float z[chunkModes * chunkChannels * 2];
    const std::size_t lines = (channels + 3) / 4, rowFloats = 2 * static_cast<std::size_t>(modes.rank);
    for (std::size_t first = 0; first < static_cast<std::size_t>(modes.count); first += chunkModes) {
        const std::size_t count = HWY_MIN(chunkModes, static_cast<std::size_t>(modes.count) - first);
        multiplyByCarrier(layer, modes.slots + first, count, firstChannel / 4, lines, z);
        addChunk({modes.rows + first * rowFloats, rowFloats, count}, rowFloats, z, lines * 8, channels, sums,
                 sumStride);
    }
}

// out[t] = sum over k of c[k] U_k(t). Even and odd polynomials are summed separately, so that one half of the
// frames yields the other.
template <std::size_t channels>
HWY_INLINE void expand(const double* coefficients, std::size_t rank, const float* basis, float* out) {
    const Panel d;
    const Doubles wide;
    const hn::Rebind<float, Doubles> narrow;
    constexpr std::size_t lanes = hn::MaxLanes(Panel()), half = frames / 2,
                          vectors = HWY_MIN(4, half / lanes), stride = tiles::maxRank;
    HWY_ALIGN float c[channels * stride];
    for (std::size_t j = 0; j < channels; ++j)
        for (std::size_t k = 0; k < rank; k += hn::MaxLanes(Doubles()))
            hn::Store(hn::DemoteTo(narrow, hn::Load(wide, coefficients + j * stride + k)), narrow,
                      c + j * stride + k);
    for (std::size_t t = 0; t < half; t += vectors * lanes) {
        hn::Vec<Panel> even[channels][vectors], odd[channels][vectors];
        for (std::size_t j = 0; j < channels; ++j)
            for (std::size_t v = 0; v < vectors; ++v) even[j][v] = odd[j][v] = hn::Zero(d);
        for (std::size_t k = 0; k < rank; k += 2)
            for (std::size_t v = 0; v < vectors; ++v) {
                const auto ue = hn::Load(d, basis + k * half + t + v * lanes),
                           uo = hn::Load(d, basis + (k + 1) * half + t + v * lanes);
                for (std::size_t j = 0; j < channels; ++j) {
                    even[j][v] = mulAdd(hn::Set(d, c[j * stride + k]), ue, even[j][v]);
                    odd[j][v] = mulAdd(hn::Set(d, c[j * stride + k + 1]), uo, odd[j][v]);
                }
            }
        for (std::size_t j = 0; j < channels; ++j)
            for (std::size_t v = 0; v < vectors; ++v) {
                float* at = out + j * frames + t + v * lanes;
                hn::StoreU(hn::Add(even[j][v], odd[j][v]), d, at);
                hn::StoreU(hn::Reverse(d, hn::Sub(even[j][v], odd[j][v])), d,
                           out + (j + 1) * frames - lanes - t - v * lanes);
            }
    }
}

void render(const TileLayer& layer, float* out) {
    constexpr std::size_t stride = tiles::maxRank;
    HWY_ALIGN double sums[chunkChannels * stride];
    HWY_ALIGN double direct[chunkChannels * frames];
    const bool hasDirect = layer.modes.back().count > 0;
    std::size_t rank = 0;
    for (const auto& modes : layer.modes)
        if (modes.count > 0 && modes.rank <= tiles::maxRank) rank = static_cast<std::size_t>(modes.rank);
    const auto all = static_cast<std::size_t>(layer.channels);
    for (std::size_t first = 0; first < all; first += chunkChannels) {
        const std::size_t channels = HWY_MIN(chunkChannels, all - first);
        for (std::size_t i = 0; i < channels * stride; ++i) sums[i] = 0.0;
        for (std::size_t i = 0; hasDirect && i < channels * frames; ++i) direct[i] = 0.0;
        for (const auto& modes : layer.modes) {
            const bool isDirect = modes.rank > tiles::maxRank;
            if (modes.count > 0)
                addModes(layer, modes, first, channels, isDirect ? direct : sums, isDirect ? frames : stride);
        }
        constexpr std::size_t together = hn::MaxLanes(Panel()) == 16 ? 2 : 1; // eight sums in either case
        std::size_t j = 0;
        for (; j + together <= channels; j += together)
            expand<together>(sums + j * stride, rank, layer.basis, out + (first + j) * frames);
        for (; j < channels; ++j) expand<1>(sums + j * stride, rank, layer.basis, out + (first + j) * frames);
        for (std::size_t i = 0; hasDirect && i < channels * frames; ++i)
            out[first * frames + i] += static_cast<float>(direct[i]);
    }
}

void advance(const TileCarriers& carriers) {
    const Doubles d;
    const hn::Rebind<float, Doubles> narrow;
    const auto count = static_cast<std::size_t>(carriers.count);
    for (std::size_t i = 0; i < count; i += hn::Lanes(d)) { // arrays are padded
        const auto re = hn::Load(d, carriers.re + i), im = hn::Load(d, carriers.im + i);
        const auto stepRe = hn::Load(d, carriers.stepRe + i), stepIm = hn::Load(d, carriers.stepIm + i);
        const auto nextRe = negMulAdd(im, stepIm, hn::Mul(re, stepRe));
        const auto nextIm = mulAdd(im, stepRe, hn::Mul(re, stepIm));
        hn::Store(nextRe, d, carriers.re + i);
        hn::Store(nextIm, d, carriers.im + i);
        hn::Store(hn::DemoteTo(narrow, nextRe), narrow, carriers.roundedRe + i);
        hn::Store(hn::DemoteTo(narrow, nextIm), narrow, carriers.roundedIm + i);
    }
}

// Values of each strike.
struct Onsets {
    HWY_ALIGN double re[TileStrikes::maxCount]; // phasors at their mode's reference
    HWY_ALIGN double im[TileStrikes::maxCount];
    HWY_ALIGN double turnedRe[TileStrikes::maxCount]; // those, multiplied by the carrier
    HWY_ALIGN double turnedIm[TileStrikes::maxCount];
    HWY_ALIGN double carrierRe[TileStrikes::maxCount];
    HWY_ALIGN double carrierIm[TileStrikes::maxCount];
    HWY_ALIGN double decay[TileStrikes::maxCount];
};

// Decays a mode's amplitudes, adds a strike and rounds them for the following tiles, in whole cache lines:
// values behind the last channel are never summed.
HWY_INLINE void addToAmplitudes(const TileStrike& s, const double* scaled, std::size_t channels,
                                Complex<double> onset, double decay) {
    const Doubles d;
    const hn::Rebind<float, Doubles> narrow;
    constexpr std::size_t lanes = hn::MaxLanes(Doubles());
    const auto phasor = hn::OddEven(hn::Set(d, onset.im), hn::Set(d, onset.re)), fallen = hn::Set(d, decay);
    const std::size_t values = 2 * channels, vectorised = values / lanes * lanes;
    for (std::size_t k = vectorised; k < values; k += 2) {
        s.amplitudes[k] = s.amplitudes[k] * decay + onset.re * scaled[k];
        s.amplitudes[k + 1] = s.amplitudes[k + 1] * decay + onset.im * scaled[k];
    }
    for (std::size_t k = 0; k < values; k += 8)
        for (std::size_t v = k; v < k + 8; v += lanes) {
            auto z = hn::LoadU(d, s.amplitudes + v);
            if (v < vectorised) {
                z = hn::Add(hn::Mul(z, fallen), hn::Mul(phasor, hn::LoadU(d, scaled + v)));
                hn::StoreU(z, d, s.amplitudes + v);
            }
            float* const line = s.lines + k + v;
            const auto rounded = hn::DemoteTo(narrow, z), turned = hn::Shuffle2301(rounded);
            hn::StoreU(rounded, narrow, line);
            hn::StoreU(hn::OddEven(turned, hn::Neg(turned)), narrow, line + 8);
        }
}

// The samples that the strikes add to a channel of gain 1. Frames of a panel before a strike's onset are 0.
HWY_INLINE void fillWaves(const TileStrikes& s, const Onsets& onsets, double* waves) {
    const Doubles d;
    constexpr std::size_t lanes = hn::MaxLanes(Doubles());
    for (std::size_t i = 0; i < static_cast<std::size_t>(s.count); ++i, waves += frames) {
        const TileStrike& e = s.entries[i];
        const auto re = hn::Set(d, onsets.turnedRe[i]), im = hn::Set(d, onsets.turnedIm[i]),
                   from = hn::Set(d, static_cast<double>(e.from));
        for (std::size_t k = static_cast<std::size_t>(e.from) / panelFloats * panelFloats; k < frames;
             k += lanes) {
            const auto sounds = hn::Ge(hn::Iota(d, static_cast<double>(k)), from);
            hn::Store(hn::IfThenElseZero(sounds, mulAdd(re, hn::LoadU(d, e.sinPowers + k),
                                                        hn::Mul(im, hn::LoadU(d, e.cosPowers + k)))),
                      d, waves + k);
        }
    }
}

// Adds the strikes' samples to the tails. A step of frames of a few channels stays in registers while all
// strikes are added that begin before the step's end.
template <std::size_t channels>
HWY_INLINE void addToTails(const TileStrikes& s, const double* waves, const double* scaled, double* tails) {
    const Doubles d;
    constexpr std::size_t lanes = hn::MaxLanes(Doubles()), vectors = HWY_MIN(2, panelFloats / lanes),
                          step = vectors * lanes;
    const auto all = static_cast<std::size_t>(s.count), stride = 2 * static_cast<std::size_t>(s.channels);
    std::size_t active = 0;
    for (std::size_t k = static_cast<std::size_t>(s.entries[0].from) / step * step; k < frames; k += step) {
        while (active < all && static_cast<std::size_t>(s.entries[active].from) < k + step) ++active;
        hn::Vec<Doubles> sum[channels][vectors];
        for (std::size_t j = 0; j < channels; ++j)
            for (std::size_t v = 0; v < vectors; ++v)
                sum[j][v] = hn::Load(d, tails + j * frames + k + v * lanes);
        const double *gains = scaled, *wave = waves + k;
        for (std::size_t i = 0; i < active; ++i, gains += stride, wave += frames)
            for (std::size_t j = 0; j < channels; ++j) {
                const auto g = hn::Set(d, gains[2 * j]);
                for (std::size_t v = 0; v < vectors; ++v)
                    sum[j][v] = mulAdd(g, hn::Load(d, wave + v * lanes), sum[j][v]);
            }
        for (std::size_t j = 0; j < channels; ++j)
            for (std::size_t v = 0; v < vectors; ++v)
                hn::Store(sum[j][v], d, tails + j * frames + k + v * lanes);
    }
}

// unitPhasor and decayFactor of Core/Trigonometry.h with the same operations, for several values at once. One
// value alone would be a long chain of dependent operations.
struct Phasors {
    hn::Vec<Doubles> re, im;
};
HWY_INLINE Phasors unitPhasors(const std::uint64_t* phases) {
    const Doubles d;
    const hn::RebindToUnsigned<Doubles> turns;
    const auto one = hn::Set(d, 1.0);
    const auto first = hn::Set(turns, 1), phase = hn::LoadU(turns, phases);
    const auto quadrant = hn::ShiftRight<62>(hn::Add(phase, hn::Set(turns, std::uint64_t{1} << 61))),
               remainder = hn::Sub(phase, hn::ShiftLeft<62>(quadrant));
    const auto x = hn::Mul(hn::Set(d, 2.0 * std::numbers::pi / 18446744073709551616.0),
                           hn::ConvertTo(d, hn::BitCast(hn::RebindToSigned<Doubles>(), remainder)));
    const auto q = hn::Mul(x, x);
    auto sine = hn::Sub(one, hn::Mul(q, hn::Set(d, 1.0 / 110))),
         cosine = hn::Sub(one, hn::Mul(q, hn::Set(d, 1.0 / 132)));
    for (const int n : {72, 42, 20, 6}) sine = hn::Sub(one, hn::Mul(hn::Mul(q, hn::Set(d, 1.0 / n)), sine));
    for (const int n : {90, 56, 30, 12, 2})
        cosine = hn::Sub(one, hn::Mul(hn::Mul(q, hn::Set(d, 1.0 / n)), cosine));
    sine = hn::Mul(x, sine);
    const auto isOdd = hn::MaskFromVec(hn::BitCast(d, hn::Sub(hn::Zero(turns), hn::And(quadrant, first))));
    const auto reSign = hn::ShiftLeft<63>(hn::ShiftRight<1>(hn::Add(quadrant, first))),
               imSign = hn::ShiftLeft<63>(hn::ShiftRight<1>(quadrant));
    return {hn::Xor(hn::IfThenElse(isOdd, sine, cosine), hn::BitCast(d, reSign)),
            hn::Xor(hn::IfThenElse(isOdd, cosine, sine), hn::BitCast(d, imSign))};
}

HWY_INLINE hn::Vec<Doubles> decayFactors(const std::int64_t* octaves) {
    const Doubles d;
    const hn::RebindToSigned<Doubles> fixed;
    const auto one = hn::Set(d, 1.0);
    const auto all = hn::LoadU(fixed, octaves);
    const auto halvings = hn::ShiftRight<octaveFractionBits>(
        hn::Add(all, hn::Set(fixed, std::int64_t{1} << (octaveFractionBits - 1))));
    const auto x = hn::Mul(hn::Set(d, -std::numbers::ln2 / octaveUnit),
                           hn::ConvertTo(d, hn::Sub(all, hn::ShiftLeft<octaveFractionBits>(halvings))));
    auto power = hn::Add(one, hn::Mul(x, hn::Set(d, 1.0 / 9)));
    for (const int n : {8, 7, 6, 5, 4, 3, 2})
        power = hn::Add(one, hn::Mul(hn::Mul(x, hn::Set(d, 1.0 / n)), power));
    power = hn::Add(one, hn::Mul(x, power));
    return hn::Mul(power, hn::BitCast(d, hn::ShiftLeft<52>(hn::Sub(hn::Set(fixed, 1023), halvings))));
}

// Products are written out, because GCC 12 contracts scalar products whatever its options say.
HWY_INLINE void turnOnsets(const TileStrikes& s, Onsets& onsets) {
    const Doubles d;
    for (std::size_t i = 0; i < static_cast<std::size_t>(s.count); i += hn::MaxLanes(Doubles())) {
        const auto unit = unitPhasors(s.onsetPhases.data() + i),
                   carrier = unitPhasors(s.carrierPhases.data() + i);
        const auto power = decayFactors(s.onsetOctaves.data() + i), re = hn::Mul(unit.re, power),
                   im = hn::Mul(unit.im, power);
        hn::Store(re, d, onsets.re + i);
        hn::Store(im, d, onsets.im + i);
        hn::Store(hn::Sub(hn::Mul(re, carrier.re), hn::Mul(im, carrier.im)), d, onsets.turnedRe + i);
        hn::Store(hn::Add(hn::Mul(re, carrier.im), hn::Mul(im, carrier.re)), d, onsets.turnedIm + i);
        hn::Store(carrier.re, d, onsets.carrierRe + i);
        hn::Store(carrier.im, d, onsets.carrierIm + i);
        hn::Store(decayFactors(s.decayOctaves.data() + i), d, onsets.decay + i);
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(s.count); ++i) {
        const auto slot = static_cast<std::size_t>(s.entries[i].slot);
        s.carriers.re[slot] = onsets.carrierRe[i];
        s.carriers.im[slot] = onsets.carrierIm[i];
        s.carriers.roundedRe[slot] = static_cast<float>(onsets.carrierRe[i]);
        s.carriers.roundedIm[slot] = static_cast<float>(onsets.carrierIm[i]);
    }
}

void strike(const TileStrikes& s) {
    HWY_ALIGN double waves[TileStrikes::maxCount * frames];
    Onsets onsets;
    const auto count = static_cast<std::size_t>(s.count), channels = static_cast<std::size_t>(s.channels);
    turnOnsets(s, onsets);
    for (std::size_t i = 0; i < count; ++i)
        addToAmplitudes(s.entries[i], s.scaled + i * 2 * channels, channels, {onsets.re[i], onsets.im[i]},
                        onsets.decay[i]);
    fillWaves(s, onsets, waves);
    constexpr std::size_t group = HWY_TARGET == HWY_AVX3 ? 8 : 4; // as many sums as registers hold
    std::size_t j = 0;
    if constexpr (group == 8)
        for (; j + 8 <= channels; j += 8) addToTails<8>(s, waves, s.scaled + 2 * j, s.tails + j * frames);
    for (; j + 4 <= channels; j += 4) addToTails<4>(s, waves, s.scaled + 2 * j, s.tails + j * frames);
    for (; j < channels; ++j) addToTails<1>(s, waves, s.scaled + 2 * j, s.tails + j * frames);
}

void sum(const float* base, const double* tails, int count, float* out) {
    const Doubles d;
    const hn::Rebind<float, Doubles> narrow;
    constexpr std::size_t lanes = hn::MaxLanes(Doubles());
    const auto all = static_cast<std::size_t>(count);
    std::size_t k = 0;
    for (; k + lanes <= all; k += lanes)
        hn::StoreU(hn::DemoteTo(narrow, hn::Add(hn::PromoteTo(d, hn::LoadU(narrow, base + k)),
                                                hn::LoadU(d, tails + k))),
                   narrow, out + k);
    for (; k < all; ++k) out[k] = static_cast<float>(static_cast<double>(base[k]) + tails[k]);
}

// Unaligned stores at both ends, aligned ones in between: a store across two cache lines costs double.
HWY_INLINE void clearChannel(float* out, std::size_t count) {
    const Panel d;
    constexpr std::size_t lanes = hn::MaxLanes(Panel()), bytes = lanes * sizeof(float);
    if (count < lanes) {
        for (std::size_t k = 0; k < count; ++k) out[k] = 0.0f;
        return;
    }
    float *const last = out + count - lanes,
                 *at = out + (bytes - reinterpret_cast<std::uintptr_t>(out) % bytes) / sizeof(float);
    hn::StoreU(hn::Zero(d), d, out);
    for (; at + 2 * lanes < last; at += 3 * lanes) { // the compiler would turn a loop of one store into a
                                                     // call of memset
        hn::StoreU(hn::Zero(d), d, at);
        hn::StoreU(hn::Zero(d), d, at + lanes);
        hn::StoreU(hn::Zero(d), d, at + 2 * lanes);
    }
    if (at < last) hn::StoreU(hn::Zero(d), d, at);
    if (at + lanes < last) hn::StoreU(hn::Zero(d), d, at + lanes);
    hn::StoreU(hn::Zero(d), d, last);
}

void clear(float* const* out, int channels, int count) {
    for (int j = 0; j < channels; ++j) clearChannel(out[j], static_cast<std::size_t>(count));
}

TileKernel kernel(InstructionSet set) {
    return {set, advance, render, strike, sum, clear, {storeInputs, writeOutputs, sumTiles}, measure, join};
}

} // namespace physvib::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

#if HWY_ONCE
#include <hwy/targets.h>

namespace physvib {
namespace {

// `make` is compiled for its instruction set too, so it is called only where that set is available.
template <typename Make>
const TileKernel* ifSupported(std::int64_t target, Make make) noexcept {
    static const std::int64_t supported = hwy::SupportedTargets();
    if ((supported & target) == 0) return nullptr;
    static const TileKernel kernel = make();
    return &kernel;
}

} // namespace

const TileKernel* tileKernel(InstructionSet set) noexcept {
    using enum InstructionSet;
    switch (set) {
#if HWY_TARGETS & HWY_SSE4
    case sse4: return ifSupported(HWY_SSE4, [] { return N_SSE4::kernel(sse4); });
#endif
#if HWY_TARGETS & HWY_AVX2
    case avx2: return ifSupported(HWY_AVX2, [] { return N_AVX2::kernel(avx2); });
#endif
#if HWY_TARGETS & HWY_AVX3
    case avx512: return ifSupported(HWY_AVX3, [] { return N_AVX3::kernel(avx512); });
#endif
#if HWY_TARGETS & HWY_NEON
    case neon: return ifSupported(HWY_NEON, [] { return N_NEON::kernel(neon); });
#endif
    case best:
        for (const auto s : {avx512, avx2, neon, sse4})
            if (const auto* kernel = tileKernel(s)) return kernel;
        return nullptr;
    default: return nullptr;
    }
}

} // namespace physvib
#endif
