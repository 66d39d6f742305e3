// SPDX-License-Identifier: MIT
// Textures from scrapes: what our own engine was given comes out of what it plays; what is no scrape is told.
#include "Measure/TextureExtractor.h"
#include "Contacts/LastingContacts.h"
#include "Measure/HitExcerpt.h"
#include "Stimuli/SeededRandom.h"
#include "Support/Rendering.h"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

namespace physvib::texture_extractor_test {

constexpr int rate = 48'000;
constexpr double massKg = 5.0, newtons = 2.0;

/// What slides over a surface, as one enchanter plays it.
std::vector<float> scrape(const Texture& texture, double metresPerSecond, double frequencyHz,
                          double decayPerSecond, double length = 2.0) {
    HapticFixture ground{frequencyHz, decayPerSecond, true, massKg};
    ground.texture = texture;
    FixtureTable table;
    const std::int32_t surface = table.findOrAdd(std::uint64_t{11}, {.body = 1}),
                       slider = table.findOrAdd(std::uint64_t{12}, {.body = 2});
    table.set(surface, ground, {});
    LastingContacts lasting{table};
    std::vector<CollisionEvent> events;
    std::vector<Impact> impacts;
    constexpr double step = 0.01;
    constexpr std::int64_t stepNs = 10'000'000;
    for (std::int64_t n = 0; n < static_cast<std::int64_t>(length / step); ++n) {
        lasting.touch({.a = surface,
                       .b = slider,
                       .normalNewtonSeconds = newtons * step,
                       .slipMetresPerSecond = metresPerSecond,
                       .onA = {metresPerSecond * step * static_cast<double>(n + 1), metresPerSecond}});
        impacts.clear();
        lasting.collect({(n - 1) * stepNs, n * stepNs, (n + 1) * stepNs, 0.0, {}}, impacts);
        lasting.endStep();
        for (const Impact& impact : impacts)
            events.push_back({impact.timeNs, frequencyHz, decayPerSecond, impact.newtonSeconds / massKg});
    }
    ActuatorLayout layout;
    layoutPreset("phone1", layout);
    RendererSettings settings{rate, 1, {layout, PanningLaw::linear, 1.0, 1.0, 1.0}};
    settings.limiterEnabled = false;
    return test::renderEvents(events, settings, static_cast<int>(length * rate)).channels[0];
}

void addNoise(std::vector<float>& samples, double decibels) {
    SeededRandom random{1, "scrape"};
    double power = 0.0;
    for (const float x : samples)
        power += static_cast<double>(x) * static_cast<double>(x) / static_cast<double>(samples.size());
    const double rms = std::sqrt(power) * std::pow(10.0, decibels / 20.0);
    for (float& x : samples) x += static_cast<float>(rms * random.normal());
}

/// Within 5 % of the spacing and 10 % of the roughness; where it is told, 2 % of the frequency and a quarter
/// of the decay.
void expectFound(const Texture& texture, double speed, double hz, double tau, double noiseDecibels) {
    auto samples = scrape(texture, speed, hz, tau);
    addNoise(samples, noiseDecibels);
    const auto found = extractTexture(samples, rate, {speed, newtons, massKg});
    const auto where = testing::Message() << texture.grainMetres << " m, " << speed << " m/s, " << hz
                                          << " Hz, " << tau << " /s, " << noiseDecibels << " dB";
    ASSERT_TRUE(found) << found.error << ": " << where;
    EXPECT_EQ(found.value.texture.pattern, texture.pattern) << where;
    const bool isRegular = texture.pattern == GrainPattern::regular;
    EXPECT_NEAR(found.value.texture.grainMetres / texture.grainMetres, 1.0, isRegular ? 0.01 : 0.05) << where;
    if (found.value.strength == 0.0) {
        EXPECT_TRUE(isRegular && speed / texture.grainMetres > 0.9 * hz) << where;
        return;
    }
    EXPECT_NEAR(found.value.texture.roughness / texture.roughness, 1.0, 0.1) << where;
    EXPECT_NEAR(found.value.frequencyHz / hz, 1.0, 0.02) << where;
    EXPECT_NEAR(found.value.decayPerSecond / tau, 1.0, 0.25) << where;
}

TEST(TextureExtractor, FindsRandomGrains) {
    expectFound({0.002, 1.0}, 0.4, 349.0, 106.99, -80.0);
    expectFound({0.002, 3.0}, 0.1, 120.0, 20.0, -40.0);
    expectFound({0.001, 0.2}, 0.9, 800.0, 107.0, -40.0);
    expectFound({0.01, 1.0}, 0.4, 349.0, 106.99, -30.0);
}

TEST(TextureExtractor, FindsRidgesAndTheirTone) {
    expectFound({0.002, 1.0, GrainPattern::regular}, 0.4, 349.0, 106.99, -80.0);
    expectFound({0.01, 2.0, GrainPattern::regular}, 0.3, 120.0, 40.0, -40.0);
    expectFound({0.001, 1.0, GrainPattern::regular}, 0.9, 349.0, 106.99, -40.0); // faster than it rings
    expectFound({0.001, 1.0, GrainPattern::regular}, 1.9, 120.0, 60.0, -60.0);
}

TEST(TextureExtractor, APauseLeavesRidgesEven) {
    auto samples = scrape({0.004, 1.0, GrainPattern::regular}, 0.8, 349.0, 106.99);
    std::fill(samples.begin() + rate / 2, samples.begin() + rate, 0.0f);
    const auto found = extractTexture(samples, rate, {0.8, newtons, massKg});
    EXPECT_EQ(found.value.texture.pattern, GrainPattern::regular) << found.error;
    EXPECT_NEAR(found.value.texture.grainMetres, 0.004, 0.00004);
    EXPECT_NEAR(found.value.texture.roughness, 1.0, 0.1);
}

TEST(TextureExtractor, TwiceTheLoadTellsHalfTheRoughness) {
    const auto samples = scrape({0.002, 1.0}, 0.4, 349.0, 106.99);
    const auto once = extractTexture(samples, rate, {0.4, newtons, massKg}),
               twice = extractTexture(samples, rate, {0.4, 2.0 * newtons, massKg});
    EXPECT_NEAR(once.value.texture.roughness, 2.0 * twice.value.texture.roughness, 1e-9);
    EXPECT_EQ(once.value.strength, twice.value.strength);
}

TEST(TextureExtractor, WhatWasRecordedUpsideDownIsTheSame) {
    auto samples = scrape({0.002, 1.0}, 0.4, 349.0, 106.99);
    const auto up = extractTexture(samples, rate, {0.4});
    for (float& x : samples) x = -x;
    const auto down = extractTexture(samples, rate, {0.4});
    ASSERT_TRUE(up && down) << up.error << down.error;
    EXPECT_NEAR(up.value.strength, down.value.strength, 1e-9);
    EXPECT_EQ(up.value.grainCount, down.value.grainCount);
}

// A partial of 0.3 of the height makes grains look rougher, not more; at 10 a second it is not counted.
TEST(TextureExtractor, ASecondPartialLeavesTheSpacing) {
    for (const double speed : {0.02, 0.1, 0.4}) {
        auto samples = scrape({0.002, 1.0}, speed, 349.0, 107.0, 3.0);
        const auto second = scrape({0.002, 1.0}, speed, 555.0, 180.0, 3.0);
        for (std::size_t n = 0; n < samples.size(); ++n) samples[n] += 0.3f * second[n];
        addNoise(samples, -50.0);
        const auto found = extractTexture(samples, rate, {speed, newtons, massKg});
        EXPECT_NEAR(found.value.texture.grainMetres, 0.002, 0.0001) << found.error;
    }
}

TEST(TextureExtractor, WhatIsNoScrapeIsTold) {
    const auto expectFault = [](const std::vector<float>& samples, const std::string& words) {
        const auto found = extractTexture(samples, rate, {0.4});
        EXPECT_NE(found.error.find(words), std::string::npos) << found.error;
    };
    expectFault({}, "expected at least 0.5 s, found 0 samples");
    expectFault(std::vector<float>(1000, 0.5f), "expected at least 0.5 s, found 1000 samples");
    expectFault(std::vector<float>(48000), "expected a scrape, found silence");
    SeededRandom random{3, "noise"};
    std::vector<float> noise(48000), ringing(48000);
    for (float& x : noise) x = static_cast<float>(0.1 * random.normal());
    expectFault(noise, "expected a scrape whose grains stand out or repeat, found none that do");
    // a material that noise shakes
    const double r = std::exp(-50.0 / rate), turn = 2.0 * r * std::cos(2.0 * std::numbers::pi * 300.0 / rate);
    for (std::size_t n = 2; n < ringing.size(); ++n)
        ringing[n] = noise[n] * 0.01f + static_cast<float>(turn) * ringing[n - 1] -
                     static_cast<float>(r * r) * ringing[n - 2];
    expectFault(ringing, "found none that do");
    for (std::size_t n = 0; n < ringing.size(); ++n)
        ringing[n] = static_cast<float>(0.5 * std::sin(0.03 * static_cast<double>(n)) *
                                        std::exp(-5.0 * static_cast<double>(n) / rate));
    expectFault(ringing, "found none that do"); // one hit
    noise[4800] = std::numeric_limits<float>::quiet_NaN();
    expectFault(noise, "expected finite samples, found NaN at 0.1000 s");
    auto clipped = scrape({0.002, 1.0}, 0.4, 349.0, 106.99, 1.0);
    float peak = 0.0f;
    for (const float x : clipped) peak = std::max(peak, std::abs(x));
    for (float& x : clipped) x = std::clamp(x, -0.5f * peak, 0.5f * peak);
    expectFault(clipped, "expected a recording that is not clipped");
}

// What is taken away of samples that are to be felt, and what is left as it is.

constexpr double slowRate = 8000.0;

template <class Course>
std::vector<float> samplesOf(double seconds, Course course) {
    std::vector<float> samples(static_cast<std::size_t>(seconds * slowRate));
    for (std::size_t n = 0; n < samples.size(); ++n)
        samples[n] = static_cast<float>(course(static_cast<double>(n) / slowRate));
    return samples;
}
double sine(double hz, double t) { return std::sin(2.0 * std::numbers::pi * hz * t); }

double peakBetween(const std::vector<float>& samples, double from, double to) {
    double most = 0.0;
    for (auto n = static_cast<std::size_t>(from * slowRate); n < static_cast<std::size_t>(to * slowRate); ++n)
        most = std::max(most, std::abs(double{samples[n]}));
    return most;
}

TEST(SlowPart, AConstantBecomesSilence) {
    auto samples = samplesOf(10.0, [](double) { return 1.0; });
    const auto taken = removeSlowPart(samples, slowRate);
    EXPECT_EQ(taken.mean, 1.0);
    EXPECT_EQ(taken.varying, 0.0);
    EXPECT_EQ(peakBetween(samples, 0.0, 10.0), 0.0);
    EXPECT_EQ(taken.text(), "what lies below 5 Hz is not played: a mean of 1.00, of full scale");
}

TEST(SlowPart, ATonesOffsetGoesAndTheToneStays) {
    auto samples = samplesOf(2.0, [](double t) { return 0.5 * sine(205.0, t) - 0.25; });
    EXPECT_NEAR(removeSlowPart(samples, slowRate).mean, 0.25, 1e-3);
    for (std::size_t n = 0; n < samples.size(); ++n)
        ASSERT_NEAR(samples[n], 0.5 * sine(205.0, static_cast<double>(n) / slowRate), 1e-3);
}

TEST(SlowPart, WhatIsFeltStaysToTheBit) {
    for (const double hz : {20.0, 50.0, 65.0, 205.0, 1000.0})
        for (const double decay : {0.0, 12.0, 30.0, 107.0}) {
            const auto before = samplesOf(hz < 50.0 && decay > 0.0 ? 4.0 : 1.0,
                                          [&](double t) { return sine(hz, t) * std::exp(-decay * t); });
            auto samples = before;
            EXPECT_FALSE(removeSlowPart(samples, slowRate).isPresent()) << hz << ' ' << decay;
            EXPECT_EQ(samples, before) << hz << ' ' << decay;
        }
    const auto knock = samplesOf(0.19, [](double) { return 1.0; });
    auto samples = knock;
    EXPECT_FALSE(removeSlowPart(samples, slowRate).isPresent()) << "shorter than a period of 5 Hz";
    EXPECT_EQ(samples, knock);
}

TEST(SlowPart, WhatChangesSlowlyGoesAsFarAsItsFrequencySays) {
    for (const auto& [hz, left] :
         {std::pair{0.5, 0.01}, {1.0, 0.033}, {2.0, 0.126}, {3.0, 0.265}, {4.0, 0.43}, {5.0, 0.6}}) {
        auto samples = samplesOf(10.0, [hz = hz](double t) { return sine(hz, t); });
        EXPECT_GT(removeSlowPart(samples, slowRate).varying, 0.39) << hz;
        EXPECT_NEAR(peakBetween(samples, 1.0, 9.0), left, 0.01) << hz;
    }
    // its mean is zero
    auto steps = samplesOf(10.0, [](double t) { return (t < 5.0 ? 1.0 : -1.0) + 0.1 * sine(205.0, t); });
    EXPECT_GT(removeSlowPart(steps, slowRate).varying, 0.99);
    EXPECT_NEAR(peakBetween(steps, 0.2, 4.8), 0.1, 0.01);
    // a sixth of it is its mean
    auto burst = samplesOf(60.0, [](double t) { return t > 20.0 && t < 30.0 ? 1.0 : 0.0; });
    const auto taken = removeSlowPart(burst, slowRate);
    EXPECT_NEAR(taken.mean, 1.0 / 6.0, 1e-3);
    EXPECT_EQ(taken.text().substr(0, 83),
              "what lies below 5 Hz is not played: a mean of 0.17, and up to 0.83 beside it, of fu");
    EXPECT_LT(peakBetween(burst, 20.2, 29.8), 0.001);
}

TEST(SlowPart, IsAShareOfWhatIsPlayedAsFullScale) {
    for (const double fullScale : {1e-6, 0.02, 1e30}) {
        auto samples = samplesOf(1.0, [=](double t) { return fullScale * (0.5 + 0.5 * sine(205.0, t)); });
        EXPECT_NEAR(removeSlowPart(samples, slowRate, fullScale).mean, 0.5, 1e-3) << fullScale;
        EXPECT_NEAR(peakBetween(samples, 0.0, 1.0) / fullScale, 0.5, 1e-3) << fullScale;
    }
    std::vector<float> silence(8000, 0.0f);
    EXPECT_FALSE(removeSlowPart(silence, slowRate, 0.0).isPresent());
}

TEST(SlowPart, NothingHidesBehindWhatIsNoNumber) {
    for (const float hider : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                              std::numeric_limits<float>::max()}) {
        auto samples = samplesOf(10.0, [](double t) { return t < 5.0 ? 1.0 : -1.0; });
        samples[0] = hider;
        EXPECT_TRUE(removeSlowPart(samples, slowRate).isPresent());
        EXPECT_LT(peakBetween(samples, 1.0, 4.8), 0.02) << hider;
    }
}

} // namespace physvib::texture_extractor_test
