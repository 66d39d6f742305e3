// SPDX-License-Identifier: MIT
// What the outputs of devices still hold of what this process has sent to them, while nobody plays there: a
// program may open a device anew for each hit. Two who play on one output at the same time have a guard each.
#pragma once
#include "Core/Actuators/OutputGuard.h"
#include <chrono>
#include <functional>
#include <mutex>
#include <string>

namespace physvib {

/// What one output has had, and when that was.
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

/// M.
class GuardMemory {
public:
    using Clock = std::chrono::steady_clock;
    using Kept = KeptGuardSums;
    static inline Clock::time_point (*now)() = Clock::now; ///< tests set it

    /// Of an output, from 0; of two, what is more of each.
    static void keep(const std::string& device, int output, GuardSums sums) noexcept {
        const std::lock_guard lock{mutex_};
        const Kept::Output key{std::hash<std::string>{}(device), output};
        Kept* at = find(key);
        if (at != nullptr)
            sums = most(sums, aged(*at));
        else
            at = std::ranges::min_element(kept_, {}, &Kept::since); // empty, or the oldest
        *at = {key, sums, now()};
    }
    /// What is left by now; it stays until it has decayed, for others who open that output.
    static GuardSums at(const std::string& device, int output) noexcept {
        const std::lock_guard lock{mutex_};
        const Kept* const found = find({std::hash<std::string>{}(device), output});
        return found != nullptr ? aged(*found) : GuardSums{};
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
    // As after silence for that long.
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

} // namespace physvib
