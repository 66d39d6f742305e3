// SPDX-License-Identifier: GPL-3.0-or-later
// Small discs as pictures that are drawn once: a world of thousands is then as quick as it is to copy them.
#pragma once
#include <juce_gui_basics/juce_gui_basics.h>
#include <vector>

namespace physvib {

class BallPictures {
public:
    static constexpr float mostPixels = 16.0f; ///< radius, in pixels of the display
    /// Of every disc, copied or drawn: the lines in pixels of the component, the spoke as a share of the
    /// radius.
    static constexpr float rimWidth = 2.0f, spokeWidth = 1.5f, spokeShare = 0.9f;

    struct Ball {
        float radius = 0.0f; ///< in pixels of the component
        juce::Colour fill;
        juce::Colour spoke{}, rim{}; ///< transparent: none
        bool operator==(const Ball&) const = default;
    };

    /// Draws it with its spoke at an angle in radians, clockwise from the right. Place and angle are rounded
    /// to what is hardly seen. False, and nothing is drawn, if it is too large. M.
    bool draw(juce::Graphics& g, const Ball& ball, juce::Point<float> centre, float angle);

private:
    static constexpr int turns = 64, phases = 4; // angles of the spoke; places between pixels, along each
                                                 // axis
    struct Kind {
        Ball ball;
        std::vector<juce::Image> pictures; // null until they are needed
    };
    Kind& kindOf(const Ball& ball);
    juce::Image pictureOf(const Ball& ball, int turn, juce::Point<int> phase) const;

    float scale_ = 1.0f; // of the pictures
    std::vector<Kind> kinds_;
};

} // namespace physvib
