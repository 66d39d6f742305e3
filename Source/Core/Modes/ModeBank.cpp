// SPDX-License-Identifier: MIT
// The life of modes in the bank: striking, merging, gating, stealing and retiring.
#include "Core/Modes/ModeBank.h"
#include "Core/Modes/ModeIncrements.h"
#include "Core/Modes/ModeTable.h"
#include "Core/PortableMath.h"
#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace physvib {

bool ModeBank::prepare(int sampleRateHz, int channels, InstructionSet set, int modes, int gates) noexcept {
    channels_ = channels;
    rate_ = sampleRateHz;
    tileStart_ = 0;
    modes_ = modes;
    slots_ = modes + limits::maxFadingModes;
    activeCount_ = fadingCount_ = 0;
    stolen_ = 0;
    nextEnd_ = Strike::never;
    if (!allocate(set, gates)) return false;
    recentSlots_.fill(0);
    freeCount_ = slots_;
    for (int i = 0; i < slots_; ++i) freeSlots_[static_cast<std::size_t>(i)] = slots_ - 1 - i;
    for (int i = 0; i < slots_; ++i) mode(i).generation = 0;
    freeGateCount_ = gates;
    for (int i = 0; i < gates; ++i) freeGates_[static_cast<std::size_t>(i)] = gates - 1 - i;
    return true;
}

bool ModeBank::allocate(InstructionSet set, int gates) noexcept {
    const auto count = static_cast<std::size_t>(slots_), perSlot = static_cast<std::size_t>(channels_);
    if (!index_.resize(slots_) || !tiles_.prepare(channels_, set, slots_)) return false;
    return activeSlots_.resize(count) && freeSlots_.resize(count) && slotModes_.resize(count) &&
           amplitudes_.resize(count * perSlot + padding) &&
           tileAmplitudes_.resize(tiles_.isOn() ? 0 : count * perSlot) &&
           cosPowers_.resize(count * tileSize) && sinPowers_.resize(count * tileSize) &&
           gates_.resize(gates) && gateGains_.resize(static_cast<std::size_t>(gates) * perSlot) &&
           freeGates_.resize(static_cast<std::size_t>(gates));
}

void ModeBank::moveTo(std::int64_t fromFrame, int sampleRateHz, std::int64_t toFrame) noexcept {
    enterTile(fromFrame);
    tiles_.finishStrikes();
    const double ratio = sampleRateHz / rate_;
    const auto toNewFrame = [=](std::int64_t frame) { // the frame at the same distance in time from `toFrame`
        return frame == Strike::never
                   ? frame
                   : toFrame + static_cast<std::int64_t>(static_cast<double>(frame - fromFrame) * ratio);
    };
    tileStart_ = toFrame - toFrame % tile;
    rate_ = sampleRateHz;
    nextEnd_ = toFrame; // forces the next tile to recompute it
    index_.clear();
    for (int i = 0; i < activeCount_; ++i) {
        const int slot = activeSlots_[static_cast<std::size_t>(i)];
        Mode& m = mode(slot);
        const auto oldFactor = unitPhasor<double>(m.phaseIncrement * static_cast<std::uint64_t>(fromFrame)) *
                               decayFactor<double>(m.decayIncrement * (fromFrame - m.referenceFrame));
        setIncrements(m);
        const auto factor =
            oldFactor *
            unitPhasor<double>(std::uint64_t{0} - m.phaseIncrement * static_cast<std::uint64_t>(toFrame)) *
            decayFactor<double>(-m.decayIncrement * (toFrame - tileStart_));
        for (int j = 0; j < channels_; ++j) {
            auto& z = amplitudes_[row(slot) + static_cast<std::size_t>(j)];
            z = z * factor;
        }
        m.referenceFrame = tileStart_;
        m.endFrame = toNewFrame(m.endFrame);
        if (!m.isFading) index_.insert(m.hash(), slot);
        if (tiles_.isOn()) tiles_.remove(slot);
        updateMode(slot);
        refreshTile(slot);
    }
    if (tiles_.isOn()) tiles_.begin();
    gates_.retime([=](std::int64_t closeFrame, Gate& gate) {
        // exact, because what the gate takes away when it closes must be what sounds of its strike
        const double onset =
            ratio * (static_cast<double>(gate.onset.frame - fromFrame) - gate.onset.leadFrames);
        const double first = std::ceil(onset);
        gate.onset = {toFrame + static_cast<std::int64_t>(first), first - onset};
        return toNewFrame(closeFrame);
    });
}

bool ModeBank::strike(const Strike& strike, const double* gains) noexcept {
    const bool isGated = strike.closeFrame != Strike::never;
    // the strike ends between two frames, so it has no sample
    if (isGated && strike.closeFrame <= strike.onset.frame) return true;
    if (isGated && freeGateCount_ == 0) return false;
    enterTile(strike.onset.frame);
    tiles_.settle();
    const int slot = findOrCreateSlot(strike);
    Mode& struck = mode(slot);
    add(slot, strike, gains);
    struck.endFrame =
        std::max(struck.endFrame,
                 struck.lifeFrames == Strike::never ? Strike::never : strike.onset.frame + struck.lifeFrames);
    nextEnd_ = std::min(nextEnd_, struck.endFrame);
    return !isGated || openGate(slot, strike, gains);
}

// The slot of the mode that the strike merges with, or of a new mode.
int ModeBank::findOrCreateSlot(const Strike& strike) noexcept {
    const auto hash = static_cast<std::uint32_t>(
        std::bit_cast<std::uint64_t>(strike.frequencyHz) * 0x9e3779b97f4a7c15 >> 32);
    auto& recentSlot = recentSlots_[(hash >> 24) % recentSlots_.size()];
    if (mode(recentSlot).fits(strike)) return recentSlot;
    const Mode newMode = makeMode(strike);
    int slot = index_.find(newMode.hash(), [&](int other) { return mode(other).matches(newMode); });
    if (slot < 0) {
        if (activeCount_ - fadingCount_ == modes_) {
            tiles_.finishStrikes();
            fade(quietest(false), strike.onset.frame);
            ++stolen_;
        }
        if (freeCount_ == 0) {
            tiles_.finishStrikes();
            release(quietest(true));
        }
        slot = create(newMode);
    }
    return recentSlot = slot;
}

void ModeBank::add(int slot, const Strike& strike, const double* gains) noexcept {
    Mode& m = mode(slot);
    if (tiles_.isOn()) { // tiles_ rebases the amplitudes when it processes the strike
        const std::int64_t octaves = m.decayIncrement * (tileStart_ - m.referenceFrame);
        m.referenceFrame = tileStart_;
        return tiles_.strike(slot, static_cast<int>(strike.onset.frame - tileStart_),
                             {onsetPhaseDecay(m, strike.onset, strike.phase),
                              m.phaseIncrement * static_cast<std::uint64_t>(tileStart_), octaves},
                             strike.amplitude, gains, &amplitudes_[row(slot)]);
    }
    rebase(slot);
    const auto phasor = toPhasor(onsetPhaseDecay(m, strike.onset, strike.phase));
    for (std::size_t j = 0; j < static_cast<std::size_t>(channels_); ++j)
        amplitudes_[row(slot) + j] += phasor * (strike.amplitude * gains[j]);
    refreshTile(slot);
}

ModeBank::Mode ModeBank::makeMode(const Strike& strike) const noexcept {
    Mode m;
    m.frequencyHz = strike.frequencyHz;
    m.decayPerSecond = strike.decayPerSecond;
    setIncrements(m);
    m.isGated = strike.closeFrame != Strike::never;
    m.referenceFrame = tileStart_;
    return m;
}

void ModeBank::setIncrements(Mode& m) const noexcept {
    m.phaseIncrement = phaseIncrementOf(m.frequencyHz, rate_);
    m.decayIncrement = decayIncrementOf(m.decayPerSecond, rate_);
    m.lifeFrames = lifeFramesOf(m.decayIncrement);
}

int ModeBank::create(const Mode& m) noexcept {
    const int slot = freeSlots_[static_cast<std::size_t>(--freeCount_)];
    activeSlots_[static_cast<std::size_t>(activeCount_++)] = slot;
    mode(slot) = m;
    mode(slot).generation = ++generations_;
    std::fill_n(amplitudes_.data() + row(slot), channels_, Complex<double>{});
    index_.insert(m.hash(), slot);
    updateMode(slot);
    return slot;
}

void ModeBank::release(int slot) noexcept {
    int* const end = activeSlots_.data() + activeCount_;
    int* const position = std::find(activeSlots_.data(), end, slot);
    std::copy(position + 1, end, position);
    --activeCount_;
    recycle(slot);
}

void ModeBank::recycle(int slot) noexcept {
    if (mode(slot).isFading)
        --fadingCount_;
    else
        index_.erase(mode(slot).hash(), slot);
    if (tiles_.isOn()) tiles_.remove(slot);
    mode(slot).generation = 0; // so that open gates of the slot's earlier mode are ignored
    freeSlots_[static_cast<std::size_t>(freeCount_++)] = slot;
}

// From `frame` on the mode decays faster, with unchanged phase and no step, and ends within milliseconds.
void ModeBank::fade(int slot, std::int64_t frame, double perSecond) noexcept {
    rebase(slot);
    Mode& m = mode(slot);
    index_.erase(m.hash(), slot);
    const std::int64_t before = m.decayIncrement;
    m.decayPerSecond += perSecond;
    setIncrements(m);
    m.isFading = true;
    m.endFrame = std::min(m.endFrame, frame + m.lifeFrames);
    nextEnd_ = std::min(nextEnd_, m.endFrame);
    // the faster decay, extrapolated back to the tile's start, leaves the level at `frame` unchanged
    const double backwards = decayFactor<double>((before - m.decayIncrement) * (frame - tileStart_));
    for (int j = 0; j < channels_; ++j) {
        auto& z = amplitudes_[row(slot) + static_cast<std::size_t>(j)];
        z = z * backwards;
    }
    if (tiles_.isOn()) tiles_.remove(slot);
    updateMode(slot);
    refreshTile(slot);
    tiles_.invalidateFrom(m.isGated, static_cast<int>(frame - tileStart_));
    ++fadingCount_;
}

void ModeBank::fadeAll(std::int64_t frame, double perSecond) noexcept {
    enterTile(frame);
    tiles_.finishStrikes();
    for (int i = 0; i < activeCount_; ++i)
        if (const int slot = activeSlots_[static_cast<std::size_t>(i)]; !mode(slot).isFading)
            fade(slot, frame, perSecond);
}

int ModeBank::quietest(bool isFading) const noexcept {
    int quietestSlot = -1;
    double lowest = 0;
    for (int i = 0; i < activeCount_; ++i) {
        const int slot = activeSlots_[static_cast<std::size_t>(i)];
        if (mode(slot).isFading != isFading) continue;
        double level = 0;
        for (int j = 0; j < channels_; ++j) {
            const auto z = amplitudes_[row(slot) + static_cast<std::size_t>(j)];
            level = std::max(level, z.re * z.re + z.im * z.im);
        }
        const double decay =
            decayFactor<double>(mode(slot).decayIncrement * (tileStart_ - mode(slot).referenceFrame));
        level *= decay * decay;
        if (quietestSlot >= 0 && level >= lowest) continue;
        quietestSlot = slot;
        lowest = level;
    }
    return quietestSlot;
}

void ModeBank::fillPowers(int slot) noexcept {
    const Mode& m = mode(slot);
    for (int k = 0; k < tile; ++k) {
        const auto power = unitPhasor<double>(m.phaseIncrement * static_cast<std::uint64_t>(k)) *
                           decayFactor<double>(m.decayIncrement * k);
        const std::size_t index = static_cast<std::size_t>(slot) * tileSize + static_cast<std::size_t>(k);
        cosPowers_[index] = power.re;
        sinPowers_[index] = power.im;
    }
}

// Recomputes everything that depends on a mode's increments.
void ModeBank::updateMode(int slot) noexcept {
    fillPowers(slot);
    if (!tiles_.isOn()) return;
    const Mode& m = mode(slot);
    const double radians =
        static_cast<double>(m.phaseIncrement) * (2.0 * std::numbers::pi / 18446744073709551616.0);
    const double nepers = static_cast<double>(m.decayIncrement) * (std::numbers::ln2 / octaveUnit);
    const std::size_t powers = static_cast<std::size_t>(slot) * tileSize;
    tiles_.add(slot, {&cosPowers_[powers], &sinPowers_[powers], portable::hypot(radians, nepers),
                      unitPhasor<double>(m.phaseIncrement * static_cast<std::uint64_t>(tile)) *
                          decayFactor<double>(m.decayIncrement * tile),
                      m.isGated});
    renewCarrier(slot);
}

// Moves the amplitudes' reference to the tile's first frame.
void ModeBank::rebase(int slot) noexcept {
    Mode& m = mode(slot);
    if (m.referenceFrame == tileStart_) return;
    const double decay = decayFactor<double>(m.decayIncrement * (tileStart_ - m.referenceFrame));
    for (int j = 0; j < channels_; ++j) {
        auto& z = amplitudes_[row(slot) + static_cast<std::size_t>(j)];
        z = z * decay;
    }
    m.referenceFrame = tileStart_;
    renewCarrier(slot);
}

Complex<double> ModeBank::carrier(const Mode& m) const noexcept {
    return unitPhasor<double>(m.phaseIncrement * static_cast<std::uint64_t>(tileStart_)) *
           decayFactor<double>(m.decayIncrement * (tileStart_ - m.referenceFrame));
}

void ModeBank::renewCarrier(int slot) noexcept {
    if (tiles_.isOn()) tiles_.setCarrier(slot, carrier(mode(slot)));
}

void ModeBank::refreshTile(int slot) noexcept {
    if (tiles_.isOn()) return tiles_.setAmplitudes(slot, &amplitudes_[row(slot)]);
    const auto factor = carrier(mode(slot));
    for (int j = 0; j < channels_; ++j) {
        const std::size_t index = row(slot) + static_cast<std::size_t>(j);
        tileAmplitudes_[index] = amplitudes_[index] * factor;
    }
}

void ModeBank::enterTile(std::int64_t frame) noexcept {
    const std::int64_t start = frame - frame % tile;
    if (start == tileStart_) return;
    tiles_.finishStrikes();
    const bool isNext = start == tileStart_ + tile;
    tileStart_ = start;
    if (start >= nextEnd_) retireModes();
    refreshAll(isNext);
}

void ModeBank::retireModes() noexcept {
    int remaining = 0;
    nextEnd_ = Strike::never;
    for (int i = 0; i < activeCount_; ++i) {
        const int slot = activeSlots_[static_cast<std::size_t>(i)];
        if (mode(slot).endFrame > tileStart_) {
            activeSlots_[static_cast<std::size_t>(remaining++)] = slot;
            nextEnd_ = std::min(nextEnd_, mode(slot).endFrame);
        } else {
            recycle(slot);
        }
    }
    activeCount_ = remaining;
}

// Carriers advance by multiplication. To bound rounding errors they are recomputed from their integers every
// renewalTiles tiles, a few slots at a time.
void ModeBank::refreshAll(bool isNextTile) noexcept {
    if (tiles_.isOn()) {
        if (isNextTile) tiles_.advance();
        const int stride = isNextTile ? ModeTiles::renewalTiles : 1;
        for (int slot = static_cast<int>(tileStart_ / tile % stride); slot < tiles_.slotsInUse();
             slot += stride)
            if (mode(slot).generation != 0) renewCarrier(slot);
        return tiles_.begin();
    }
    for (int i = 0; i < activeCount_; ++i) refreshTile(activeSlots_[static_cast<std::size_t>(i)]);
}

bool ModeBank::openGate(int slot, const Strike& strike, const double* gains) noexcept {
    const int entry = freeGates_[static_cast<std::size_t>(--freeGateCount_)];
    for (int j = 0; j < channels_; ++j)
        gateGains_[static_cast<std::size_t>(entry * channels_ + j)] = strike.amplitude * gains[j];
    ++mode(slot).openGates;
    return gates_.push(strike.closeFrame, {slot, mode(slot).generation, entry, strike.onset, strike.phase});
}

void ModeBank::closeNextGate() noexcept {
    const Gate gate = gates_.next();
    const std::int64_t closeFrame = gates_.nextTime();
    enterTile(closeFrame);
    tiles_.finishStrikes();
    gates_.pop();
    freeGates_[static_cast<std::size_t>(freeGateCount_++)] = gate.entry;
    Mode& m = mode(gate.slot);
    if (m.generation != gate.generation) return;
    rebase(gate.slot);
    const auto phasor = toPhasor(onsetPhaseDecay(m, gate.onset, gate.phase));
    --m.openGates;
    for (int j = 0; j < channels_; ++j) {
        auto& z = amplitudes_[row(gate.slot) + static_cast<std::size_t>(j)];
        if (m.openGates == 0)
            z = {}; // exact silence, without rounding residue
        else
            z -= phasor * gateGains_[static_cast<std::size_t>(gate.entry * channels_ + j)];
    }
    if (m.openGates == 0) nextEnd_ = m.endFrame = tileStart_;
    refreshTile(gate.slot);
    tiles_.invalidateFrom(m.isGated, static_cast<int>(closeFrame - tileStart_));
}

PhaseDecay ModeBank::onsetPhaseDecay(const Mode& m, FramePosition onset, std::uint64_t phase) noexcept {
    const auto leadPhase =
        static_cast<std::uint64_t>(static_cast<double>(m.phaseIncrement) * onset.leadFrames);
    const auto leadDecay =
        static_cast<std::int64_t>(static_cast<double>(m.decayIncrement) * onset.leadFrames);
    // A gate may close long after its own strike has decayed, if other strikes keep the mode alive.
    constexpr std::int64_t inaudibleOctaves = 120 * static_cast<std::int64_t>(octaveUnit);
    const std::int64_t age = m.referenceFrame - onset.frame;
    const bool hasDecayed = age > 0 && m.decayIncrement > 0 && age > inaudibleOctaves / m.decayIncrement;
    return {phase + leadPhase - m.phaseIncrement * static_cast<std::uint64_t>(onset.frame),
            hasDecayed ? inaudibleOctaves : m.decayIncrement * age + leadDecay};
}

bool ModeBank::render(float* const* out, std::int64_t first, int frames) noexcept {
    enterTile(first);
    tiles_.finishStrikes();
    const int from = static_cast<int>(first - tileStart_);
    if (tiles_.isOn()) return tiles_.render(out, from, frames);
    const ModeTable table{activeSlots_.data(),    activeCount_,      channels_,
                          tileAmplitudes_.data(), cosPowers_.data(), sinPowers_.data()};
    renderScalar(table, out, from, frames);
    return activeCount_ > 0;
}

bool ModeBank::findSums(const float** sums, std::int64_t first) noexcept {
    if (!tiles_.isOn()) return false;
    enterTile(first);
    return tiles_.findSums(sums, static_cast<int>(first - tileStart_));
}

} // namespace physvib
