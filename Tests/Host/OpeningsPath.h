// SPDX-License-Identifier: GPL-3.0-or-later
// The way through an output that a program opens anew again and again, for GuardAttack.
#pragma once
#include "Live/Devices/DeviceGuard.h"
#include "Support/GuardAttack.h"

namespace physvib::test {

/// The clock that outputs keep what they had by: that of what is played.
class PlayedTime {
public:
    PlayedTime() {
        seconds_ += 100.0; // what other tests have played is over
        GuardMemory::now = [] {
            return GuardMemory::Clock::time_point{std::chrono::duration_cast<GuardMemory::Clock::duration>(
                std::chrono::duration<double>(seconds_))};
        };
    }
    ~PlayedTime() { GuardMemory::now = GuardMemory::Clock::now; }
    PlayedTime(const PlayedTime&) = delete;
    PlayedTime& operator=(const PlayedTime&) = delete;
    static void pass(double seconds) { seconds_ += seconds; }

private:
    static inline double seconds_ = 1000.0;
};

/// A PlayedTime lives meanwhile.
inline GuardPath openingsPath(int rate) {
    return {"openings", rate, [rate](std::vector<float> samples) {
                PlayedTime::pass(100.0);
                static constexpr std::array<double, 5> opens{0.0875, 0.225, 0.0416, 0.625, 0.1389};
                std::size_t next = 0;
                for (std::size_t n = 0, count; n < samples.size(); n += count) {
                    count = std::min(static_cast<std::size_t>(opens[next++ % opens.size()] * rate),
                                     samples.size() - n);
                    DeviceGuard guard;
                    guard.begin("A:one", {3}, rate);
                    std::array<float*, limits::maxActuators> at{};
                    at[0] = samples.data() + n;
                    guard.setChannel(0, 0);
                    guard.process(at.data(), static_cast<int>(count));
                    PlayedTime::pass(double(count) / rate); // before it gives back
                }
                return samples;
            }};
}

} // namespace physvib::test
