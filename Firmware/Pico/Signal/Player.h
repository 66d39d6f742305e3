// SPDX-License-Identifier: MIT
// The Pico's signal path: frames from USB to frames for the amplifiers, a tile at a time.
//
// Volume, then the gate (soft start, and ramped silence), then the guard, then the ceiling. Gains are decided
// at the ends of tiles and are linear in between. With gains of one, samples pass unchanged.
#pragma once
#include "FixedGuard.h"
#include "FrameBuffer.h"

namespace physvib::pico {

/// render: interrupt of the output. Everything else: main loop.
template <int channels>
class Player {
public:
    static constexpr int startTiles = tilesPerSecond / 10; // soft start: 100 ms
    static constexpr int stopTiles = 3;                    // ramp to silence, and from it after a pause: 1 ms
    static constexpr int quietTiles = 7;                   // 2.3 ms without a packet: the host stopped
    static constexpr int amplifierTiles = 6; // covers what the output still buffers, with a margin
    static constexpr std::int32_t volumeStep = unity * 100 / tilesPerSecond; // the whole range in 10 ms
    static constexpr std::int16_t fullScale = 32767;
    static constexpr std::int32_t lowCeiling = unity / 4; // -12 dB, for small actuators

    FrameBuffer<channels> buffer;

    /// Permits playing; false ramps to silence and stays there. It lapses if it is not renewed within
    /// quietTiles, so a hanging main loop ends the vibration as fast as a pulled cable does. Main loop.
    void allow(bool isAllowed) noexcept {
        allowed_.store(isAllowed, std::memory_order_relaxed);
        bump(renewals_);
    }
    /// Makes the next start take startTiles, like the first one and one after a hang of the main loop. Starts
    /// after a pause of a program are quick, to keep its next hit. Main loop, while not allowed.
    void startSoftly() noexcept { isStartSoft_.store(true, std::memory_order_relaxed); }
    /// If low (the initial state), samples are scaled to a quarter, and the ceiling is a quarter of full
    /// scale. The ceiling falls within a tile and rises as slowly as the soft start. Main loop.
    void setLowCeiling(bool isLow) noexcept {
        wantedScale_.store(isLow ? lowCeiling : unity, std::memory_order_relaxed);
    }
    /// Gain from 0 to unity. Main loop.
    void setVolume(int channel, std::int32_t gain) noexcept {
        volume_[static_cast<std::size_t>(channel)].store(gain, std::memory_order_relaxed);
    }

    /// Renders the next tile. Interrupt of the output.
    void render(Tile<channels>& tile) noexcept {
        step();
        moveCeiling();
        if (state_ == State::waiting) {
            tile = {};
        } else {
            fill(tile);
            moveGate();
        }
        typename FixedGuard<channels>::Sums sums{};
        bool clipped = false;
        for (std::size_t j = 0; j < sums.size(); ++j) {
            const std::int32_t end = gainAtEnd(j);
            if (state_ != State::waiting || from_[j] != 0) sums[j] = apply(tile, j, from_[j], end, clipped);
            from_[j] = end;
        }
        guard_.take(sums);
        if (clipped || guard_.gain() < unity) bump(limited_);
        if (state_ == State::stopping && gate_ == 0) {
            state_ = State::waiting;
            buffer.clear();
            dropped_.forget();
        }
        amplifier_ = state_ != State::waiting ? amplifierTiles : std::max(0, amplifier_ - 1);
        isPlaying_.store(state_ == State::playing, std::memory_order_relaxed);
        isAmplifierOn_.store(amplifier_ > 0, std::memory_order_relaxed);
        bump(tiles_);
    }

    /// Tiles since the main loop last called allow(). Interrupt of the output.
    std::uint32_t unattendedTiles() const noexcept { return unattended_; }
    bool isPlaying() const noexcept { return isPlaying_.load(std::memory_order_relaxed); } ///< any thread
    /// Whether something other than silence may be at the output. Any thread.
    bool isAmplifierOn() const noexcept { return isAmplifierOn_.load(std::memory_order_relaxed); }
    std::uint32_t tiles() const noexcept { return tiles_.load(std::memory_order_relaxed); } ///< any thread
    /// How often frames were missing while the host was sending. Any thread.
    std::uint32_t underruns() const noexcept { return underruns_.load(std::memory_order_relaxed); }
    /// Tiles in which guard or ceiling reduced the signal. Any thread.
    std::uint32_t limitedTiles() const noexcept { return limited_.load(std::memory_order_relaxed); }
    /// Largest sample that passes, of 32767. Any thread.
    std::int32_t ceiling() const noexcept { return ceiling_.load(std::memory_order_relaxed); }

private:
    enum class State { waiting, playing, stopping };

    static void bump(std::atomic<std::uint32_t>& counter) noexcept {
        counter.store(counter.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
    }

    void step() noexcept {
        const auto renewals = renewals_.load(std::memory_order_relaxed);
        unattended_ = renewals == lastRenewals_ ? unattended_ + 1 : 0;
        lastRenewals_ = renewals;
        const bool isAllowed = allowed_.load(std::memory_order_relaxed) && unattended_ < quietTiles;
        if (unattended_ >= quietTiles) isStartSoft_.store(true, std::memory_order_relaxed);
        const auto written = buffer.writtenFrames();
        quiet_ = written == lastWritten_ ? quiet_ + 1 : 0;
        lastWritten_ = written;
        if (state_ == State::playing && (!isAllowed || quiet_ >= quietTiles)) state_ = State::stopping;
        if (state_ != State::waiting) return;
        if (!isAllowed || quiet_ >= quietTiles)
            buffer.clear();
        else if (buffer.level() >= FrameBuffer<channels>::targetFrames)
            state_ = State::playing;
    }

    // Missing frames repeat the last one while the gate ramps to zero, because a step would be a click.
    void fill(Tile<channels>& tile) noexcept {
        const int count = buffer.read(tile, dropped_);
        if (count == tileFrames) return;
        for (int k = count; k < tileFrames; ++k) tile[static_cast<std::size_t>(k)] = dropped_.last();
        dropped_.miss(); // packets may come again before the gate is closed
        if (state_ != State::playing) return;
        bump(underruns_);
        state_ = State::stopping;
    }

    void moveCeiling() noexcept {
        const auto before = scale_, wanted = wantedScale_.load(std::memory_order_relaxed);
        scale_ = std::min(wanted, scale_ + unity / startTiles + 1);
        ceiling_.store(times(fullScale, std::max(before, scale_)), std::memory_order_relaxed);
    }

    void moveGate() noexcept {
        if (state_ != State::playing) {
            gate_ = std::max(std::int32_t{0}, gate_ - (unity / stopTiles + 1));
            return;
        }
        const bool isSoft = isStartSoft_.load(std::memory_order_relaxed);
        gate_ = std::min(unity, gate_ + unity / (isSoft ? startTiles : stopTiles) + 1);
        if (gate_ == unity) isStartSoft_.store(false, std::memory_order_relaxed);
    }

    std::int32_t gainAtEnd(std::size_t j) noexcept {
        const std::int32_t wanted = volume_[j].load(std::memory_order_relaxed);
        level_[j] += std::clamp(wanted - level_[j], -volumeStep, volumeStep);
        return times(times(times(level_[j], scale_), gate_), guard_.to(j));
    }

    // Scales and clips one channel of a tile. Returns the sum of its samples, which the guard needs.
    std::int32_t apply(Tile<channels>& tile, std::size_t j, std::int32_t from, std::int32_t end,
                       bool& clipped) noexcept {
        std::int32_t sum = 0;
        const std::int32_t most = ceiling();
        if (from == unity && end == unity && most == fullScale) { // usual case: unchanged
            for (auto& frame : tile) {
                clipped = clipped || frame[j] < -fullScale;
                frame[j] = std::max<std::int16_t>(frame[j], -fullScale);
                sum += frame[j];
            }
            return sum;
        }
        auto gain = static_cast<std::uint32_t>(from * tileFrames); // times tileFrames: the ramp ends exactly
        for (auto& frame : tile) {
            gain += static_cast<std::uint32_t>(end - from);
            // Rounded towards zero, so that a faint signal ends in zeros.
            const std::int32_t y = frame[j] * static_cast<std::int32_t>(gain / tileFrames) / unity;
            const std::int32_t held = std::clamp<std::int32_t>(y, -most, most);
            clipped = clipped || held != y;
            frame[j] = static_cast<std::int16_t>(held);
            sum += held;
        }
        return sum;
    }
    FixedGuard<channels> guard_;
    DroppedFrames<channels> dropped_;
    std::array<std::int32_t, static_cast<std::size_t>(channels)> level_{}, from_{};
    std::array<std::atomic<std::int32_t>, static_cast<std::size_t>(channels)> volume_{};
    State state_ = State::waiting;
    std::int32_t gate_ = 0, scale_ = lowCeiling;
    int quiet_ = 0, amplifier_ = 0;
    std::uint32_t lastWritten_ = 0, lastRenewals_ = 0, unattended_ = 0;
    std::atomic<std::int32_t> wantedScale_{lowCeiling}, ceiling_{times(fullScale, lowCeiling)};
    std::atomic<bool> allowed_{false}, isPlaying_{false}, isAmplifierOn_{false}, isStartSoft_{true};
    std::atomic<std::uint32_t> tiles_{0}, underruns_{0}, limited_{0}, renewals_{0};
};

} // namespace physvib::pico
