// SPDX-License-Identifier: GPL-3.0-or-later
// The tools in the world, each with its key, name, help text and icon; and Rain, which adds the bodies of the
// rain tool one by one.
#pragma once
#include "Mixer/Model/MixerModel.h"
#include <juce_gui_basics/juce_gui_basics.h>

namespace physvib {

enum class DrawTool {
    hand,
    select,
    ball,
    box,
    polygon,
    line,
    wall,
    rain,
    conveyor,
    pin,
    rope,
    spring,
    slider,
    motor,
    eraser
};

struct DrawToolInfo {
    DrawTool tool;
    char key; ///< its key, with the focus in the world
    const char *name, *help;
};

/// In the order of the tool bar.
inline constexpr std::array<DrawToolInfo, 15> drawTools{{
    {DrawTool::hand, 'h', "Hand", "Drag a body to throw it, with Shift to hold it"},
    {DrawTool::select, 's', "Select",
     "Click a body, or drag around several; drag to move, handles to size and turn"},
    {DrawTool::ball, 'b', "Ball", "Drag from the centre outwards"},
    {DrawTool::box, 'x', "Box", "Drag from corner to corner"},
    {DrawTool::polygon, 'p', "Polygon", "Click the corners; double click or Enter ends it"},
    {DrawTool::line, 'l', "Line", "Draw a line freely"},
    {DrawTool::wall, 'w', "Wall", "Drag from end to end"},
    {DrawTool::rain, 'n', "Rain",
     "Drag over the place from which balls fall; how many, and how, is beside the materials"},
    {DrawTool::conveyor, 'c', "Conveyor", "Drag the way that it carries"},
    {DrawTool::pin, 'i', "Pin", "Click where two bodies overlap; a single one is pinned to the field"},
    {DrawTool::rope, 'r', "Rope", "Drag from one body to another, or to the field"},
    {DrawTool::spring, 'k', "Spring", "As a rope that swings; its stiffness is beside the selected body"},
    {DrawTool::slider, 'd', "Slider", "Drag along the way of a body"},
    {DrawTool::motor, 'm', "Motor", "As a pin that turns"},
    {DrawTool::eraser, 'e', "Eraser", "Click or drag over bodies and joints"},
}};

inline bool isStrokeTool(DrawTool tool) { // a drag draws bodies
    return tool == DrawTool::ball || tool == DrawTool::box || tool == DrawTool::line ||
           tool == DrawTool::wall || tool == DrawTool::rain || tool == DrawTool::conveyor;
}
inline bool isJointTool(DrawTool tool) { // a click or a drag joins two bodies
    return tool == DrawTool::pin || tool == DrawTool::rope || tool == DrawTool::spring ||
           tool == DrawTool::slider || tool == DrawTool::motor;
}

inline const DrawToolInfo& toolInfo(DrawTool tool) { return nth(drawTools, tool); }

/// Icon around (0, 0), within 9 pixels in each direction.
juce::Path toolIcon(DrawTool tool);

/// How the bodies of a rain appear: all at once or at a rate in simulated time, where they were drawn or
/// upwards from one place.
struct RainPattern {
    int bodiesPerSecond = 0; ///< 0: all at once
    bool isFountain = false;
    bool operator==(const RainPattern&) const = default;
};

/// Adds the bodies of one rain to the scene when they are due in simulated time. One undo removes all of
/// them. Message thread.
class Rain {
public:
    explicit Rain(MixerModel& model)
        : model_{model} {}
    const RainPattern& pattern() const noexcept { return pattern_; }
    void setPattern(const RainPattern& pattern) { pattern_ = pattern; }
    void start(std::vector<BodyDescription> bodies); ///< named, in the order of appearance
    void spawnDueBodies();                           ///< call it at every refresh

private:
    MixerModel& model_;
    RainPattern pattern_;
    std::vector<BodyDescription> pendingBodies_; // not added yet; the next one is the last element
    std::shared_ptr<const Scene> scene_;         // at the start, as the number of the run
    std::size_t runNumber_ = 0;
    std::int64_t startNs_ = 0, spawnedCount_ = 0; // scene time of the start; bodies added since
};

} // namespace physvib
