// SPDX-License-Identifier: GPL-3.0-or-later
// `physvib beats`: what it writes of a song, and what it refuses.
#include "Calls.h"
#include "Scene/EventsCsv.h"
#include "Support/BeatSong.h"
#include "Support/WavBytes.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace physvib::beats_command_test {

using test::BeatSong;
using test::Drum;

class BeatsCommand : public test::CommandLine {
protected:
    /// As 16 bits in each of so many channels.
    void writeSong(const BeatSong& song, std::uint16_t channels, std::uint32_t rateHz) {
        std::string bytes;
        for (const float sample : song.samples)
            for (int j = 0; j < channels; ++j) {
                const int value = static_cast<int>(std::lround(20000.0f * std::clamp(sample, -1.5f, 1.5f)));
                bytes.append({static_cast<char>(value & 255), static_cast<char>(value >> 8)});
            }
        write("song.wav", test::wavBytes({.channels = channels, .rateHz = rateHz}, bytes));
    }
};

TEST_F(BeatsCommand, WritesTheBeatsOfASongAsStrikesOnTheEnchantersOfTheirBands) {
    const BeatSong song{6.0, 44100, 7};
    writeSong(song, 2, 44100);
    runs("beats song.wav --out beats.csv --low C --strike-level 0.3");
    const auto events = readEventsCsv(read("beats.csv"), "beats.csv");
    ASSERT_EQ(events.error, "");
    EXPECT_EQ(events.value.field, (FieldSize{0.12, 0.06})) << "beats are struck on the layout";
    std::size_t found = 0;
    for (const auto& hit : song.hits)
        found += std::ranges::any_of(events.value.events,
                                     [&](const CollisionEvent& e) {
                                         return std::abs(1e-9 * static_cast<double>(e.timeNs) -
                                                         hit.seconds) <= 0.01;
                                     })
                     ? 1
                     : 0;
    EXPECT_GE(found * 100, song.hits.size() * 95);
    for (const CollisionEvent& e : events.value.events) {
        EXPECT_LE(e.amplitude, 0.3);
        // C: lower left; D: lower right
        const bool isLow = e.decayPerSecond == 15.0, isHigh = e.decayPerSecond == 60.0;
        EXPECT_TRUE(!(isLow || isHigh) || e.y == 0.0);
        EXPECT_TRUE(!isLow || e.x == 0.0);
    }
    runs("beats song.wav --out again.csv --low C --strike-level 0.3 --render felt.wav");
    EXPECT_EQ(read("again.csv"), read("beats.csv"));
    runs("render --from-events beats.csv --seconds 6 --rate 44100 --out rendered.wav");
    const auto samplesOf = [&](const std::string& name) {
        const std::string bytes = read(name);
        return bytes.substr(bytes.find("data") + 8, song.samples.size() * 16);
    };
    EXPECT_EQ(samplesOf("felt.wav"), samplesOf("rendered.wav")); // as any list of events
}

TEST_F(BeatsCommand, GivesTheMusicItselfToThoseWhoAreChosen) {
    const BeatSong song{3.0, 48000, 7};
    writeSong(song, 1, 48000);
    runs("beats song.wav --render through.wav --through --enchanters AC --layout ring4");
    const std::string bytes = read("through.wav"),
                      samples = bytes.substr(bytes.find("data") + 8, song.samples.size() * 16);
    std::array<float, 4> peaks{};
    for (std::size_t i = 0; i + 4 <= samples.size(); i += 4) {
        float sample = 0.0f;
        std::memcpy(&sample, samples.data() + i, 4);
        peaks[i / 4 % 4] = std::max(peaks[i / 4 % 4], std::abs(sample));
    }
    EXPECT_EQ(samples.size(), song.samples.size() * 16);
    EXPECT_GT(peaks[0], 0.1f);
    EXPECT_EQ(peaks[2], peaks[0]);
    EXPECT_EQ(peaks[1] + peaks[3], 0.0f);
}

// A square wave of full scale: without its overtones it is 4/pi of that.
TEST_F(BeatsCommand, TheMusicItselfIsAsLoudAsAskedAndNeverAboveFullScale) {
    BeatSong loud{0.5, 48000, 7};
    for (std::size_t i = 0; i < loud.samples.size(); ++i) loud.samples[i] = i / 120 % 2 == 0 ? 1.5f : -1.5f;
    writeSong(loud, 1, 48000);
    const auto ends = [&](const std::string& level) {
        runs("beats song.wav --through --layout phone1 --render felt.wav --strike-level " + level);
        const auto felt = channelsOf("felt.wav").at(0);
        return std::pair{*std::ranges::min_element(felt), *std::ranges::max_element(felt)};
    };
    const auto half = ends("0.5"), whole = ends("1");
    EXPECT_NEAR(half.first, -0.64f, 0.1f);
    EXPECT_NEAR(half.second, 0.64f, 0.1f);
    EXPECT_EQ(whole, (std::pair{-1.0f, 1.0f}));
}

TEST_F(BeatsCommand, TakesMoreThanARecordingMayHave) {
    const BeatSong song{2.0, 8000, 7};
    std::string part, whole;
    for (const float sample : song.samples)
        part += static_cast<char>(128 + std::lround(80.0f * std::clamp(sample, -1.5f, 1.5f)));
    for (int i = 0; i < 330; ++i) whole += part;
    write("evening.wav", test::wavBytes({.rateHz = 8000, .bits = 8}, whole));
    runs("beats evening.wav --render felt.wav --through --layout phone1");
    refuses("material evening.wav", 1, "expected at most 600 s, found 660 s", 2);
}

TEST_F(BeatsCommand, RefusesInOneLineAndLeavesNothing) {
    write("noise.wav", "no sound at all");
    write("silence.wav", test::wavBytes({}, std::string(96000, '\0')));
    write("slow.wav", test::wavBytes({.rateHz = 1000}, std::string(2000, '\1')));
    write("short.wav", test::wavBytes({.dataBytes = 50'000}, std::string(2000, '\1')));
    refuses("beats noise.wav --out beats.csv", 1,
            "noise.wav: expected a WAV, AIFF, FLAC, Ogg Vorbis or Opus file", 4);
    refuses("beats silence.wav --out beats.csv", 1, "silence.wav: expected beats, found none", 4);
    refuses("beats slow.wav --render felt.wav", 1,
            "slow.wav: expected a rate of 5000 to 192000 Hz, found 1000 Hz", 4);
    refuses("beats short.wav --through --render felt.wav", 1, "it ends early", 4);
    refuses("beats none.wav --out beats.csv", 1, "none.wav: cannot be read", 4);
    refuses("beats silence.wav", 2, "give --out or --render", 4);
    refuses("beats silence.wav --out silence.wav", 2, "silence.wav", 4);
    refuses("beats silence.wav --out beats.csv --low E", 2, "--low: expected letters of the 4 actuators", 4);
    refuses("beats silence.wav --out beats.csv --strike-hz 1,2", 2,
            "--strike-hz: expected one frequency or three", 4);
    refuses("beats silence.wav --out beats.csv --band 50-500", 2, "expected with --through", 4);
    refuses("beats silence.wav --render felt.wav --through --band 500", 2, "--band: expected LO-HI", 4);
    refuses("beats silence.wav --render felt.wav --through --enchanters AX", 2,
            "--enchanters: expected letters", 4);
    refuses("play shake-the-box --device none --beats 0", 2, "--beats: expected inputs like 1,2", 4);
}

} // namespace physvib::beats_command_test
