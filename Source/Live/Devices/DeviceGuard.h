// SPDX-License-Identifier: MIT
// DeviceGuard applies OutputGuard to the outputs of a device; GuardMemory stores its state per output. So the
// state survives a change of actuator, block size or sample rate, and a reopening of the device: a program
// may open a device for each hit. M is the message thread, R the render thread.
#pragma once
#include "Core/Actuators/OutputGuard.h"
#include "Live/Devices/AudioDevice.h"
#include <array>
#include <atomic>
#include <chrono>
#include <functional>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace physvib {

/// The guard's state of one output, and the time at which it was stored.
struct StoredGuardSums {
    struct Output {
        std::size_t device; ///< hash of its name
        int output;         ///< from 0
        bool operator==(const Output&) const = default;
    };
    Output output{0, -1};
    GuardSums sums{};
    std::chrono::steady_clock::time_point storedAt{};
};

/// The guard states of outputs on which nothing plays now, for the whole process. Two sessions that play on
/// one output at the same time have a guard each. M.
class GuardMemory {
public:
    using Clock = std::chrono::steady_clock;
    using Stored = StoredGuardSums;
    static inline Clock::time_point (*now)() = Clock::now; ///< tests set it

    /// Stores an output's state: replaces the one stored at `storedAt`, but combines with a later one.
    static void store(const std::string& device, int output, GuardSums sums,
                      Clock::time_point storedAt = {}) noexcept {
        const std::lock_guard lock{mutex_};
        const Stored::Output key{std::hash<std::string>{}(device), output};
        Stored* slot = find(key);
        if (slot != nullptr && slot->storedAt != storedAt)
            sums = combinedSums(sums, decayedSums(*slot));
        else if (slot == nullptr)
            slot = std::ranges::min_element(stored_, {}, &Stored::storedAt); // empty, or the oldest
        *slot = {key, sums, now()};
    }
    /// The stored state of an output, decayed to the present. It remains stored for later users.
    static Stored storedFor(const std::string& device, int output) noexcept {
        const std::lock_guard lock{mutex_};
        const Stored* const found = find({std::hash<std::string>{}(device), output});
        return found != nullptr ? Stored{found->output, decayedSums(*found), found->storedAt} : Stored{};
    }

private:
    static Stored* find(const Stored::Output& output) noexcept {
        const auto slot = std::ranges::find(stored_, output, &Stored::output);
        return slot != stored_.end() ? &*slot : nullptr;
    }
    static GuardSums combinedSums(const GuardSums& a, const GuardSums& b) noexcept {
        const GuardSums& stronger = a.load > b.load ? a : b;
        return {std::max(a.high, b.high), std::min(a.low, b.low), stronger.slow,
                stronger.speed,           stronger.load,          std::min(a.rest, b.rest)};
    }
    // The stored state after silence from then until now, in steps of 1/3000 s; after 8 s nothing is left.
    static GuardSums decayedSums(const Stored& stored) noexcept {
        constexpr int tilesPerSecond = 3000, maxTiles = 8 * tilesPerSecond;
        const double seconds = std::chrono::duration<double>(now() - stored.storedAt).count();
        const int tiles = static_cast<int>(std::clamp(seconds * tilesPerSecond, 0.0, 1.0 * maxTiles));
        if (tiles == maxTiles) return {};
        GuardLaw<1> law;
        law.prepare(1, GuardPlace::last);
        law.setTile(1.0f / tilesPerSecond);
        law.restore(0, stored.sums);
        for (int n = 0; n < tiles; ++n) law.update({});
        return law.sums(0);
    }

    static inline std::mutex mutex_;
    static inline std::array<Stored, 4 * limits::maxActuators> stored_{};
};

/// The OutputGuard of one device; its channels are given to actuators as they begin to play.
class DeviceGuard {
public:
    DeviceGuard() noexcept { guardChannels_.fill(none); }
    ~DeviceGuard() { storeSums(); }
    DeviceGuard(const DeviceGuard&) = delete;
    DeviceGuard& operator=(const DeviceGuard&) = delete;

    /// Prepares for blocks of that device, and restores its outputs' states. M, while the device is stopped.
    void begin(const std::string& device, const ChannelSet& outputs, int sampleRateHz) {
        storeSums();
        device_ = device;
        outputs_.assign(outputs.begin(), outputs.end());
        std::array<GuardSums, maxChannels> sums;
        std::size_t count = 0;
        storedAt_.fill({});
        for (std::size_t k = 0; k < outputs_.size() && count < maxChannels; ++k)
            if (const auto stored = GuardMemory::storedFor(device_, outputs_[k]); stored.sums.load > 0.0f) {
                sums[count] = stored.sums, storedAt_[count] = stored.storedAt;
                channels_[count++] = static_cast<int>(k);
            }
        guardChannels_.fill(none);
        guard_.prepare(sampleRateHz, static_cast<int>(count), GuardPlace::last);
        if (count > 0) guard_.restore(sums.data());
    }
    /// Stores the state of all outputs in GuardMemory. M, when the render thread has left.
    void storeSums() noexcept {
        for (std::size_t c = 0; c < guard_.channels(); ++c)
            if (const auto k = static_cast<std::size_t>(channels_[c]); k < outputs_.size())
                if (const auto sums = guard_.sums(c); sums.load > 0.0f)
                    GuardMemory::store(device_, outputs_[k], sums, storedAt_[c]);
        outputs_.clear();
    }

    /// Sets that actuator j plays on that channel of the callback. R.
    void setChannel(int j, int channel) noexcept {
        std::size_t& guardChannel = guardChannels_[static_cast<std::size_t>(j)];
        const std::size_t count = guard_.channels();
        if (guardChannel < count && channels_[guardChannel] == channel) return;
        guardChannel = none;
        std::size_t c = 0;
        while (c < count && channels_[c] != channel) ++c;
        if (c == maxChannels) { // all are used: takes that of least load among those without an actuator
            for (std::size_t free = 0; free < count; ++free)
                if (std::ranges::find(guardChannels_, free) == guardChannels_.end() &&
                    (c == none || guard_.load(free) < guard_.load(c)))
                    c = free;
            storedAt_[c] = {};
        }
        if (c == count) guard_.addChannel();
        channels_[c] = channel;
        guardChannel = c;
    }
    /// Applies OutputGuard to actuator j's samples io[j]; null: it does not play. R, wait-free.
    void process(float* const* io, int frames) noexcept {
        std::array<float*, maxChannels> out{};
        for (std::size_t j = 0; j < maxChannels; ++j)
            io[j] != nullptr ? void(out[guardChannels_[j]] = io[j]) : void(guardChannels_[j] = none);
        guard_.process(out.data(), frames);
        gain_.store(guard_.gain(), std::memory_order_relaxed);
        episodes_.store(guard_.episodes(), std::memory_order_relaxed);
    }
    float gain() const noexcept { return gain_.load(std::memory_order_relaxed); } ///< any thread
    /// Any thread.
    std::uint64_t episodes() const noexcept { return episodes_.load(std::memory_order_relaxed); }
    /// Whether `episodes`, the sum over this and other guards, has grown since the last call. M.
    bool hasNewEpisodes(std::uint64_t episodes) noexcept {
        return std::exchange(episodesReported_, episodes) < episodes;
    }

private:
    static constexpr std::size_t maxChannels = limits::maxActuators, none = maxChannels;

    OutputGuard guard_;
    std::string device_;
    std::vector<int> outputs_;                // of the device, per channel of its callback
    std::array<int, maxChannels> channels_{}; // of the callback, per channel of the guard
    std::array<GuardMemory::Clock::time_point, maxChannels> storedAt_{}; // when the state was stored
    std::array<std::size_t, maxChannels> guardChannels_{}; // channel of the guard, per actuator that plays
    std::atomic<float> gain_{1.0f};
    std::atomic<std::uint32_t> episodes_{0};
    std::uint64_t episodesReported_ = 0;
};

} // namespace physvib
