// SPDX-License-Identifier: GPL-3.0-or-later
// Where the badges of actuators are drawn, so that each can be read.
#pragma once
#include <juce_graphics/juce_graphics.h>
#include <span>
#include <vector>

namespace physvib {

constexpr float highestBadge = 30.0f, lowestBadge = 16.0f, widestBadge = 96.0f, betweenBadges = 3.0f;

/// A badge around each place, as high as all can be and as wide as its text wants and its neighbours let it.
/// Badges lie in `room`; those that would lie over each other are moved apart. Any thread.
std::vector<juce::Rectangle<float>> badgesAround(std::span<const juce::Point<float>> places,
                                                 std::span<const float> textWidths,
                                                 juce::Rectangle<float> room);

} // namespace physvib
