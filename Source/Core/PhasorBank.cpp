// SPDX-License-Identifier: MIT
// Striking, merging, cutting and stealing of the board's modes, and their kernel.
#include "Core/PhasorBank.h"
#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace physvib {
namespace {

using Mode = PhasorBank::Mode;
constexpr int channels = PhasorBank::channels;
constexpr int frames = PhasorBank::blockFrames;
constexpr float residueFactor = 0.875f;      // 60 dB in 52 frames, 6.5 ms: as short as limits::stealFadePerSecond
constexpr float residueSilence = 1.0f / (1 << 20);
constexpr float amplitudeStep = 1.0f / limits::board::amplitudeUnit;

constexpr std::size_t at(int i) noexcept { return static_cast<std::size_t>(i); }
constexpr std::int32_t between(std::uint32_t from, std::uint32_t to) noexcept { return static_cast<std::int32_t>(to - from); }

// p: f and tau on the link's grid as turns / 2^64 and octaves / 2^56 per frame.
Complex<float> turnOf(const BoardEvent& event) noexcept {
    constexpr double perStep = 1.0 / (limits::board::gridPerHz * limits::board::sampleRateHz);
    constexpr auto phase = static_cast<std::uint64_t>(18446744073709551616.0 * perStep);
    constexpr auto decay = static_cast<std::int64_t>(octaveUnit * std::numbers::log2e * perStep);
    return unitPhasor<float>(phase * event.frequency16) * decayFactor<float>(decay * event.decay16);
}

// Brings the phasor's turn and decay into the amplitudes.
void fold(Mode& mode) noexcept {
    for (auto& z : mode.amplitudes) z = z * mode.phasor;
    mode.phasor = {1.0f, 0.0f};
}

float level(const Mode& mode) noexcept {
    float most = 0.0f;
    for (const auto& z : mode.amplitudes) most = std::max(most, std::abs(z.re) + std::abs(z.im));
    return most;
}

// Frames until the mode has fallen to 2^-retireOctaves of full scale; `mode` is folded.
std::uint32_t lifeFrames(const Mode& mode, std::uint16_t decay16) noexcept {
    const int octaves = std::max(0, static_cast<int>(std::bit_cast<std::uint32_t>(level(mode)) >> 23) - 126 + limits::board::retireOctaves);
    constexpr auto framesPerOctave = static_cast<std::uint32_t>(std::numbers::ln2 * limits::board::gridPerHz * limits::board::sampleRateHz + 1.0);
    return static_cast<std::uint32_t>(octaves) * framesPerOctave / decay16 + 1;
}

// Keeps the compiler from starting a frame before the last is done: on the board, 16 sums, the phasor and the amplitudes
// just fill the 32 registers; without this four sums live on the stack (113 instructions a mode instead of 106).
inline Complex<float> nextFrame(Complex<float> w) noexcept {
#if defined(__ARM_FP) && !defined(__aarch64__)
    asm volatile("" : "+t"(w.re), "+t"(w.im));
#endif
    return w;
}

} // namespace

void PhasorBank::clear() noexcept {
    count_ = 0;
    residue_.fill(0.0f);
}

void PhasorBank::render(std::uint32_t frame, Block& out) noexcept {
    frame_ = frame;
    for (auto& channel : out) channel.fill(0.0f);
    if (count_ > 0 && between(frame, nextEnd_) < frames) retire(out);
    renderResidue(out);
    renderModes(out);
}

void PhasorBank::renderModes(Block& io) noexcept {
    auto& [a, b, c, d] = io;
    float a0 = a[0], a1 = a[1], a2 = a[2], a3 = a[3], b0 = b[0], b1 = b[1], b2 = b[2], b3 = b[3];
    float c0 = c[0], c1 = c[1], c2 = c[2], c3 = c[3], d0 = d[0], d1 = d[1], d2 = d[2], d3 = d[3];
    Mode* const end = modes_.data() + count_;
    for (Mode* m = modes_.data(); m != end; ++m) {
        auto w = m->phasor;
        const auto p = m->turn;
        const auto [za, zb, zc, zd] = m->amplitudes;
        a0 += za.re * w.im + za.im * w.re;
        b0 += zb.re * w.im + zb.im * w.re;
        c0 += zc.re * w.im + zc.im * w.re;
        d0 += zd.re * w.im + zd.im * w.re;
        w = nextFrame(w * p);
        a1 += za.re * w.im + za.im * w.re;
        b1 += zb.re * w.im + zb.im * w.re;
        c1 += zc.re * w.im + zc.im * w.re;
        d1 += zd.re * w.im + zd.im * w.re;
        w = nextFrame(w * p);
        a2 += za.re * w.im + za.im * w.re;
        b2 += zb.re * w.im + zb.im * w.re;
        c2 += zc.re * w.im + zc.im * w.re;
        d2 += zd.re * w.im + zd.im * w.re;
        w = nextFrame(w * p);
        a3 += za.re * w.im + za.im * w.re;
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
        float& rest = residue_[at(j)];
        if (rest == 0.0f) continue;
        for (float& sample : io[at(j)]) {
            sample += rest;
            rest *= residueFactor;
        }
        if (std::abs(rest) < residueSilence) rest = 0.0f;
    }
}

// What ends within the block gives its last frames and leaves.
void PhasorBank::retire(Block& io) noexcept {
    nextEnd_ = frame_ + 0x7FFFFFFF;
    for (int i = 0; i < count_;) {
        const std::int32_t left = between(frame_, endFrames_[at(i)]);
        if (left >= frames) {
            if (between(nextEnd_, endFrames_[at(i)]) < 0) nextEnd_ = endFrames_[at(i)];
            ++i;
            continue;
        }
        const Mode& mode = modes_[at(i)];
        auto w = mode.phasor;
        for (int k = 0; k < left; ++k, w = w * mode.turn)
            for (int j = 0; j < channels; ++j) {
                const auto z = mode.amplitudes[at(j)];
                io[at(j)][at(k)] += z.re * w.im + z.im * w.re;
            }
        remove(i);
    }
}

void PhasorBank::remove(int i) noexcept {
    --count_;
    modes_[at(i)] = modes_[at(count_)];
    keys_[at(i)] = keys_[at(count_)];
    endFrames_[at(i)] = endFrames_[at(count_)];
    gated_[at(i)] = gated_[at(count_)];
}

void PhasorBank::strike(const BoardEvent& event, std::uint32_t onset, Block& io) noexcept {
    const bool isGated = event.durationMs > 0;
    const std::uint32_t key = static_cast<std::uint32_t>(event.frequency16) << 16 | event.decay16;
    int i = isGated ? -1 : find(key);
    if (i < 0) i = create(event, key);
    gated_[at(i)] = isGated;
    Mode& mode = modes_[at(i)];
    fold(mode);

    Complex<float> w{1.0f, 0.0f}; // of this strike alone, up to the end of the block
    std::array<float, at(channels)> gains;
    for (int j = 0; j < channels; ++j) gains[at(j)] = static_cast<float>(event.amplitudes[at(j)]) * amplitudeStep;
    for (int k = between(frame_, onset); k < frames; ++k, w = w * mode.turn)
        for (int j = 0; j < channels; ++j) io[at(j)][at(k)] += gains[at(j)] * w.im;
    for (int j = 0; j < channels; ++j) mode.amplitudes[at(j)] += w * gains[at(j)];

    constexpr std::uint32_t framesPerMs = limits::board::sampleRateHz / 1000;
    if (isGated) extend(i, onset + event.durationMs * framesPerMs);
    else extend(i, frame_ + frames + lifeFrames(mode, event.decay16));
}

void PhasorBank::extend(int i, std::uint32_t end) noexcept {
    endFrames_[at(i)] = end;
    if (count_ == 1 || between(nextEnd_, end) < 0) nextEnd_ = end;
}

int PhasorBank::find(std::uint32_t key) const noexcept {
    for (int i = 0; i < count_; ++i)
        if (keys_[at(i)] == key && !gated_[at(i)]) return i;
    return -1;
}

int PhasorBank::create(const BoardEvent& event, std::uint32_t key) noexcept {
    if (count_ == capacity) {
        steal(quietest());
        ++stolen_;
    }
    const int i = count_++;
    modes_[at(i)] = {{}, {1.0f, 0.0f}, turnOf(event)};
    keys_[at(i)] = key;
    return i;
}

int PhasorBank::quietest() const noexcept {
    int found = 0;
    float least = 0.0f;
    for (int i = 0; i < count_; ++i) {
        const Mode& m = modes_[at(i)];
        const float now = level(m) * std::max(std::abs(m.phasor.re), std::abs(m.phasor.im));
        if (i > 0 && now >= least) continue;
        found = i;
        least = now;
    }
    return found;
}

void PhasorBank::steal(int i) noexcept {
    Mode& mode = modes_[at(i)];
    fold(mode);
    for (int j = 0; j < channels; ++j) residue_[at(j)] += mode.amplitudes[at(j)].im;
    remove(i);
}

} // namespace physvib
