// SPDX-License-Identifier: GPL-3.0-or-later
// Sizes badges by the nearest neighbour, then pushes apart what still overlaps.
#include "Host/Views/Badges.h"
#include <algorithm>
#include <cmath>

namespace physvib {
namespace {

using Badges = std::vector<juce::Rectangle<float>>;
constexpr float twoLetters = 24.0f;
constexpr int mostPasses = 400; // 64 in one place take about 100

/// Of places that differ, the least distance along the farther axis.
float nearestOf(std::span<const juce::Point<float>> places) {
    float nearest = 2.0f * highestBadge;
    for (std::size_t i = 0; i < places.size(); ++i)
        for (std::size_t k = 0; k < i; ++k) {
            const auto way = places[k] - places[i];
            const float apart = std::max(std::abs(way.x), std::abs(way.y));
            if (apart >= 1.0f) nearest = std::min(nearest, apart);
        }
    return nearest;
}

/// Half of the way to each neighbour in its row, or more of it if that one needs less.
float widthOf(std::size_t i, std::span<const juce::Point<float>> places, std::span<const float> wanted,
              float least, float high) {
    float width = std::min(widestBadge, wanted[i]);
    for (std::size_t k = 0; k < places.size(); ++k) {
        const auto way = places[k] - places[i];
        if (k == i || std::abs(way.y) >= high) continue;
        const float both = std::abs(way.x) - betweenBadges;
        width = std::min(width, 2.0f * both - std::clamp(wanted[k], least, std::max(least, both)));
    }
    return std::max(least, width);
}

/// True if none was moved.
bool pushApart(Badges& badges, juce::Rectangle<float> room) {
    bool areApart = true;
    for (std::size_t i = 0; i < badges.size(); ++i)
        for (std::size_t k = 0; k < i; ++k) {
            auto &a = badges[k], &b = badges[i];
            const auto way = b.getCentre() - a.getCentre();
            const float acrossX = 0.5f * (a.getWidth() + b.getWidth()) + betweenBadges - std::abs(way.x),
                        acrossY = 0.5f * (a.getHeight() + b.getHeight()) + betweenBadges - std::abs(way.y);
            if (acrossX < 0.1f || acrossY < 0.1f) continue;
            const auto push = acrossX < acrossY ? juce::Point<float>{way.x < 0.0f ? -acrossX : acrossX, 0.0f}
                                                : juce::Point<float>{0.0f, way.y < 0.0f ? -acrossY : acrossY};
            a = (a - push * 0.5f).constrainedWithin(room);
            b = (b + push * 0.5f).constrainedWithin(room);
            areApart = false;
        }
    return areApart;
}

} // namespace

Badges badgesAround(std::span<const juce::Point<float>> places, std::span<const float> textWidths,
                    juce::Rectangle<float> room) {
    const float high = juce::jlimit(lowestBadge, highestBadge, nearestOf(places) - betweenBadges);
    Badges badges;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const float least = std::max(high, std::min(twoLetters, textWidths[i]));
        // of those in one place, each goes another way
        const auto turn = 2.4f * static_cast<float>(i), far = 0.05f * std::sqrt(static_cast<float>(i));
        badges.push_back(juce::Rectangle<float>{widthOf(i, places, textWidths, least, high), high}
                             .withCentre(places[i].translated(far * std::cos(turn), far * std::sin(turn)))
                             .constrainedWithin(room));
    }
    for (int pass = 0; pass < mostPasses && !pushApart(badges, room); ++pass) {
    }
    return badges;
}

} // namespace physvib
