// SPDX-License-Identifier: GPL-3.0-or-later
// Drawing layer over the view of the world: selection, handles, and shapes being drawn.
#pragma once
#include "Host/Views/WorldView.h"
#include "Mixer/Desk/Desk.h"
#include "Mixer/World/DrawTool.h"
#include "Scene/Drawing/BodyEdits.h"
#include <optional>

namespace physvib {

/// Message thread only.
class DrawPane final : public juce::Component {
public:
    /// Both arguments outlive it. It is placed over `view`.
    DrawPane(Desk& desk, WorldView& view);

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
                      const std::function<void(const Scene&, BodyDescription&)>& change, bool goesOn = false);

    /// Number of bodies of one rain, and how they come: all at once, so many in a second of the world, or so
    /// many upwards from one place.
    struct RainWay {
        int perSecond = 0; ///< 0: all at once
        bool isFountain = false;
        bool operator==(const RainWay&) const = default;
    };
    int rainCount() const noexcept { return rainCount_; }
    void setRainCount(int count);
    const RainWay& rainWay() const noexcept { return rainWay_; }
    void setRainWay(const RainWay& way);
    void letItRain();                          ///< adds those that are due; to be called often
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

    void takeMix(); ///< the mixer state changed
    bool takeKey(const juce::KeyPress& key);
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
    void edit(const juce::String& name, std::vector<Action> actions, bool goesOn = false);
    void grip(const juce::MouseEvent& e);
    void nudge(Vector byMetres, double byRadians);
    void scaleChosen(double factor);
    void paste(const Copied& copy, Vector beside);
    void closePolygon();
    void addInTheMiddle();
    bool takeToolKey(const juce::KeyPress& key);
    std::string fieldBody(std::vector<Action>& actions, const Vector& place);
    std::string jointAt(juce::Point<float> place) const;
    Vector carried(const Vector& point, const std::string& body) const;
    juce::Line<float> lineNow(const JointDescription& joint) const;
    void drawJoints(juce::Graphics& g) const;
    void drawOutline(juce::Graphics& g, const BodyDescription& body, const BodyPlace& place,
                     juce::Colour colour, bool isFilled) const;
    void drawChosen(juce::Graphics& g) const;
    void drawStroke(juce::Graphics& g) const;

    Desk& desk_;
    WorldView& view_;
    DrawTool tool_ = DrawTool::hand;
    int material_ = -1; // at first, the first material with a frequency
    int rainCount_ = 50;
    RainWay rainWay_;
    std::vector<BodyDescription> falling_; // those of the present rain that are still to come, the next last
    std::int64_t rainFromNs_ = 0, rained_ = 0; // time of the scene, and how many have come since
    bool snaps_ = false, isDrawing_ = false;
    std::vector<std::string> chosen_;
    Copied copied_;
    Grip grip_ = Grip::none;
    std::vector<Vector> stroke_; // since the mouse was pressed, or of the polygon; metres
    Vector to_;                  // mouse position
};

} // namespace physvib
