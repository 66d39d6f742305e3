// SPDX-License-Identifier: MIT
// A tone that moves is felt where it is, equally strong all the way, with nothing beside it, in any blocks.
#include "Core/HapticRenderer.h"
#include "Support/Rendering.h"
#include "TestPlaces.h"
#include <cmath>
#include <complex>
#include <cstdio>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <numbers>
#include <string>

namespace physvib::moving_tones_test {

constexpr int rate = 48000;
constexpr double hz = 205.0;

RendererSettings phone4(PanningLaw law = PanningLaw::linear) {
    ActuatorLayout layout;
    layoutPreset("phone4", layout);
    return {rate, 4, PhantomPanner{layout, law, 1, layout.extentWidthMetres, layout.extentHeightMetres},
            false};
}

ActuatorPlace placeOf(char letter) {
    return phone4().panner.layout().places[static_cast<std::size_t>(letter - 'A')];
}

CollisionEvent segment(ActuatorPlace from, ActuatorPlace to, std::int64_t fromNs, std::int64_t lengthNs) {
    return {.timeNs = fromNs,
            .frequencyHz = hz,
            .amplitude = 0.5,
            .x = from.xMetres,
            .y = from.yMetres,
            .durationNs = lengthNs,
            .course = {to.xMetres, to.yMetres, lengthNs, 0},
            .spread = Spread::equal};
}

const CollisionEvent fromAToD = segment(placeOf('A'), placeOf('D'), 0, 1'000'000'000);

/// Of the tone in samples [first, first + count).
double amplitudeIn(const std::vector<float>& samples, std::size_t first, std::size_t count) {
    std::complex<double> sum;
    for (std::size_t n = first; n < first + count; ++n)
        sum += static_cast<double>(samples[n]) *
               std::polar(1.0, -2 * std::numbers::pi * hz * static_cast<double>(n) / rate);
    return 2 * std::abs(sum) / static_cast<double>(count);
}

void transform(std::vector<std::complex<double>>& a) {
    for (std::size_t size = a.size(); size > 1; size /= 2)
        for (std::size_t at = 0; at < a.size(); at += size)
            for (std::size_t k = 0; k < size / 2; ++k) {
                const auto x = a[at + k], y = a[at + k + size / 2];
                a[at + k] = x + y;
                a[at + k + size / 2] =
                    (x - y) * std::polar(1.0, -2 * std::numbers::pi * static_cast<double>(k) /
                                                  static_cast<double>(size));
            }
}

/// dB of the largest component that is further than `awayHz` from the tone, below a tone that stands still. A
/// window of four terms: what its own sides do lies below -92 dB.
double loudestBeside(const std::vector<float>& samples, double awayHz) {
    constexpr std::size_t size = 65536;
    std::vector<std::complex<double>> spectrum(size);
    const auto length = static_cast<double>(samples.size());
    double whole = 0.0;
    for (std::size_t n = 0; n < samples.size(); ++n) {
        const double turn = 2 * std::numbers::pi * static_cast<double>(n) / length;
        const double window =
            0.35875 - 0.48829 * std::cos(turn) + 0.14128 * std::cos(2 * turn) - 0.01168 * std::cos(3 * turn);
        spectrum[n] = static_cast<double>(samples[n]) * window;
        whole += 0.5 * fromAToD.amplitude * window;
    }
    transform(spectrum);
    double most = 0.0;
    for (std::size_t k = 0; k < size; ++k) {
        std::size_t frequency = 0; // bits in reverse
        for (std::size_t bit = 1, other = size / 2; bit < size; bit *= 2, other /= 2)
            frequency |= (k & bit) != 0 ? other : 0;
        if (frequency < size / 2 && std::abs(static_cast<double>(frequency) * rate / size - hz) > awayHz)
            most = std::max(most, std::abs(spectrum[k]));
    }
    return 20 * std::log10(most / whole);
}

TEST(MovingTones, TheCentreOfWhatIsFeltFollowsThePathAtEqualStrength) {
    const auto felt = test::renderEvents({fromAToD}, phone4(), rate).channels;
    const auto places = phone4().panner.layout().places;
    constexpr std::size_t window = 2 * rate / 205; // two periods
    double least = 1e9, most = 0.0;
    for (std::size_t first = 0; first + window < static_cast<std::size_t>(rate); first += window) {
        double energy = 0.0, x = 0.0, y = 0.0;
        for (std::size_t j = 0; j < 4; ++j) {
            const double a = amplitudeIn(felt[j], first, window);
            energy += a * a;
            x += a * a * places[j].xMetres;
            y += a * a * places[j].yMetres;
        }
        const double share = (static_cast<double>(first) + 0.5 * window) / rate;
        const ActuatorPlace a = placeOf('A'), d = placeOf('D');
        const double away = std::hypot(x / energy - std::lerp(a.xMetres, d.xMetres, share),
                                       y / energy - std::lerp(a.yMetres, d.yMetres, share));
        EXPECT_LE(away, 0.02 * std::hypot(d.xMetres - a.xMetres, d.yMetres - a.yMetres)) << share;
        least = std::min(least, energy);
        most = std::max(most, energy);
    }
    EXPECT_LE(10 * std::log10(most / least), 0.5) << least;
    EXPECT_NEAR(std::sqrt(most), fromAToD.amplitude, 0.01);
}

TEST(MovingTones, NothingIsBesideTheTone) {
    const auto felt = test::renderEvents({fromAToD}, phone4(), rate).channels;
    for (std::size_t j = 0; j < 4; ++j) EXPECT_LE(loudestBeside(felt[j], 20.0), -80.0) << j;
}

TEST(MovingTones, SegmentsOfOnePathJoinWithoutAStep) {
    CollisionEvent first = segment(placeOf('A'), placeOf('B'), 0, 400'123'457),
                   second = segment(placeOf('B'), placeOf('D'), first.durationNs,
                                    1'000'000'000 - first.durationNs);
    second.course.toneAgeNs = second.timeNs;
    const auto felt = test::renderEvents({first, second}, phone4(), rate).channels;
    float steepest = 0.0f;
    for (const auto& channel : felt)
        for (std::size_t n = 1; n < channel.size(); ++n)
            steepest = std::max(steepest, std::abs(channel[n] - channel[n - 1]));
    EXPECT_LE(steepest, 0.5 * 2 * std::numbers::pi * hz / rate * 1.01) << "no more than the tone itself";
}

TEST(MovingTones, AnyBlocksGiveTheSameBits) {
    std::vector<CollisionEvent> events;
    for (int i = 0; i < 12; ++i) {
        events.push_back(segment(placeOf(static_cast<char>('A' + i % 4)),
                                 placeOf(static_cast<char>('A' + (i + 1) % 4)), 3'333'331 * i,
                                 20'000'000 + 1'234'567 * i));
        events.back().decayPerSecond = i % 3 * 7.0;
        events.back().spread = static_cast<Spread>(i % static_cast<int>(spreadNames.size()));
    }
    const auto reference = test::renderEvents(events, phone4(), 6000, {8192});
    EXPECT_EQ(reference.status.played, events.size());
    for (const auto& blocks : {std::vector{1}, {64}, {4096}, {17, 1, 333}})
        EXPECT_TRUE(test::renderEvents(events, phone4(), 6000, blocks).channels == reference.channels)
            << blocks[0];
}

TEST(MovingTones, WhatGoesNowhereIsTheStillStrike) {
    CollisionEvent still = fromAToD, moving = fromAToD;
    still.course = {};
    still.spread = Spread::layout;
    still.x = moving.x = moving.course.toX = 0.04;
    still.y = moving.y = moving.course.toY = 0.02;
    moving.spread = Spread::layout;
    const auto a = test::renderEvents({still}, phone4(), rate).channels,
               b = test::renderEvents({moving}, phone4(), rate).channels;
    for (std::size_t j = 0; j < 4; ++j)
        for (std::size_t n = 0; n < a[j].size(); ++n) ASSERT_NEAR(a[j][n], b[j][n], 1e-6) << j << ' ' << n;
}

TEST(MovingTones, TheRestOfALongerToneGoesOnWhereThatOneIs) {
    CollisionEvent whole = fromAToD, rest = fromAToD;
    whole.course = {};
    whole.spread = Spread::layout;
    whole.decayPerSecond = rest.decayPerSecond = 3.0;
    rest.course = {.toneAgeNs = 300'000'017};
    rest.spread = Spread::layout;
    rest.timeNs = rest.course.toneAgeNs;
    rest.durationNs -= rest.course.toneAgeNs;
    const auto a = test::renderEvents({whole}, phone4(), rate).channels,
               b = test::renderEvents({rest}, phone4(), rate).channels;
    for (std::size_t n = 14'401; n < a[0].size(); ++n) ASSERT_NEAR(a[0][n], b[0][n], 1e-6) << n;
}

TEST(MovingTones, AStopFadesThem) {
    test::Session session{{fromAToD}, {{.timeNs = 500'000'000, .kind = RenderControl::Kind::stopAll}}};
    auto renderer = std::make_unique<HapticRenderer>();
    renderer->prepare(phone4());
    const auto out = test::renderBlocks(*renderer, session, 4, rate, {480});
    const auto loudest = [&](int from, int to) {
        return std::abs(*std::max_element(out[0].begin() + from, out[0].begin() + to));
    };
    EXPECT_GT(loudest(23'000, 24'000), 0.2f);
    EXPECT_EQ(loudest(25'000, rate), 0.0f);
}

TEST(MovingTones, TooManyAtOnceAreRefused) {
    const std::vector<CollisionEvent> events(40, fromAToD);
    const auto status = test::renderEvents(events, phone4(), 480).status;
    EXPECT_EQ(status.played, static_cast<std::uint64_t>(limits::maxMovingTones));
    EXPECT_EQ(status.rejected, 40u - status.played);
}

TEST(Spread, EqualKeepsTheEnergyOnAnyLayoutAndAloneIsOne) {
    for (const int count : {1, 2, 3, 4, 7}) {
        ActuatorLayout layout{1.0, 0.5, count, {}};
        for (int j = 0; j < count; ++j)
            layout.places[static_cast<std::size_t>(j)] = {count == 3 ? 0.5 * j : std::abs(std::sin(j * 1.7)),
                                                          count == 3 ? 0.2
                                                                     : 0.5 * std::abs(std::cos(j * 2.3))};
        const PhantomPanner panner{layout, PanningLaw::linear, 2.0, 2.0, 1.0};
        for (double x = 0.0; x <= 2.0; x += 0.31) {
            PhantomPanner::Gains gains{};
            panner.gainsAt(x, 0.3, Spread::equal, gains);
            double energy = 0.0;
            for (int j = 0; j < count; ++j)
                energy += gains[static_cast<std::size_t>(j)] * gains[static_cast<std::size_t>(j)];
            EXPECT_NEAR(energy, 1.0, 1e-9) << count << ' ' << x;
            panner.gainsAt(x, 0.3, Spread::nearest, gains);
            EXPECT_EQ(std::count(gains.begin(), gains.begin() + count, 0.0), count - 1);
        }
    }
}

// What travels is felt where it is: rendered, and compared with the table of Docs/rows.md.

constexpr int windows = 50; // of a journey of one second
constexpr std::int64_t ns = 1'000'000'000, windowNs = ns / windows;
constexpr int travelRate = 16000;

/// A layout and the way over it, as a function of the share that has passed; `gap` in units of the way.
struct Journey {
    std::string name;
    ActuatorLayout layout;
    bool isBelt = false;
    double gap = 1.0;

    static double angleAt(double share) { return 2 * std::numbers::pi * share - 2.0; }
    ActuatorPlace at(double share) const {
        if (!isBelt) return {share * layout.extentWidthMetres, 0.3 * layout.extentHeightMetres};
        return {0.5 + 0.5 * std::cos(angleAt(share)), 0.5 + 0.5 * std::sin(angleAt(share))};
    }
    /// How far along the way a place is felt, as a share; on a belt only its direction is.
    double shareOf(const ActuatorPlace& felt, double near) const {
        if (!isBelt) return felt.xMetres / layout.extentWidthMetres;
        const double angle = std::atan2(felt.yMetres - 0.5, felt.xMetres - 0.5) - angleAt(near);
        return near + std::remainder(angle, 2 * std::numbers::pi) / (2 * std::numbers::pi);
    }
};

std::vector<Journey> journeys() {
    std::vector<Journey> all;
    for (const int count : {2, 3, 4, 8, 16})
        all.push_back(
            {"row of " + std::to_string(count), test::gridLayout(count, 1), false, 1.0 / (count - 1)});
    all.push_back({"belt of 8", ActuatorLayout{1.0, 1.0, 8, {}}, true, 1.0 / 8});
    Journey& belt = all.back();
    for (std::size_t j = 0; j < 8; ++j) {
        const double angle = 2 * std::numbers::pi * static_cast<double>(j) / 8;
        belt.layout.places[j] = {0.5 + 0.5 * std::cos(angle), 0.5 + 0.5 * std::sin(angle)};
    }
    all.push_back({"sleeve of 2 x 4", test::gridLayout(4, 2), false, 1.0 / 3});
    return all;
}

enum class Kind { hits, grains, phantom };

/// A hit in each window, a grain each millisecond, or a tone that moves in two straight segments per window.
std::vector<CollisionEvent> eventsOf(const Journey& journey, Kind kind, Spread spread) {
    const std::int64_t each = kind == Kind::hits ? windowNs : kind == Kind::grains ? ns / 1000 : windowNs / 2;
    std::vector<CollisionEvent> events;
    for (std::int64_t from = 0; from < ns; from += each) {
        const auto shareAt = [](std::int64_t at) { return static_cast<double>(at) / ns; };
        const ActuatorPlace at = journey.at(shareAt(kind == Kind::phantom ? from : from + each / 2)),
                            to = journey.at(shareAt(from + each));
        CollisionEvent& event = events.emplace_back();
        event.timeNs = from;
        event.durationNs = each;
        event.frequencyHz = 1000.0;
        event.amplitude = 0.5;
        event.x = at.xMetres;
        event.y = at.yMetres;
        if (kind == Kind::grains) event.source.kind = ContactKind::roll;
        if (kind == Kind::phantom) event.course = {to.xMetres, to.yMetres, each, from}, event.spread = spread;
    }
    return events;
}

struct Travel {
    double speed = 0.0; ///< felt, times the true one: the slope of the straight line through all windows
    double worst = 0.0; ///< distance from the place, in gaps
};

Travel travelOf(const Journey& journey, Kind kind, const PhantomPanner& panner, Spread phantoms) {
    const RendererSettings settings{.sampleRateHz = travelRate,
                                    .channels = panner.channels(),
                                    .panner = panner,
                                    .limiterEnabled = false,
                                    .modes = 64};
    const auto channels =
        test::renderEvents(eventsOf(journey, kind, phantoms), settings, travelRate).channels;
    constexpr int frames = travelRate / windows;
    double moment = 0.0, square = 0.0;
    Travel travel;
    for (int w = 0; w < windows; ++w) {
        ActuatorPlace felt;
        double energy = 0.0;
        for (std::size_t j = 0; j < channels.size(); ++j)
            for (int n = w * frames; n < (w + 1) * frames; ++n) {
                const double e = std::pow(static_cast<double>(channels[j][static_cast<std::size_t>(n)]), 2);
                energy += e;
                felt.xMetres += e * journey.layout.places[j].xMetres;
                felt.yMetres += e * journey.layout.places[j].yMetres;
            }
        const double meant = (w + 0.5) / windows;
        const double share = journey.shareOf({felt.xMetres / energy, felt.yMetres / energy}, meant);
        moment += (meant - 0.5) * (share - 0.5);
        square += (meant - 0.5) * (meant - 0.5);
        travel.worst = std::max(travel.worst, std::abs(share - meant) / journey.gap);
    }
    travel.speed = moment / square;
    return travel;
}

TEST(Travel, IsFeltWhereItIsByTheDefaultLawAndThePageSaysSo) {
    std::ifstream file{PHYSVIB_SOURCE_DIR "/Docs/rows.md"};
    const std::string page{std::istreambuf_iterator<char>{file}, {}};
    for (const Journey& journey : journeys()) {
        PhantomPanner before{journey.layout, PanningLaw::linear, 1.0, 1.0, 1.0};
        before.setGrains(grainSpread);
        const PhantomPanner now{journey.layout, PanningLaw::automatic, 1.0, 1.0, 1.0};
        std::string entry = "| " + journey.name + " |";
        for (const Kind kind : {Kind::hits, Kind::grains, Kind::phantom}) {
            const Travel old = travelOf(journey, kind, before, Spread::equal),
                         found = travelOf(journey, kind, now, now.travelSpread());
            std::array<char, 80> text{};
            std::snprintf(text.data(), text.size(), " %.2f, %.0f %% | %.2f, %.0f %% |", old.speed,
                          100 * old.worst, found.speed, 100 * found.worst);
            if (kind != Kind::grains) entry += text.data();
            if (now.law() != PanningLaw::neighbours) continue;
            EXPECT_NEAR(found.speed, 1.0, 0.03) << entry;
            EXPECT_LE(found.worst, 0.1) << entry;
        }
        EXPECT_NE(page.find(entry), std::string::npos) << "expected in Docs/rows.md: " << entry;
    }
}

} // namespace physvib::moving_tones_test
