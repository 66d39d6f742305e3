// SPDX-License-Identifier: MIT
// What travels is felt where it is: rendered, and compared with the table of Docs/rows.md.
#include "Support/Rendering.h"
#include "TestPlaces.h"
#include <cmath>
#include <cstdio>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <numbers>
#include <string>

namespace physvib {
namespace {

constexpr int windows = 50; // of a journey of one second
constexpr std::int64_t ns = 1'000'000'000, windowNs = ns / windows;
constexpr int travelRate = 16000;

/// A layout and the way over it, as a function of the share that has passed; `gap` in units of the way.
struct Journey {
    std::string name;
    EnchanterLayout layout;
    bool isBelt = false;
    double gap = 1.0;

    static double angleAt(double share) { return 2 * std::numbers::pi * share - 2.0; }
    EnchanterPlace at(double share) const {
        if (!isBelt) return {share * layout.extentWidthMetres, 0.3 * layout.extentHeightMetres};
        return {0.5 + 0.5 * std::cos(angleAt(share)), 0.5 + 0.5 * std::sin(angleAt(share))};
    }
    /// How far along the way a place is felt, as a share; on a belt only its direction is.
    double shareOf(const EnchanterPlace& felt, double near) const {
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
    all.push_back({"belt of 8", EnchanterLayout{1.0, 1.0, 8, {}}, true, 1.0 / 8});
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
        const EnchanterPlace at = journey.at(shareAt(kind == Kind::phantom ? from : from + each / 2)),
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
        EnchanterPlace felt;
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

} // namespace
} // namespace physvib
