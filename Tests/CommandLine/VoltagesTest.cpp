// SPDX-License-Identifier: GPL-3.0-or-later
// A file for an interface of so many volts: each channel by its own actuator's limit.
#include "Calls.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace physvib::test {
namespace {

class Voltages : public CommandLine {
protected:
    std::string actuator(const std::string& name, double volts) const {
        return R"({"physvib_actuator": 1, "name": ")" + name +
               R"(", "description": "of a test", "source": "made up", "kind": "linear", "resonance_hz": 200, "q": 10, "band_hz": [100, 400], "drive_limit_v": )" +
               std::to_string(volts) + R"(, "rise_time_s": null, "full_scale_g": null, "delay_s": null})";
    }
    std::array<float, 3> peaksOf(const std::string& options) const {
        const Outcome outcome =
            call("render --from-events hits.csv --layout layout.json --actuator layout --equalise off "
                 "--limiter off --rate 8000 --seconds 0.5 --out a.wav " +
                 options);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        const std::string wav = read("a.wav");
        constexpr std::size_t frames = 4000, channels = 3;
        std::array<float, 3> peaks{};
        for (std::size_t n = 0; n < frames * channels && wav.size() > 4 * frames * channels; ++n) {
            float sample = 0.0f;
            std::memcpy(&sample, wav.data() + wav.size() - 4 * (frames * channels - n), 4);
            peaks[n % channels] = std::max(peaks[n % channels], std::abs(sample));
        }
        return peaks;
    }
};

TEST_F(Voltages, ScaleEachChannelByItsOwnActuator) {
    write("a.json", actuator("mine-a", 2.0));
    write("b.json", actuator("mine-b", 4.0));
    write("c.json", actuator("mine-c", 1.0));
    write("layout.json",
          R"({"extent_m": [0.2, 0.1], "enchanters": [{"x_m": 0, "y_m": 0, "actuator": "a.json"}, )"
          R"({"x_m": 0.1, "y_m": 0, "actuator": "b.json"}, {"x_m": 0.2, "y_m": 0, "actuator": "c.json"}]})");
    write("hits.csv", "time_s,frequency_hz,decay_per_s,amplitude,x_m,y_m\n0.01,200,10,0.5,0,0\n"
                      "0.02,200,10,0.5,0.1,0\n0.03,200,10,0.5,0.2,0\n");
    const auto plain = peaksOf("");
    for (const double volts : {4.0, 8.0, 20.0}) {
        const auto scaled = peaksOf("--interface-volts " + std::to_string(volts));
        const std::array limits{2.0, 4.0, 1.0};
        for (std::size_t j = 0; j < 3; ++j) {
            EXPECT_GT(plain[j], 0.1f);
            EXPECT_NEAR(scaled[j] / plain[j], limits[j] / volts, 1e-4)
                << "channel " << j << ", " << volts << " V";
        }
    }
    refuses("render --from-events hits.csv --layout layout.json --actuator layout --equalise off --out b.wav "
            "--interface-volts 3.99",
            1, "mine-b: expected an interface of at least 4 V", 6);
}

} // namespace
} // namespace physvib::test
