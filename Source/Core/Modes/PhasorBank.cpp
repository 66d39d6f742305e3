// SPDX-License-Identifier: MIT
// Kernel of the board's mode bank, and the life of its modes: striking, merging, cutting and stealing.
#include "Core/Modes/PhasorBank.h"
#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace physvib {
namespace {

constexpr int frames = PhasorBank::blockFrames;
constexpr float residueFactor = 0.875f; // 60 dB in 52 frames, 6.5 ms: as short as limits::stealFadePerSecond
constexpr float residueSilence = 1.0f / (1 << 20);
constexpr float phasorSilence = 1.0e-12f; // squared: far below retireOctaves, far above the smallest float
constexpr float amplitudeStep = 1.0f / limits::board::amplitudeUnit;

constexpr std::size_t at(int i) noexcept { return static_cast<std::size_t>(i); }
constexpr std::int32_t framesBetween(std::uint32_t from, std::uint32_t to) noexcept {
    return static_cast<std::int32_t>(to - from);
}

// Index of channel `c` in the order "loudest, ratio 0, ratio 1, ratio 2".
constexpr int orderIndex(int c, int loudest) noexcept { return c == loudest ? 0 : (c == 0 ? loudest : c); }

// p: phase advance and decay per frame.
Complex<float> frameFactor(const BoardEvent& event) noexcept {
    constexpr double perStep = 1.0 / (limits::board::gridPerHz * limits::board::sampleRateHz);
    constexpr auto phase = static_cast<std::uint64_t>(18446744073709551616.0 * perStep);
    return unitPhasor<float>(phase * event.frequency16) * decayFactor<float>(boardOctaves(event.decay16));
}

float level(Complex<float> z) noexcept { return std::abs(z.re) + std::abs(z.im); }

// Frames until a phasor of this level has fallen to 2^-retireOctaves of full scale.
std::uint32_t lifeFrames(float level, std::uint16_t decay16) noexcept {
    const int octaves = std::max(0, static_cast<int>(std::bit_cast<std::uint32_t>(level) >> 23) - 126 +
                                        limits::board::retireOctaves);
    constexpr auto framesPerOctave = static_cast<std::uint32_t>(
        std::numbers::ln2 * limits::board::gridPerHz * limits::board::sampleRateHz + 1.0);
    return static_cast<std::uint32_t>(octaves) * framesPerOctave / decay16 + 1;
}

#if defined(__ARM_FP) && !defined(__aarch64__)
#define PHYSVIB_CORTEX_M 1
#endif

struct LoadedMode {
    Complex<float> b, c, d, phasor, turn;
};

// Arm's manual: one load of ten registers takes 11 cycles, ten loads take 20 (6 % of the board's load; not
// measured).
inline LoadedMode load(const PhasorBank::Mode& mode) noexcept {
#ifdef PHYSVIB_CORTEX_M
    register float b0 asm("s0"), b1 asm("s1"), c0 asm("s2"), c1 asm("s3"), d0 asm("s4"), d1 asm("s5"),
        w0 asm("s6"), w1 asm("s7"), p0 asm("s8"), p1 asm("s9");
    asm volatile("vldm %[m], {s0-s9}"
                 : "=t"(b0), "=t"(b1), "=t"(c0), "=t"(c1), "=t"(d0), "=t"(d1), "=t"(w0), "=t"(w1), "=t"(p0),
                   "=t"(p1)
                 : [m] "r"(&mode), "m"(mode));
    return {{b0, b1}, {c0, c1}, {d0, d1}, {w0, w1}, {p0, p1}};
#else
    return {mode.ratios[0], mode.ratios[1], mode.ratios[2], mode.phasor, mode.turn};
#endif
}

// Keeps the compiler from starting a frame before the last is done. On the board 16 sums, the phasor and the
// ratios just fit into 32 registers; otherwise sums are spilled to the stack (7 % more instructions).
inline Complex<float> nextFrame(Complex<float> w) noexcept {
#ifdef PHYSVIB_CORTEX_M
    asm volatile("" : "+t"(w.re), "+t"(w.im));
#endif
    return w;
}

} // namespace

void PhasorBank::clear() noexcept {
    ends_.fill(0);
    residue_.fill(0.0f);
}

void PhasorBank::render(std::uint32_t frame, Block& out) noexcept {
    frame_ = frame;
    for (auto& row : out) row.fill(0.0f);
    if (liveModes() > 0 && framesBetween(frame, nextEnd_) < frames) retire(out);
    renderResidue(out);
    auto& [a, b, c, d] = out;
    Mode* const all = modes_.data();
    renderModes(all, all + ends_[0], a, b, c, d);
    renderModes(all + ends_[0], all + ends_[1], b, a, c, d);
    renderModes(all + ends_[1], all + ends_[2], c, b, a, d);
    renderModes(all + ends_[2], all + ends_[3], d, b, c, a);
}

// 84 instructions per mode for 16 samples, because all sums stay in registers.
void PhasorBank::renderModes(Mode* from, const Mode* to, Row& a, Row& b, Row& c, Row& d) noexcept {
    if (from == to) return;
    float a0 = a[0], a1 = a[1], a2 = a[2], a3 = a[3], b0 = b[0], b1 = b[1], b2 = b[2], b3 = b[3];
    float c0 = c[0], c1 = c[1], c2 = c[2], c3 = c[3], d0 = d[0], d1 = d[1], d2 = d[2], d3 = d[3];
    for (Mode* m = from; m != to; ++m) {
        const auto [zb, zc, zd, start, p] = load(*m);
        auto w = start;
        a0 += w.im;
        b0 += zb.re * w.im + zb.im * w.re;
        c0 += zc.re * w.im + zc.im * w.re;
        d0 += zd.re * w.im + zd.im * w.re;
        w = nextFrame(w * p);
        a1 += w.im;
        b1 += zb.re * w.im + zb.im * w.re;
        c1 += zc.re * w.im + zc.im * w.re;
        d1 += zd.re * w.im + zd.im * w.re;
        w = nextFrame(w * p);
        a2 += w.im;
        b2 += zb.re * w.im + zb.im * w.re;
        c2 += zc.re * w.im + zc.im * w.re;
        d2 += zd.re * w.im + zd.im * w.re;
        w = nextFrame(w * p);
        a3 += w.im;
        b3 += zb.re * w.im + zb.im * w.re;
        c3 += zc.re * w.im + zc.im * w.re;
        d3 += zd.re * w.im + zd.im * w.re;
        w = nextFrame(w * p);
        m->phasor = w;
    }
    a = {a0, a1, a2, a3};
    b = {b0, b1, b2, b3};
    c = {c0, c1, c2, c3};
    d = {d0, d1, d2, d3};
}

void PhasorBank::renderResidue(Block& io) noexcept {
    for (int j = 0; j < channels; ++j) {
        float& residue = residue_[at(j)];
        if (residue == 0.0f) continue;
        for (float& sample : io[at(j)]) {
            sample += residue;
            residue *= residueFactor;
        }
        if (std::abs(residue) < residueSilence) residue = 0.0f;
    }
}

// A mode that ends within the block writes its last frames and is removed.
void PhasorBank::retire(Block& io) noexcept {
    nextEnd_ = frame_ + 0x7FFFFFFF;
    for (int i = 0; i < liveModes();) {
        const std::int32_t remaining = framesBetween(frame_, endFrames_[at(i)]);
        if (remaining >= frames) {
            if (framesBetween(nextEnd_, endFrames_[at(i)]) < 0) nextEnd_ = endFrames_[at(i)];
            ++i;
            continue;
        }
        for (int k = 0; k < remaining; ++k) {
            const Phasors phasors = phasorsOf(i);
            for (int j = 0; j < channels; ++j) io[at(j)][at(k)] += phasors[at(j)].im;
            modes_[at(i)].phasor = modes_[at(i)].phasor * modes_[at(i)].turn;
        }
        removeMode(i);
    }
}

void PhasorBank::moveMode(int target, int source) noexcept {
    modes_[at(target)] = modes_[at(source)];
    keys_[at(target)] = keys_[at(source)];
    endFrames_[at(target)] = endFrames_[at(source)];
    isGated_[at(target)] = isGated_[at(source)];
}

int PhasorBank::groupOf(int i) const noexcept {
    int group = 0;
    while (i >= ends_[at(group)]) ++group;
    return group;
}

// A free slot at the end of the group; one mode of each later group moves to free it.
int PhasorBank::insertSlot(int group) noexcept {
    for (int g = channels - 1; g > group; --g) {
        if (ends_[at(g - 1)] != ends_[at(g)]) moveMode(ends_[at(g)], ends_[at(g - 1)]);
        ++ends_[at(g)];
    }
    return ends_[at(group)]++;
}

// Removes mode i. Other modes move, but none to a slot before i.
void PhasorBank::removeMode(int i) noexcept {
    const int group = groupOf(i);
    --ends_[at(group)];
    if (i != ends_[at(group)]) moveMode(i, ends_[at(group)]);
    for (int g = group + 1; g < channels; ++g) {
        --ends_[at(g)];
        if (ends_[at(g)] != ends_[at(g - 1)]) moveMode(ends_[at(g - 1)], ends_[at(g)]);
    }
}

PhasorBank::Phasors PhasorBank::phasorsOf(int i) const noexcept {
    const Mode& m = modes_[at(i)];
    const int loudest = groupOf(i);
    Phasors phasors;
    for (int j = 0; j < channels; ++j) {
        const int k = orderIndex(j, loudest);
        phasors[at(j)] = k == 0 ? m.phasor : m.ratios[at(k - 1)] * m.phasor;
    }
    return phasors;
}

// Moves the mode to the group of its loudest channel. Returns its new slot, or -1 if it has decayed.
int PhasorBank::setPhasors(int i, const Phasors& phasors) noexcept {
    int loudest = 0;
    for (int j = 1; j < channels; ++j)
        if (level(phasors[at(j)]) > level(phasors[at(loudest)])) loudest = j;
    const auto w = phasors[at(loudest)];
    const float norm = w.re * w.re + w.im * w.im;
    if (norm < phasorSilence) {
        removeMode(i);
        return -1;
    }
    if (loudest != groupOf(i)) {
        const Mode mode = modes_[at(i)];
        const auto key = keys_[at(i)], end = endFrames_[at(i)];
        const bool isGated = isGated_[at(i)];
        removeMode(i);
        i = insertSlot(loudest);
        modes_[at(i)] = mode;
        keys_[at(i)] = key;
        endFrames_[at(i)] = end;
        isGated_[at(i)] = isGated;
    }
    const float scale = 1.0f / norm;
    const Complex<float> inverse{w.re * scale, -w.im * scale};
    Mode& m = modes_[at(i)];
    m.phasor = w;
    for (int j = 0; j < channels; ++j)
        if (const int k = orderIndex(j, loudest); k > 0) m.ratios[at(k - 1)] = phasors[at(j)] * inverse;
    return i;
}

void PhasorBank::strike(const BoardEvent& event, std::uint32_t onset, Block& io) noexcept {
    const bool isGated = event.durationMs > 0;
    const std::uint32_t key = static_cast<std::uint32_t>(event.frequency16) << 16 | event.decay16;
    int i = isGated ? -1 : find(key);
    if (i < 0) i = create(event, key);
    isGated_[at(i)] = isGated;
    const auto turn = modes_[at(i)].turn;

    Complex<float> w{1.0f, 0.0f}; // of this strike alone, from its onset to the end of the block
    Phasors phasors = phasorsOf(i);
    std::array<float, at(channels)> gains;
    for (int j = 0; j < channels; ++j)
        gains[at(j)] = static_cast<float>(event.amplitudes[at(j)]) * amplitudeStep;
    for (int k = framesBetween(frame_, onset); k < frames; ++k, w = w * turn)
        for (int j = 0; j < channels; ++j) io[at(j)][at(k)] += gains[at(j)] * w.im;
    for (int j = 0; j < channels; ++j) phasors[at(j)] += w * gains[at(j)];
    i = setPhasors(i, phasors);
    if (i < 0) return;

    constexpr std::uint32_t framesPerMs = limits::board::sampleRateHz / 1000;
    if (isGated)
        setEnd(i, onset + event.durationMs * framesPerMs);
    else
        setEnd(i, frame_ + frames + lifeFrames(level(modes_[at(i)].phasor), event.decay16));
}

void PhasorBank::setEnd(int i, std::uint32_t end) noexcept {
    endFrames_[at(i)] = end;
    if (liveModes() == 1 || framesBetween(nextEnd_, end) < 0) nextEnd_ = end;
}

int PhasorBank::find(std::uint32_t key) const noexcept {
    const auto end = keys_.begin() + liveModes();
    for (auto here = std::find(keys_.begin(), end, key); here != end; here = std::find(here + 1, end, key))
        if (const auto i = static_cast<int>(here - keys_.begin()); !isGated_[at(i)]) return i;
    return -1;
}

int PhasorBank::create(const BoardEvent& event, std::uint32_t key) noexcept {
    if (liveModes() == capacity) {
        steal(quietest());
        ++stolen_;
    }
    const int i = insertSlot(0);
    modes_[at(i)] = {{}, {}, frameFactor(event)};
    keys_[at(i)] = key;
    endFrames_[at(i)] = 0; // the caller sets it
    return i;
}

int PhasorBank::quietest() const noexcept {
    int found = 0;
    for (int i = 1; i < liveModes(); ++i)
        if (level(modes_[at(i)].phasor) < level(modes_[at(found)].phasor)) found = i;
    return found;
}

void PhasorBank::steal(int i) noexcept {
    const Phasors phasors = phasorsOf(i);
    for (int j = 0; j < channels; ++j) residue_[at(j)] += phasors[at(j)].im;
    removeMode(i);
}

} // namespace physvib
