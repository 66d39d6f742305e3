// SPDX-License-Identifier: MIT
// The Pico's signal path: frames from USB to frames for the amplifiers, a tile at a time.
// Volume, then the gate (soft start, and ramped silence), then the guard, then the ceiling. Gains are decided
// at the ends of tiles and are linear in between. With gains of one, samples pass unchanged.
#pragma once
#include "FixedGuard.h"
#include "FrameBuffer.h"

namespace physvib::pico {

/// render() runs in the interrupt of the output, everything else in the main loop unless it says otherwise.
template <int channels>
class Player {
public:
    static constexpr int startTiles = tilesPerSecond / 10; // soft start: 100 ms
    static constexpr int stopTiles = 3;                    // ramp to silence, and from it after a pause: 1 ms
    static constexpr int timeoutTiles = 7;                 // 2.3 ms without a packet: the host stopped
    static constexpr int amplifierTiles = 6; // covers what the output still buffers, with a margin
    static constexpr std::int32_t volumeStep = unity * 100 / tilesPerSecond; // the whole range in 10 ms
    static constexpr std::int16_t fullScale = 32767;
    static constexpr std::int32_t lowCeiling = unity / 4; // -12 dB, for small actuators

    FrameBuffer<channels> buffer;

    /// Permits playing; false ramps to silence and stays there. It lapses if it is not renewed within
    /// timeoutTiles, so a hanging main loop ends the vibration as fast as a pulled cable does. Main loop.
    void setAllowed(bool isAllowed) noexcept {
        isAllowed_.store(isAllowed, std::memory_order_relaxed);
        increment(permissionCount_);
    }
    /// Makes the next start take startTiles, like the first one and one after a hang of the main loop. Starts
    /// after a pause of a program are quick, to keep its next hit. Main loop, while not allowed.
    void requestSoftStart() noexcept { isStartSoft_.store(true, std::memory_order_relaxed); }
    /// If low (the initial state), samples are scaled to a quarter, and the ceiling is a quarter of full
    /// scale. The ceiling falls within a tile and rises as slowly as the soft start. Main loop.
    void setLowCeiling(bool isLow) noexcept {
        targetCeilingGain_.store(isLow ? lowCeiling : unity, std::memory_order_relaxed);
    }
    /// Gain from 0 to unity. Main loop.
    void setVolume(int channel, std::int32_t gain) noexcept {
        targetVolume_[static_cast<std::size_t>(channel)].store(gain, std::memory_order_relaxed);
    }

    /// Renders the next tile. Interrupt of the output.
    void render(Tile<channels>& tile) noexcept {
        updateState();
        updateCeiling();
        if (state_ == State::waiting) {
            tile = {};
        } else {
            fillTile(tile);
            updateGate();
        }
        typename FixedGuard<channels>::Sums sums{};
        bool isClipped = false;
        for (std::size_t j = 0; j < sums.size(); ++j) {
            const std::int32_t end = gainAtEnd(j);
            if (state_ != State::waiting || startGain_[j] != 0)
                sums[j] = applyGain(tile, j, startGain_[j], end, isClipped);
            startGain_[j] = end;
        }
        guard_.update(sums);
        if (isClipped || guard_.gain() < unity) increment(limitedTiles_);
        if (state_ == State::stopping && gateGain_ == 0) {
            state_ = State::waiting;
            buffer.clear();
            crossfade_.reset();
        }
        amplifierTiles_ = state_ != State::waiting ? amplifierTiles : std::max(0, amplifierTiles_ - 1);
        isPlaying_.store(state_ == State::playing, std::memory_order_relaxed);
        isAmplifierOn_.store(amplifierTiles_ > 0, std::memory_order_relaxed);
        increment(tiles_);
    }

    /// Tiles since the main loop last called setAllowed(). Interrupt of the output.
    std::uint32_t unattendedTiles() const noexcept { return unattendedTiles_; }
    bool isPlaying() const noexcept { return isPlaying_.load(std::memory_order_relaxed); } ///< any thread
    /// Whether something other than silence may be at the output. Any thread.
    bool isAmplifierOn() const noexcept { return isAmplifierOn_.load(std::memory_order_relaxed); }
    std::uint32_t tiles() const noexcept { return tiles_.load(std::memory_order_relaxed); } ///< any thread
    /// How often frames were missing while the host was sending. Any thread.
    std::uint32_t underruns() const noexcept { return underruns_.load(std::memory_order_relaxed); }
    /// Tiles in which guard or ceiling reduced the signal. Any thread.
    std::uint32_t limitedTiles() const noexcept { return limitedTiles_.load(std::memory_order_relaxed); }
    /// Largest sample that passes, of 32767. Any thread.
    std::int32_t ceiling() const noexcept { return ceiling_.load(std::memory_order_relaxed); }

private:
    enum class State { waiting, playing, stopping };

    static void increment(std::atomic<std::uint32_t>& counter) noexcept {
        counter.store(counter.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
    }

    void updateState() noexcept {
        const auto permissionCount = permissionCount_.load(std::memory_order_relaxed);
        unattendedTiles_ = permissionCount == lastPermissionCount_ ? unattendedTiles_ + 1 : 0;
        lastPermissionCount_ = permissionCount;
        const bool isAllowed = isAllowed_.load(std::memory_order_relaxed) && unattendedTiles_ < timeoutTiles;
        if (unattendedTiles_ >= timeoutTiles) isStartSoft_.store(true, std::memory_order_relaxed);
        const auto written = buffer.writtenFrames();
        idleTiles_ = written == lastWritten_ ? idleTiles_ + 1 : 0;
        lastWritten_ = written;
        if (state_ == State::playing && (!isAllowed || idleTiles_ >= timeoutTiles)) state_ = State::stopping;
        if (state_ != State::waiting) return;
        if (!isAllowed || idleTiles_ >= timeoutTiles)
            buffer.clear();
        else if (buffer.level() >= FrameBuffer<channels>::targetFrames)
            state_ = State::playing;
    }

    // Missing frames repeat the last one while the gate ramps to zero, because a step would be a click.
    void fillTile(Tile<channels>& tile) noexcept {
        const int count = buffer.read(tile, crossfade_);
        if (count == tileFrames) return;
        for (int k = count; k < tileFrames; ++k) tile[static_cast<std::size_t>(k)] = crossfade_.last();
        crossfade_.markGap(); // packets may come again before the gate is closed
        if (state_ != State::playing) return;
        increment(underruns_);
        state_ = State::stopping;
    }

    void updateCeiling() noexcept {
        const auto before = ceilingGain_, target = targetCeilingGain_.load(std::memory_order_relaxed);
        ceilingGain_ = std::min(target, ceilingGain_ + unity / startTiles + 1);
        ceiling_.store(product(fullScale, std::max(before, ceilingGain_)), std::memory_order_relaxed);
    }

    void updateGate() noexcept {
        if (state_ != State::playing) {
            gateGain_ = std::max(std::int32_t{0}, gateGain_ - (unity / stopTiles + 1));
            return;
        }
        const bool isSoft = isStartSoft_.load(std::memory_order_relaxed);
        gateGain_ = std::min(unity, gateGain_ + unity / (isSoft ? startTiles : stopTiles) + 1);
        if (gateGain_ == unity) isStartSoft_.store(false, std::memory_order_relaxed);
    }

    std::int32_t gainAtEnd(std::size_t j) noexcept {
        const std::int32_t target = targetVolume_[j].load(std::memory_order_relaxed);
        volumeGain_[j] += std::clamp(target - volumeGain_[j], -volumeStep, volumeStep);
        return product(product(product(volumeGain_[j], ceilingGain_), gateGain_), guard_.gainAtEnd(j));
    }

    // Scales and clips one channel of a tile. Returns the sum of its samples, which the guard needs.
    std::int32_t applyGain(Tile<channels>& tile, std::size_t j, std::int32_t from, std::int32_t end,
                           bool& isClipped) noexcept {
        std::int32_t sum = 0;
        const std::int32_t maxSample = ceiling();
        if (from == unity && end == unity && maxSample == fullScale) { // the common case
            for (auto& frame : tile) {
                isClipped = isClipped || frame[j] < -fullScale;
                frame[j] = std::max<std::int16_t>(frame[j], -fullScale);
                sum += frame[j];
            }
            return sum;
        }
        auto gain = static_cast<std::uint32_t>(from * tileFrames); // times tileFrames: the ramp ends exactly
        for (auto& frame : tile) {
            gain += static_cast<std::uint32_t>(end - from);
            // Rounded towards zero, so that a faint signal ends in zeros.
            const std::int32_t scaled = frame[j] * static_cast<std::int32_t>(gain / tileFrames) / unity;
            const std::int32_t clamped = std::clamp<std::int32_t>(scaled, -maxSample, maxSample);
            isClipped = isClipped || clamped != scaled;
            frame[j] = static_cast<std::int16_t>(clamped);
            sum += clamped;
        }
        return sum;
    }
    FixedGuard<channels> guard_;
    GapCrossfade<channels> crossfade_;
    std::array<std::int32_t, static_cast<std::size_t>(channels)> volumeGain_{}, startGain_{};
    std::array<std::atomic<std::int32_t>, static_cast<std::size_t>(channels)> targetVolume_{};
    State state_ = State::waiting;
    std::int32_t gateGain_ = 0, ceilingGain_ = lowCeiling;
    int idleTiles_ = 0, amplifierTiles_ = 0;
    std::uint32_t lastWritten_ = 0, lastPermissionCount_ = 0, unattendedTiles_ = 0;
    std::atomic<std::int32_t> targetCeilingGain_{lowCeiling}, ceiling_{product(fullScale, lowCeiling)};
    std::atomic<bool> isAllowed_{false}, isPlaying_{false}, isAmplifierOn_{false}, isStartSoft_{true};
    std::atomic<std::uint32_t> tiles_{0}, underruns_{0}, limitedTiles_{0}, permissionCount_{0};
};

} // namespace physvib::pico
