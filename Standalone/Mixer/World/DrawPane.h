// SPDX-License-Identifier: GPL-3.0-or-later
// Drawing layer over the view of the world: selection, handles, and shapes being drawn.
#pragma once
#include "Host/Views/WorldView.h"
#include "Mixer/World/DrawTools.h"
#include "Scene/Drawing/BodyEdits.h"

namespace physvib {

/// Turns what the mouse and the keys do over the world into edits of its scene, each of which can be undone.
/// A stroke is kept in metres of the field, so that zooming and a world that moves do not change it. It goes
/// through these steps:
/// 1. mouseDown: the tool decides whether a stroke begins (shapes, joints), a selected body is gripped by one
///    of its handles, or the press goes on to the view below, which throws bodies (the hand tool).
/// 2. mouseDrag: the stroke grows, snapped to the grid if isSnapping(). What it would become is painted each
///    time from the stroke; the scene does not change yet, except by the eraser.
/// 3. mouseUp: the stroke becomes bodies, a joint, or new places of the selected bodies: one edit.
/// Message thread.
class DrawPane final : public juce::Component {
public:
    /// Both arguments outlive it. It is placed over `view`.
    DrawPane(MixerModel& model, WorldView& view);

    void setTool(DrawTool tool); ///< the hand tool acts in the view below
    DrawTool tool() const noexcept { return tool_; }
    void setMaterial(int material);         ///< for new bodies and, with the tool select, the selected ones
    void setSelectedMaterial(int material); ///< of the selected bodies only
    int material() const noexcept { return material_; }
    void setSnapping(bool isSnapping);
    bool isSnapping() const noexcept { return isSnapping_; }

    const std::vector<std::string>& selected() const noexcept { return selected_; } ///< selected bodies
    void select(std::vector<std::string> names);
    void selectAll();
    /// Changes each selected body in place, as one edit.
    void changeSelected(const juce::String& name,
                        const std::function<void(const Scene&, BodyDescription&)>& change,
                        bool continuesEdit = false);

    int rainCount() const noexcept { return rainCount_; }
    void setRainCount(int count);
    const RainPattern& rainPattern() const noexcept { return rain_.pattern(); }
    void setRainPattern(const RainPattern& pattern);
    void spawnDueBodies() { rain_.spawnDueBodies(); } ///< adds bodies of a rain; call it at every refresh

    // Menu commands, at places in metres of the field.
    void addAt(DrawTool tool, Vector place); ///< a body of the default size, or a joint
    void addJointAt(DrawTool tool, Vector place) { addAt(tool, place); }
    void copy(const std::vector<std::string>& names) { clipboard_ = copyBodies(drawing(), names); }
    bool hasCopy() const noexcept { return !clipboard_.bodies.empty(); }
    void pasteAt(Vector place);
    void eraseBodies(const std::vector<std::string>& names, bool continuesEdit = false);

    std::function<void()> onChange;                       ///< tool, selection or material changed
    std::function<void(juce::Point<float> pixel)> onMenu; ///< right click

    juce::Rectangle<float> selectionBounds() const; ///< of the selected bodies, in pixels; empty: none

    std::optional<BodyPlace> currentPlace(const std::string& name) const; ///< nullopt: it is not in the world

    bool isDrawing() const noexcept { return isDrawing_; } ///< also while selected bodies are dragged
    void cancelStroke();

    void mixChanged(); ///< to be called after each change of the mixer state
    bool handleKey(const juce::KeyPress& key);
    void paint(juce::Graphics& g) override;
    void mouseDown(const juce::MouseEvent& e) override;
    void mouseDrag(const juce::MouseEvent& e) override;
    void mouseUp(const juce::MouseEvent& e) override;
    void mouseMove(const juce::MouseEvent& e) override;
    void mouseDoubleClick(const juce::MouseEvent& e) override;

private:
    static constexpr double gridCellsPerField = 40.0, turnStep = juce::MathConstants<double>::pi / 12.0;
    enum class Grip { none, move, size, turn, marquee }; // what a drag with the tool select changes
    struct Handles {                                     // of one body, in pixels
        std::array<juce::Point<float>, 4> corners;
        juce::Point<float> turn;
    };
    const SceneDrawing& drawing() const noexcept { return model_.world().drawing(); }
    Vector snappedMetres(const juce::MouseEvent& e) const {
        return snapToGrid(view_.metresAt(e.position), gridMetres());
    }
    double gridMetres() const {
        return isSnapping_ ? model_.world().scene().fieldHeightMetres / gridCellsPerField : 0.0;
    }
    bool isOutsideField(juce::Point<float> pixel) const;
    std::optional<Handles> handles() const;
    BodyDescription resizedBody() const;                  ///< the selected body as the drag sizes it
    std::map<std::string, BodyPlace> movedPlaces() const; ///< selected bodies as the drag moves them
    Result<BodyDescription> strokeBody() const;           ///< body that the stroke would become
    Result<std::vector<BodyDescription>> strokeRain() const;
    Result<BodyDescription> strokeBelt() const;
    void addStroke();
    bool prepareBodies(std::vector<BodyDescription>& bodies);
    void add(Result<std::vector<BodyDescription>> bodies);
    void addJoint();
    void eraseAt(const juce::MouseEvent& e);
    void edit(const juce::String& name, std::vector<Action> actions, bool continuesEdit = false);
    void beginGrip(const juce::MouseEvent& e);
    void nudge(Vector shiftMetres, double turnRadians);
    void scaleSelected(double factor);
    void paste(const CopiedBodies& copy, Vector shiftMetres);
    void closePolygon();
    void addAtCentre();
    bool handleToolKey(const juce::KeyPress& key);
    std::string findOrAddAnchor(std::vector<Action>& actions, const Vector& place); ///< a static body's name
    std::string jointAt(juce::Point<float> pixel) const; ///< name of the joint; empty: none
    Vector atCurrentPose(const Vector& point, const std::string& body) const; ///< moved with `body`
    juce::Line<float> jointLine(const JointDescription& joint) const;         ///< in pixels
    void drawBelts(juce::Graphics& g) const;
    void drawJoints(juce::Graphics& g) const;
    void drawOutline(juce::Graphics& g, const BodyDescription& body, const BodyPlace& place,
                     juce::Colour colour, bool isFilled) const;
    void drawSelection(juce::Graphics& g) const;
    void drawStroke(juce::Graphics& g) const;

    MixerModel& model_;
    WorldView& view_;
    DrawTool tool_ = DrawTool::hand;
    int material_ = 0;
    bool isMaterialChosen_ = false;              // the user chose the material
    std::shared_ptr<const Scene> materialScene_; // scene for which it was chosen
    int rainCount_ = 50;
    Rain rain_;
    bool isSnapping_ = false, isDrawing_ = false;
    std::vector<std::string> selected_;
    CopiedBodies clipboard_;
    Grip grip_ = Grip::none;
    std::vector<Vector> stroke_; // points of the stroke, or corners of the polygon, in metres
    Vector pointerMetres_;       // mouse position
};

} // namespace physvib
