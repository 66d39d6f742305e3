// SPDX-License-Identifier: MIT
// OutputGuard at the device output, for every session that plays there, and a memory of its state per output.
// The state of an output is kept when another actuator plays there, when the block size or sample rate of the
// device changes and when the device is opened again, because a program may open a device for each hit.
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
struct KeptGuardSums {
    struct Output {
        std::size_t device; ///< hash of its name
        int output;         ///< from 0
        bool operator==(const Output&) const = default;
    };
    Output output{0, -1};
    GuardSums sums{};
    std::chrono::steady_clock::time_point since{};
};

/// Guard states of all outputs on which nothing plays at present, for this process. Two sessions that play on
/// one output at the same time have a guard each. M.
class GuardMemory {
public:
    using Clock = std::chrono::steady_clock;
    using Kept = KeptGuardSums;
    static inline Clock::time_point (*now)() = Clock::now; ///< tests set it

    /// Stores an output's state, replacing the one of time `since`; combines it with any other.
    static void keep(const std::string& device, int output, GuardSums sums,
                     Clock::time_point since = {}) noexcept {
        const std::lock_guard lock{mutex_};
        const Kept::Output key{std::hash<std::string>{}(device), output};
        Kept* at = find(key);
        if (at != nullptr && at->since != since)
            sums = most(sums, aged(*at));
        else if (at == nullptr)
            at = std::ranges::min_element(kept_, {}, &Kept::since); // empty, or the oldest
        *at = {key, sums, now()};
    }
    /// The stored state of an output, decayed to the present. It remains stored for later users.
    static Kept at(const std::string& device, int output) noexcept {
        const std::lock_guard lock{mutex_};
        const Kept* const found = find({std::hash<std::string>{}(device), output});
        return found != nullptr ? Kept{found->output, aged(*found), found->since} : Kept{};
    }

private:
    static Kept* find(const Kept::Output& output) noexcept {
        const auto at = std::ranges::find(kept_, output, &Kept::output);
        return at != kept_.end() ? &*at : nullptr;
    }
    static GuardSums most(const GuardSums& a, const GuardSums& b) noexcept {
        const GuardSums& more = a.load > b.load ? a : b;
        return {std::max(a.high, b.high), std::min(a.low, b.low), more.slow, more.speed, more.load,
                std::min(a.rest, b.rest)};
    }
    // The stored state after silence from then until now.
    static GuardSums aged(const Kept& kept) noexcept {
        constexpr int tilesPerSecond = 3000, forgotten = 8 * tilesPerSecond;
        const double seconds = std::chrono::duration<double>(now() - kept.since).count();
        const int tiles = static_cast<int>(std::clamp(seconds * tilesPerSecond, 0.0, 1.0 * forgotten));
        if (tiles == forgotten) return {};
        GuardLaw<1> law;
        law.prepare(1, GuardPlace::last);
        law.setTile(1.0f / tilesPerSecond);
        law.recall(0, kept.sums);
        for (int n = 0; n < tiles; ++n) law.take({});
        return law.sums(0);
    }

    static inline std::mutex mutex_;
    static inline std::array<Kept, 4 * limits::maxEnchanters> kept_{};
};

class DeviceGuard {
public:
    DeviceGuard() noexcept { at_.fill(none); }
    ~DeviceGuard() { giveBack(); }
    DeviceGuard(const DeviceGuard&) = delete;
    DeviceGuard& operator=(const DeviceGuard&) = delete;

    /// Prepares for blocks of that device with these outputs. M, while the device is stopped.
    void begin(const std::string& device, const ChannelSet& outputs, int sampleRateHz) {
        giveBack();
        device_ = device;
        outputs_.assign(outputs.begin(), outputs.end());
        std::array<GuardSums, width> sums;
        std::size_t count = 0;
        since_.fill({});
        for (std::size_t k = 0; k < outputs_.size() && count < width; ++k)
            if (const auto had = GuardMemory::at(device_, outputs_[k]); had.sums.load > 0.0f) {
                sums[count] = had.sums, since_[count] = had.since;
                channelAt_[count++] = static_cast<int>(k);
            }
        at_.fill(none);
        guard_.prepare(sampleRateHz, static_cast<int>(count), GuardPlace::last);
        if (count > 0) guard_.recall(sums.data());
    }
    /// Stores the state of all outputs in GuardMemory. M, when the render thread has left.
    void giveBack() noexcept {
        for (std::size_t c = 0; c < guard_.channels(); ++c)
            if (const auto k = static_cast<std::size_t>(channelAt_[c]); k < outputs_.size())
                if (const auto sums = guard_.sums(c); sums.load > 0.0f)
                    GuardMemory::keep(device_, outputs_[k], sums, since_[c]);
        outputs_.clear();
    }

    /// Sets that actuator j plays on that channel of the callback. R.
    void follow(int j, int channel) noexcept {
        std::size_t& at = at_[static_cast<std::size_t>(j)];
        const std::size_t count = guard_.channels();
        if (at < count && channelAt_[at] == channel) return;
        at = none;
        std::size_t c = 0;
        while (c < count && channelAt_[c] != channel) ++c;
        if (c == width) // more outputs than it has channels: takes over what one that rests has had
            for (c = 0; std::ranges::find(at_, c) != at_.end();) ++c;
        if (c == count) guard_.widen();
        channelAt_[c] = channel;
        at = c;
    }
    /// Applies OutputGuard to actuator j's samples io[j]; null: it does not play. R, wait-free.
    void process(float* const* io, int frames) noexcept {
        std::array<float*, width> out{};
        for (std::size_t j = 0; j < width; ++j)
            io[j] != nullptr ? void(out[at_[j]] = io[j]) : void(at_[j] = none);
        guard_.process(out.data(), frames);
        gain_.store(guard_.gain(), std::memory_order_relaxed);
        episodes_.store(guard_.episodes(), std::memory_order_relaxed);
    }
    float gain() const noexcept { return gain_.load(std::memory_order_relaxed); } ///< any thread
    std::uint64_t episodes() const noexcept {
        return episodes_.load(std::memory_order_relaxed);
    } ///< any thread
    /// Whether `episodes`, the sum over this and other guards, has grown since the last call. M.
    bool hasNews(std::uint64_t episodes) noexcept { return std::exchange(told_, episodes) < episodes; }

private:
    static constexpr std::size_t width = limits::maxEnchanters, none = width;

    OutputGuard guard_;
    std::string device_;
    std::vector<int> outputs_;                                  // of the device, per channel of its callback
    std::array<int, width> channelAt_{};                        // of the callback, per channel of the guard
    std::array<GuardMemory::Clock::time_point, width> since_{}; // when what it went on from was kept
    std::array<std::size_t, width> at_{}; // channel of the guard, per actuator that plays
    std::atomic<float> gain_{1.0f};
    std::atomic<std::uint32_t> episodes_{0};
    std::uint64_t told_ = 0;
};

} // namespace physvib
