// SPDX-License-Identifier: GPL-3.0-or-later
// Sizes badges by the nearest neighbour, then moves what still overlaps to a free place.
#include "Host/Views/Badges.h"
#include <algorithm>
#include <cmath>
#include <numeric>

namespace physvib {
namespace {

using Badges = std::vector<juce::Rectangle<float>>;
constexpr float twoLetters = 24.0f;

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

bool isFree(const juce::Rectangle<float>& badge, const Badges& placed) {
    const auto around = badge.expanded(betweenBadges - 0.1f); // rounded
    return std::ranges::none_of(placed, [&](const auto& other) { return around.intersects(other); });
}

/// The nearest free place, on rings around its own; its own if there is none.
juce::Rectangle<float> freePlace(const juce::Rectangle<float>& badge, const Badges& placed,
                                 juce::Rectangle<float> room) {
    constexpr float step = 4.0f;
    for (float far = 0.0f; far < room.getWidth() + room.getHeight(); far += step)
        for (float turn = 0.0f; turn < juce::MathConstants<float>::twoPi;
             turn += step / std::max(step, far)) {
            const auto tried =
                badge.translated(far * std::cos(turn), far * std::sin(turn)).constrainedWithin(room);
            if (isFree(tried, placed)) return tried;
        }
    return badge;
}

} // namespace

Badges badgesAround(std::span<const juce::Point<float>> places, std::span<const float> textWidths,
                    juce::Rectangle<float> room) {
    const float high = juce::jlimit(lowestBadge, highestBadge, 0.75f * nearestOf(places));
    Badges own;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const float least = std::max(high, std::min(twoLetters, textWidths[i]));
        own.push_back(juce::Rectangle<float>{widthOf(i, places, textWidths, least, high), high}
                          .withCentre(places[i])
                          .constrainedWithin(room));
    }
    // those in nobody's way first, so that none of them has to move
    std::vector<std::size_t> order(own.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_partition(order, [&](std::size_t i) {
        return std::ranges::count_if(own, [&](const auto& other) { return own[i].intersects(other); }) == 1;
    });
    Badges placed, badges(own.size());
    for (const std::size_t i : order) placed.push_back(badges[i] = freePlace(own[i], placed, room));
    return badges;
}

} // namespace physvib
