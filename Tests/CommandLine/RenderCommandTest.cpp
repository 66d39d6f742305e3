// SPDX-License-Identifier: GPL-3.0-or-later
// `physvib render` as users and scripts hold on to it: files, bytes, exit codes, refusals.
#include "Calls.h"
#include "Scene/EventsCsv.h"
#include "Support/ClosedForm.h"
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <tuple>

namespace physvib::render_command_test {

using Render = test::CommandLine;

const std::string oneHit = "0.1,205,30,0.5,0.06,0.03\n";

std::string layoutOf(int count) {
    std::string text = R"({"name":"many","extent_m":[1,1],"enchanters":[)";
    for (int j = 0; j < count; ++j)
        text += (j ? "," : "") + std::string{R"({"x_m":)"} + std::to_string((j % 8) / 8.0) + R"(,"y_m":)" +
                std::to_string((j / 8) / 9.0) + "}";
    return text + "]}";
}

// Where the samples of a WAV file begin, and what its format chunk says.
struct Wav {
    int formatTag = 0, channels = 0, rate = 0, bits = 0;
    std::uint32_t speakerMask = 0;
    std::string samples;
    explicit Wav(const std::string& bytes) {
        const auto number = [&](std::size_t at, std::size_t size) {
            std::uint32_t value = 0;
            std::memcpy(&value, bytes.data() + at, size);
            return value;
        };
        for (std::size_t at = 12; at + 8 <= bytes.size();
             at += 8 + number(at + 4, 4) + number(at + 4, 4) % 2) {
            const std::string id = bytes.substr(at, 4);
            if (id == "data") samples = bytes.substr(at + 8, number(at + 4, 4));
            if (id != "fmt ") continue;
            formatTag = static_cast<int>(number(at + 8, 2));
            channels = static_cast<int>(number(at + 10, 2));
            rate = static_cast<int>(number(at + 12, 4));
            bits = static_cast<int>(number(at + 22, 2));
            if (formatTag == 0xFFFE) speakerMask = number(at + 28, 4);
        }
    }
};

TEST_F(Render, SceneLeavesFourChannelsEventsAndAPicture) {
    const auto outcome = runs("render shake-the-box --seconds 4 --out a.wav --events a.csv --picture a.png");
    EXPECT_EQ(outcome.err, "");
    const Wav wav{read("a.wav")};
    EXPECT_EQ(wav.channels, 4);
    EXPECT_EQ(wav.rate, 48000);
    EXPECT_EQ(wav.bits, 32);
    EXPECT_EQ(wav.formatTag, 0xFFFE);
    EXPECT_EQ(wav.speakerMask, 0u);
    EXPECT_EQ(wav.samples.size(), 4u * 48000 * 4 * 4);
    const auto events = readEventsCsv(read("a.csv"), "a.csv");
    ASSERT_TRUE(events) << events.error;
    EXPECT_GT(events.value.events.size(), 10u);
    EXPECT_EQ(read("a.png").substr(1, 3), "PNG");
    EXPECT_EQ(files().size(), 3u);
}

TEST_F(Render, BlockSizeAndRepetitionDoNotChangeAByte) {
    runs("render shake-the-box --seconds 3 --out r.wav --events r.csv");
    for (const char* block : {"1", "17", "64", "441", "4096", "256"}) {
        runs(std::string{"render shake-the-box --seconds 3 --out b.wav --events b.csv --block "} + block);
        EXPECT_EQ(read("b.wav"), read("r.wav")) << block;
        EXPECT_EQ(read("b.csv"), read("r.csv")) << block;
        runs(std::string{"render --from-events r.csv --field 6.4,3.6 --seconds 3 --out l.wav --block "} +
             block);
        EXPECT_EQ(Wav{read("l.wav")}.samples, Wav{read("r.wav")}.samples)
            << "the list renders as its scene did";
    }
}

TEST_F(Render, AFileFromAListIsTheClosedFormOfThatList) {
    auto events = test::randomEvents(2000, 2.5, 21);
    write("hits.csv", eventsCsv(events, {}, {"0", {}}));
    const auto corner = [](double u) { return std::clamp(1 - std::abs(u), 0.0, 1.0); };
    const auto gains = [&](double x, double y, double* g) { // Eq. 6.2 by hand: A upper left ... D lower right
        for (int j = 0; j < 4; ++j) g[j] = corner(x - j % 2) * corner(y - (j < 2 ? 1 : 0));
    };
    for (const int rate : {5000, 44100}) {
        runs("render --from-events hits.csv --field 1,1 --seconds 3 --limiter off --out a.wav --rate " +
             std::to_string(rate));
        const auto channels = channelsOf("a.wav");
        ASSERT_EQ(channels.size(), 4u);
        ASSERT_EQ(channels[3].size(), static_cast<std::size_t>(3 * rate));
        EXPECT_LE(test::relativeError(test::closedForm(events, rate, 4, 3 * rate, gains), channels), 1e-6);
    }
}

TEST_F(Render, AnotherSeedIsAnotherCourse) {
    runs("render shake-the-box --seconds 3 --events a.csv");
    runs("render shake-the-box --seconds 3 --events b.csv --seed 2");
    EXPECT_NE(read("a.csv"), read("b.csv"));
}

TEST_F(Render, ReleaseTimingFeelsTheSameFallLaterAndPrintsSo) {
    const std::string fall = "render drop --set height=1 --seed 0 --seconds 0.6 --events ";
    runs(fall + "onset.csv");
    runs(fall + "release.csv --timing release");
    const auto onset = readEventsCsv(read("onset.csv"), "onset.csv"),
               release = readEventsCsv(read("release.csv"), "release.csv");
    ASSERT_EQ(onset.value.events.size(), 1u) << onset.error;
    ASSERT_EQ(release.value.events.size(), 1u) << release.error;
    EXPECT_GT(release.value.events[0].timeNs, onset.value.events[0].timeNs);
    EXPECT_LE(release.value.events[0].timeNs, onset.value.events[0].timeNs + 50'000'000);
    EXPECT_NEAR(release.value.events[0].amplitude, onset.value.events[0].amplitude,
                0.05 * onset.value.events[0].amplitude);
    EXPECT_TRUE(has(read("release.csv"), "timing=release"));
}

TEST_F(Render, FixtureLocationPutsEveryHitAtTheCentreOfItsFixture) {
    runs("render drop --seed 3 --seconds 3 --events contact.csv");
    runs("render drop --seed 3 --seconds 3 --events fixture.csv --location fixture");
    const auto contact = readEventsCsv(read("contact.csv"), "contact.csv"),
               fixture = readEventsCsv(read("fixture.csv"), "fixture.csv");
    ASSERT_GE(fixture.value.events.size(), 3u) << fixture.error;
    ASSERT_EQ(contact.value.events.size(), fixture.value.events.size());
    for (std::size_t i = 0; i < fixture.value.events.size(); ++i) {
        EXPECT_NEAR(fixture.value.events[i].x, 4.0, 1e-6); // the plate's centre
        EXPECT_NEAR(fixture.value.events[i].y, 0.15, 1e-6);
        EXPECT_NEAR(contact.value.events[i].y, 0.3, 0.02); // its upper side
        EXPECT_EQ(fixture.value.events[i].amplitude, contact.value.events[i].amplitude);
        EXPECT_EQ(fixture.value.events[i].timeNs, contact.value.events[i].timeNs);
    }
    EXPECT_TRUE(has(read("fixture.csv"), "location=fixture"));
}

TEST_F(Render, LayoutDecidesTheNumberOfChannels) {
    writeHits("hits.csv", oneHit);
    for (const auto& [layout, channels] : {std::pair{"phone1", 1}, {"ring2", 2}, {"phone3", 3}}) {
        runs(std::string{"render --from-events hits.csv --seconds 0.2 --out a.wav --layout "} + layout);
        EXPECT_EQ(Wav{read("a.wav")}.channels, channels);
    }
    write("many.json", layoutOf(64));
    runs("render --from-events hits.csv --seconds 0.2 --out a.wav --layout many.json");
    EXPECT_EQ(Wav{read("a.wav")}.channels, 64);
}

TEST_F(Render, BadEventListsAreNamedByLineAndColumn) {
    const std::string call = "render --from-events hits.csv --out a.wav --events a.csv --picture a.png";
    const auto refusesRow = [&](const std::string& rows, const std::string& words) {
        writeHits("hits.csv", rows);
        refuses(call, 1, words, 1);
    };
    refusesRow("0.1,nan,30,0.5,0,0\n", "hits.csv:2: column frequency_hz");
    refusesRow("0.1,205,-3,0.5,0,0\n", "hits.csv:2: column decay_per_s");
    refusesRow("0.1,205,30,inf,0,0\n", "hits.csv:2: column amplitude");
    refusesRow("0.1,205,30,0.5,0,0\n0.2,205,30\n", "hits.csv:3");
    refusesRow("0.2,205,30,0.5,0,0\n0.1,205,30,0.5,0,0\n", "hits.csv:3: column time_s");
    refusesRow("0.1,205,0,0.5,0,0\n", "hits.csv:2");
    refusesRow("", "hits.csv");
    refusesRow("0.1,30000,30,0.5,0,0\n", "frequency_hz");
    write("hits.csv", "");
    refuses(call, 1, "hits.csv", 1);
    refuses("render --from-events none.csv --out a.wav", 1, "none.csv", 1);
}

TEST_F(Render, FrequenciesAboveHalfTheRateAreRefused) {
    writeHits("hits.csv", "0.1,3000,30,0.5,0,0\n");
    refuses("render --from-events hits.csv --rate 5000 --out a.wav", 1, "2500", 1);
}

TEST_F(Render, BadLayoutsAreNamed) {
    writeHits("hits.csv", oneHit);
    write("many.json", layoutOf(65));
    refuses("render --from-events hits.csv --out a.wav --layout many.json", 1, "64", 2);
    refuses("render --from-events hits.csv --out a.wav --layout phone9", 1, "phone9", 2);
}

TEST_F(Render, BadOptionsAreUsageErrors) {
    const std::string good = "render shake-the-box --seconds 1 --out a.wav ";
    refuses(good + "--rate 1", 2, "5000 to 192000");
    refuses(good + "--rate 48000.5", 2, "--rate");
    refuses(good + "--block 0", 2, "1 to 8192");
    refuses(good + "--block 8193", 2, "1 to 8192");
    refuses(good + "--law quadratic", 2, "log-outer");
    refuses(good + "--exponent 0", 2, "--exponent");
    refuses(good + "--field 3", 2, "--field");
    refuses(good + "--field 3,-1", 2, "--field");
    refuses(good + "--seed -1", 2, "--seed");
    refuses(good + "--limiter maybe", 2, "--limiter");
    refuses(good + "--timing never", 2, "--timing");
    refuses(good + "--instructions fast", 2, "--instructions");
    refuses(good + "--location nowhere", 2, "--location");
    refuses(good + "--colour red", 2, "--colour");
    refuses("render shake-the-box --seconds nan --out a.wav", 2, "--seconds");
    refuses("render shake-the-box --seconds 0 --out a.wav", 2, "--seconds");
    refuses("render shake-the-box --seconds 80000 --rate 192000 --out a.wav", 2, "4 GB");
    refuses("render shake-the-box --steps-per-second 1 --out a.wav", 2, "--steps-per-second");
    refuses("render no-such-scene --out a.wav", 2, "no-such-scene");
    refuses("render shake-the-box", 2, "--out");
    refuses("render --out a.wav", 2, "scene");
    refuses("dance", 2, "dance");
    refuses("", 2, "");
}

TEST_F(Render, MethodsFixWhatTheirNamesSay) {
    runs("render drop --seconds 3 --out a.wav --events a.csv");
    runs("render drop --seconds 3 --method AV-FV-DRV --out b.wav --events b.csv");
    EXPECT_EQ(read("b.wav"), read("a.wav"));
    EXPECT_EQ(read("b.csv"), read("a.csv"));
    const auto outcome = runs("render drop --seconds 3 --method AF-FF-DRF --out c.wav --events c.csv");
    EXPECT_TRUE(has(outcome.err,
                    "fixed level of 1.5 g is above the actuators' full scale of 1 g; the limiter lowers it"));
    const auto varied = readEventsCsv(read("a.csv"), "a.csv"), fixed = readEventsCsv(read("c.csv"), "c.csv");
    ASSERT_EQ(fixed.value.events.size(), varied.value.events.size());
    ASSERT_FALSE(fixed.value.events.empty());
    for (std::size_t i = 0; i < fixed.value.events.size(); ++i) {
        const CollisionEvent& e = fixed.value.events[i];
        EXPECT_EQ(std::tuple(e.amplitude, e.frequencyHz, e.decayPerSecond, e.durationNs),
                  std::tuple(1.5, 250.0, 0.0, 20'000'000));
        EXPECT_EQ(std::tuple(e.timeNs, e.x, e.y, e.source),
                  std::tuple(varied.value.events[i].timeNs, varied.value.events[i].x,
                             varied.value.events[i].y, varied.value.events[i].source));
    }
    EXPECT_TRUE(has(read("c.csv").substr(0, 200), "method=AF-FF-DRF"));
    runs("render --from-events a.csv --seconds 3 --field 9,5 --method AF-FF-DRF --out d.wav");
    runs("render --from-events c.csv --seconds 3 --field 9,5 --out e.wav");
    EXPECT_EQ(Wav{read("d.wav")}.samples, Wav{read("e.wav")}.samples)
        << "what is written is what is rendered";
}

TEST_F(Render, AFixedLevelIsInG) {
    const std::string start =
        R"({"extent_m":[1,1],"enchanters":[{"x_m":0,"y_m":0.5,"full_scale_g":3},{"x_m":1,"y_m":0.5,"full_scale_g":)";
    write("strong.json", start + "3}]}");
    write("mixed.json", start + "1}]}");
    const auto outcome =
        call("render drop --seconds 3 --method AF-FV-DRV --layout strong.json --events a.csv");
    EXPECT_EQ(outcome.err, "");
    const auto events = readEventsCsv(read("a.csv"), "a.csv");
    ASSERT_FALSE(events.value.events.empty());
    const CollisionEvent& first = events.value.events.front();
    const double omega = 2.0 * std::numbers::pi * first.frequencyHz,
                 peakAt = std::atan(omega / first.decayPerSecond) / omega;
    // 1.5 g of 3
    EXPECT_NEAR(first.amplitude * std::sin(omega * peakAt) * std::exp(-first.decayPerSecond * peakAt), 0.5,
                1e-9);
    refuses("render drop --method AF-FV-DRV --layout mixed.json --out b.wav", 1,
            "mixed.json: --method AF-FV-DRV: expected one full_scale_g for all actuators, found 3 and 1", 3);
    runs("render drop --seconds 1 --method AV-FF-DRF --layout mixed.json --events b.csv");
    refuses("render drop --method AF --out b.wav", 2,
            "--method: expected a name from AV-FV-DRV to AF-FF-DRF, or SV, found \"AF\"", 4);
    refuses("play drop --board /dev/none --method AF-FF-DRF", 2, "--board: not yet with --method", 4);
}

TEST_F(Render, UnwritableOutputsLeaveNothing) {
    refuses("render shake-the-box --seconds 1 --out a.wav --events none/a.csv", 1, "none/a.csv");
    refuses("render shake-the-box --seconds 1 --out none/a.wav", 1, "none/a.wav");
    refuses("render shake-the-box --seconds 1 --picture none/a.png --out a.wav", 1, "none/a.png");
}

TEST_F(Render, TwoOutputsInOneFileAreRefused) {
    refuses("render shake-the-box --seconds 1 --out a --events a", 2,
            "a: expected another file to write, this is the output a");
}

TEST_F(Render, EventsAfterTheEndAreTold) {
    writeHits("hits.csv", oneHit + "5,205,30,0.5,0.06,0.03\n");
    const auto outcome = runs("render --from-events hits.csv --seconds 1 --out a.wav");
    EXPECT_TRUE(has(outcome.err, "after the end"));
}

TEST_F(Render, HelpAndVersionAreNoErrors) {
    runs("--help");
    EXPECT_TRUE(has(call("render --help").out, "--from-events"));
    EXPECT_EQ(call("--version").out.rfind("physvib ", 0), 0u);
}

TEST_F(Render, ScenesAreListedOnePerLine) {
    const auto outcome = runs("scenes");
    EXPECT_EQ(outcome.out.rfind("shake-the-box", 0), 0u);
}

} // namespace physvib::render_command_test
