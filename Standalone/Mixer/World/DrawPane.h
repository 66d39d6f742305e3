// SPDX-License-Identifier: GPL-3.0-or-later
// Drawing layer over the view of the world: selection, handles, and shapes being drawn.
#pragma once
#include "Host/Views/WorldView.h"
#include "Mixer/Model/MixerModel.h"
#include "Scene/Drawing/BodyEdits.h"
#include <array>
#include <juce_gui_basics/juce_gui_basics.h>
#include <optional>

namespace physvib {

// List of the tools in the world: throwing bodies, selecting and drawing.

enum class DrawTool {
    hand,
    choose,
    ball,
    box,
    polygon,
    line,
    wall,
    rain,
    pin,
    rope,
    spring,
    slider,
    motor,
    eraser
};

struct DrawToolWords {
    DrawTool tool;
    char key; ///< its key, with the focus in the world
    const char *name, *does;
};

/// In the order of the tool bar.
inline constexpr std::array<DrawToolWords, 14> drawTools{{
    {DrawTool::hand, 'h', "Hand", "Drag a body to throw it, with Shift to hold it"},
    {DrawTool::choose, 's', "Select",
     "Click a body, or drag around several; drag to move, handles to size and turn"},
    {DrawTool::ball, 'b', "Ball", "Drag from the centre outwards"},
    {DrawTool::box, 'x', "Box", "Drag from corner to corner"},
    {DrawTool::polygon, 'p', "Polygon", "Click the corners; double click or Enter ends it"},
    {DrawTool::line, 'l', "Line", "Draw a line freely"},
    {DrawTool::wall, 'w', "Wall", "Drag from end to end"},
    {DrawTool::rain, 'n', "Rain",
     "Drag over the place from which balls fall; how many, and how, is beside the materials"},
    {DrawTool::pin, 'i', "Pin", "Click where two bodies overlap; a single one is pinned to the field"},
    {DrawTool::rope, 'r', "Rope", "Drag from one body to another, or to the field"},
    {DrawTool::spring, 'k', "Spring", "As a rope that swings; its stiffness is beside the selected body"},
    {DrawTool::slider, 'd', "Slider", "Drag along the way of a body"},
    {DrawTool::motor, 'm', "Motor", "As a pin that turns"},
    {DrawTool::eraser, 'e', "Eraser", "Click or drag over bodies and joints"},
}};

inline bool isStroke(DrawTool tool) {
    return tool == DrawTool::ball || tool == DrawTool::box || tool == DrawTool::line ||
           tool == DrawTool::wall || tool == DrawTool::rain;
}
inline bool isJoint(DrawTool tool) {
    return tool == DrawTool::pin || tool == DrawTool::rope || tool == DrawTool::spring ||
           tool == DrawTool::slider || tool == DrawTool::motor;
}

inline const DrawToolWords& wordsOf(DrawTool tool) { return drawTools[static_cast<std::size_t>(tool)]; }

/// Icon around (0, 0), within 9 pixels in each direction.
juce::Path signOf(DrawTool tool);

/// Message thread only.
class DrawPane final : public juce::Component {
public:
    /// Both arguments outlive it. It is placed over `view`.
    DrawPane(MixerModel& model, WorldView& view);

    void use(DrawTool tool); ///< the hand tool acts in the view below
    DrawTool tool() const noexcept { return tool_; }
    void setMaterial(int material); ///< for new bodies and the selected ones
    int material() const noexcept { return material_; }
    void setSnapping(bool snaps);
    bool snaps() const noexcept { return snaps_; }

    const std::vector<std::string>& chosen() const noexcept { return chosen_; } ///< selected bodies
    void choose(std::vector<std::string> names);
    /// Changes each selected body in place, as one edit.
    void changeChosen(const juce::String& name,
                      const std::function<void(const Scene&, BodyDescription&)>& change,
                      bool continuesEdit = false);

    /// Number of bodies of one rain, and how they come: all at once, so many in a second of the world, or so
    /// many upwards from one place.
    struct RainPattern {
        int perSecond = 0; ///< 0: all at once
        bool isFountain = false;
        bool operator==(const RainPattern&) const = default;
    };
    int rainCount() const noexcept { return rainCount_; }
    void setRainCount(int count);
    const RainPattern& rainPattern() const noexcept { return rainPattern_; }
    void setRainPattern(const RainPattern& way);
    void spawnDueBodies();                     ///< adds those that are due; to be called often
    juce::Rectangle<float> chosenArea() const; ///< of the selected bodies with their handles, in pixels

    // Menu commands, at places in metres of the field.
    void addAt(DrawTool tool, Vector place); ///< a body of the usual size
    void joinAt(DrawTool tool, Vector place);
    void copy(const std::vector<std::string>& names);
    bool hasCopy() const noexcept { return !copied_.bodies.empty(); }
    void pasteAt(Vector place);
    void eraseAll(const std::vector<std::string>& names);

    std::function<void()> onChange;                       ///< tool, selection or material changed
    std::function<void(juce::Point<float> place)> onMenu; ///< right click

    void mixChanged(); ///< the mixer state changed
    bool handleKey(const juce::KeyPress& key);
    void paint(juce::Graphics& g) override;
    void mouseDown(const juce::MouseEvent& e) override;
    void mouseDrag(const juce::MouseEvent& e) override;
    void mouseUp(const juce::MouseEvent& e) override;
    void mouseMove(const juce::MouseEvent& e) override;
    void mouseDoubleClick(const juce::MouseEvent& e) override;

private:
    static constexpr double gridsPerField = 40.0, turnStep = juce::MathConstants<double>::pi / 12.0;
    enum class Grip { none, move, size, turn, around };
    struct Handles { // of one body, in pixels
        std::array<juce::Point<float>, 4> corners;
        juce::Point<float> turn, centre;
    };
    const SceneDrawing& drawing() const noexcept { return model_.world().drawing(); }
    Vector at(const juce::MouseEvent& e) const;
    double grid() const;
    std::optional<Handles> handles() const;
    std::optional<BodyPlace> placeNow(const std::string& name) const;
    BodyDescription sizedNow() const;
    std::map<std::string, BodyPlace> movedNow() const;
    Result<BodyDescription> drawnNow() const;
    Result<std::vector<BodyDescription>> rainNow() const;
    void addStroke();
    void beginRain(Result<std::vector<BodyDescription>> bodies);
    bool prepare(std::vector<BodyDescription>& bodies);
    void add(Result<std::vector<BodyDescription>> bodies);
    void join();
    void erase(const juce::MouseEvent& e);
    void edit(const juce::String& name, std::vector<Action> actions, bool continuesEdit = false);
    void grip(const juce::MouseEvent& e);
    void nudge(Vector byMetres, double byRadians);
    void scaleChosen(double factor);
    void paste(const Copied& copy, Vector beside);
    void closePolygon();
    void addInTheMiddle();
    bool handleToolKey(const juce::KeyPress& key);
    std::string fieldBody(std::vector<Action>& actions, const Vector& place);
    std::string jointAt(juce::Point<float> place) const;
    Vector carried(const Vector& point, const std::string& body) const;
    juce::Line<float> lineNow(const JointDescription& joint) const;
    void drawJoints(juce::Graphics& g) const;
    void drawOutline(juce::Graphics& g, const BodyDescription& body, const BodyPlace& place,
                     juce::Colour colour, bool isFilled) const;
    void drawChosen(juce::Graphics& g) const;
    void drawStroke(juce::Graphics& g) const;

    MixerModel& model_;
    WorldView& view_;
    DrawTool tool_ = DrawTool::hand;
    int material_ = -1; // at first, the first material with a frequency
    int rainCount_ = 50;
    RainPattern rainPattern_;
    std::vector<BodyDescription> falling_; // those of the present rain that are still to come, the next last
    std::int64_t rainFromNs_ = 0, spawned_ = 0; // time of the scene, and how many have come since
    bool snaps_ = false, isDrawing_ = false;
    std::vector<std::string> chosen_;
    Copied copied_;
    Grip grip_ = Grip::none;
    std::vector<Vector> stroke_; // since the mouse was pressed, or of the polygon; metres
    Vector to_;                  // mouse position
};

} // namespace physvib
