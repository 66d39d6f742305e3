// SPDX-License-Identifier: GPL-3.0-or-later
// The world as it is felt now: bodies, hits as light, enchanters with what they play.
#pragma once
#include "PluginProcessor.h"
#include <deque>
#include <juce_gui_basics/juce_gui_basics.h>

namespace physvib {

class WorldView final : public juce::Component {
public:
    WorldView() { setOpaque(true); }

    /// What is shown from now on. M.
    void show(const PluginState& state);
    /// Bodies as at `sessionNs`, which is felt `aheadNs` later; hits since the last call. M, a few times a second.
    void update(std::vector<BodyPose> poses, std::int64_t sessionNs, std::int64_t aheadNs, const std::vector<TakeEvent>& hits, const PluginMeters& meters);

    void paint(juce::Graphics& g) override;

private:
    struct Snapshot {
        std::int64_t timeNs;
        std::vector<BodyPose> poses;
    };
    struct Hit {
        double x, y, amplitude;
        juce::Colour colour;
        double shownAtMs;
    };
    struct Map {
        juce::Rectangle<float> field;
        float pixelsPerMetre;
        juce::Point<float> at(double x, double y) const {
            return {field.getX() + static_cast<float>(x) * pixelsPerMetre, field.getBottom() - static_cast<float>(y) * pixelsPerMetre};
        }
    };
    Map map() const;
    juce::Colour colourOf(const CollisionEvent& event) const;
    void drawBodies(juce::Graphics& g, const Map& at) const;
    void drawHits(juce::Graphics& g, const Map& at) const;
    void drawEnchanters(juce::Graphics& g, const Map& at) const;

    Scene scene_;
    std::vector<BodyDescription> cast_;
    LayoutDescription layout_;
    std::deque<Snapshot> ahead_; // not felt yet, but for the first
    std::deque<Hit> hits_;
    PluginMeters meters_;
};

} // namespace physvib
