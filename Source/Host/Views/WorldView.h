// SPDX-License-Identifier: GPL-3.0-or-later
// WorldView shows the world as the actuators render it now: bodies, hits as flashes, actuators with their
// levels; the user can drag bodies and actuators where callbacks allow it. Also the size of displays.
#pragma once
#include "Core/CollisionEvent.h"
#include "Core/PhantomPanner.h"
#include "Host/Views/Look.h"
#include "Host/Views/WorldPictures.h"
#include "Scene/LayoutFile.h"
#include "Scene/Scene.h"
#include "Scene/World/SceneWorld.h"
#include <deque>
#include <functional>
#include <juce_gui_basics/juce_gui_basics.h>
#include <optional>
#include <span>

namespace physvib {

/// What has changed since the last call of WorldView::update().
struct WorldFrame {
    std::vector<BodyPose> poses; ///< poses of the bodies at `sessionNs`
    std::int64_t sessionNs = 0;
    std::int64_t aheadNs = 0;                                ///< output latency, after which poses are drawn
    std::span<const CollisionEvent> hits;                    ///< events played since the last frame
    std::span<const float> peaks;                            ///< per actuator, 1 = full scale
    bool isFelt = true;                                      ///< false: the hits are muted and drawn dim
    double nowMs = juce::Time::getMillisecondCounterHiRes(); ///< time of the picture, for ages of glows
};

/// A place in the field, each coordinate 0 to 1 from its lower left corner.
struct FieldShare {
    double x = 0.0, y = 0.0;
    bool operator==(const FieldShare&) const = default;
};

class WorldView final : public juce::Component,
                        public juce::DragAndDropTarget,
                        public juce::FileDragAndDropTarget {
public:
    /// Drag description of a new actuator.
    static constexpr const char* newActuatorDrag = "physvib-new-enchanter";

    WorldView();

    /// Shows another scene, or the same with more bodies. M.
    void show(const Scene& scene);
    /// Sets the actuators, their panner, and for each whether it is muted or lacks an output. M.
    void show(const LayoutDescription& layout, const PhantomPanner& panner, std::vector<bool> muted = {},
              std::vector<bool> withoutOutput = {});
    /// Shows the next frame, and repaints if it differs. M, several times a second.
    void update(WorldFrame moment);
    /// Draws bodies with the textures of their materials where there are any; otherwise one colour per
    /// material. M.
    void showMaterials(bool areShown) { showsMaterials_ = areShown, repaint(); }
    /// Pictures that replace the textures of these materials. M.
    void showPictures(std::vector<MaterialPicture> pictures) { pictures_ = std::move(pictures), repaint(); }
    /// Metres of the world per metre of the display, see setDisplayWidth(); 0: the field fills the view. M.
    void setWorldScale(double metresPerMetre) { worldScale_ = metresPerMetre, repaint(); }
    /// Whether the whole field is visible at that scale. M.
    bool fits() const { return worldScale_ <= 0.0 || map().pixelsPerMetre <= fittingPixelsPerMetre(); }
    /// Shows the gain of that actuator at each place, behind the bodies; -1: off. M.
    void showGainMap(int actuator);
    /// Width of the display, see screenPixelsPerMetre(). M.
    void setDisplayWidth(double metres) { displayWidthMetres_ = metres; }
    /// Space kept free around the field, for text and tools over the view. M.
    void setPadding(juce::BorderSize<int> pixels) { padding_ = pixels, resized(), repaint(); }
    /// Width kept free around the field, for the actuators on its edge. M.
    void setMargin(int pixels) { margin_ = pixels; }
    /// Draws that actuator as selected; -1: none. M.
    void select(int actuator) { setAndRepaint(*this, selected_, actuator); }
    /// Draws a cross at a place in the field; none: no cross. M.
    void showSpot(std::optional<FieldShare> spot) { setAndRepaint(*this, spot_, spot); }

    // Callbacks for mouse input; without a callback the action is disabled. M.
    /// After the drag of a body: the distance on the screen in the field's axes, and the point of the body
    /// that was dragged, in metres.
    std::function<void(const std::string& body, Vector screenMetres, Vector pointMetres)> onFling;
    /// While a body is held with Shift: its point, as for onFling, and the mouse, in metres of the field.
    std::function<void(const std::string& body, Vector pointMetres, Vector toMetres)> onHold;
    std::function<void(const std::string& body)> onRelease;     ///< of the body that was held
    std::function<juce::String(double screenMetres)> flingText; ///< text beside the line while pulling
    /// While an actuator is dragged: its new place.
    std::function<void(int actuator, FieldShare to)> onMove;
    std::function<void(int actuator)> onDetach; ///< dropped outside
    std::function<void(FieldShare place)> onAttach;
    std::function<void(int actuator)> onSelect;
    std::function<void(juce::Point<float> place)> onMenu; ///< right click; targetAt() says on what
    std::function<void(FieldShare place)> onSpot;         ///< a click without a drag
    /// Whether the dragged files may be dropped.
    std::function<bool(const juce::StringArray& files)> acceptsFiles;
    /// Files dropped on that actuator; -1: in the field.
    std::function<void(const juce::StringArray& files, int actuator, FieldShare place)> onFiles;

    void paint(juce::Graphics& g) override;
    void resized() override { gainMap_ = {}, badges_.clear(); }
    void mouseDown(const juce::MouseEvent& e) override;
    void mouseDrag(const juce::MouseEvent& e) override;
    void mouseUp(const juce::MouseEvent& e) override;
    void mouseMove(const juce::MouseEvent& e) override;
    bool isInterestedInDragSource(const SourceDetails& details) override;
    void itemDragMove(const SourceDetails& details) override;
    void itemDragExit(const SourceDetails&) override;
    void itemDropped(const SourceDetails& details) override;
    bool isInterestedInFileDrag(const juce::StringArray& files) override {
        return acceptsFiles && acceptsFiles(files);
    }
    void fileDragMove(const juce::StringArray& files, int x, int y) override;
    void fileDragExit(const juce::StringArray& files) override;
    void filesDropped(const juce::StringArray& files, int x, int y) override;

    /// Positions in pixels of this component. M.
    juce::Point<float> pixelOfShare(FieldShare place) const;
    juce::Point<float> actuatorPixel(int actuator) const;
    juce::Point<float> pixelOfBody(const std::string& name) const; ///< outside the view if the body is absent
    bool isHolding() const noexcept { return !grip_.held.empty(); }
    bool isDragging() const noexcept { return grip_.body >= 0 || grip_.actuator >= 0; }
    void cancelDrag(); ///< releases what is dragged without throwing it

    /// For components that draw over this view. Places in metres of the field; they may lie outside it. M.
    juce::Point<float> pixelOfMetres(Vector place) const { return map().toPixel(place.x, place.y); }
    Vector metresAt(juce::Point<float> place) const;
    float pixelsPerMetre() const { return map().pixelsPerMetre; }
    std::optional<BodyPose> poseOfBody(const std::string& name) const; ///< as drawn; none: absent
    std::vector<std::string> bodiesAt(juce::Point<float> place) const; ///< of any type, topmost first
    /// What lies at a place: an actuator, else the topmost body, else nothing.
    struct Target {
        int actuator = -1;
        std::string body;
        FieldShare at;
    };
    Target targetAt(juce::Point<float> place) const;
    /// Rectangles in pixels of the displayed layout, which may be one refresh older than the session's.
    const std::vector<juce::Rectangle<float>>& badges() const;
    juce::Rectangle<float> badgeAt(int actuator) const {
        return badges()[static_cast<std::size_t>(actuator)];
    }

private:
    struct Snapshot {
        std::int64_t timeNs;
        std::vector<BodyPose> poses;
    };
    struct Hit {
        CollisionEvent event;
        juce::Colour colour;
        double shownAtMs;
        bool isFelt;
    };
    struct Trace { // path of a rolling or sliding contact between two updates
        CollisionSource source;
        Vector fromMetres, toMetres;
        double amplitude;
        juce::Colour colour;
        double shownAtMs;
        bool isFelt;
    };
    struct FieldTransform {
        juce::Rectangle<float> field;
        float pixelsPerMetre;
        juce::Point<float> toPixel(double x, double y) const {
            return {field.getX() + static_cast<float>(x) * pixelsPerMetre,
                    field.getBottom() - static_cast<float>(y) * pixelsPerMetre};
        }
        FieldShare toShare(juce::Point<float> p) const {
            return {
                juce::jlimit(0.0, 1.0, static_cast<double>((p.x - field.getX()) / field.getWidth())),
                juce::jlimit(0.0, 1.0, static_cast<double>((field.getBottom() - p.y) / field.getHeight()))};
        }
    };
    struct Grip { // what the mouse drags; -1: no actuator, no body
        int actuator = -1, body = -1;
        juce::Point<float> start, end;
        bool isOutside = false;
        std::string held{}; // name of the body
        Vector point{};     // point on the body
    };
    juce::Rectangle<float> fieldArea() const;
    float fittingPixelsPerMetre() const; ///< scale at which the field just fits
    FieldTransform map() const;
    Vector bodyPoint(const Grip& grip) const;
    void hold();
    void drawHold(juce::Graphics& g) const;
    juce::Colour eventColour(const CollisionEvent& event) const;
    BodyPose bodyPose(std::size_t body) const;
    BodyPose worldPose(std::size_t body) const;
    void followInputs();
    juce::AffineTransform toTransform(const BodyPose& pose, const FieldTransform& view) const;
    juce::AffineTransform toTransform(const FixtureDescription& fixture, const BodyPose& pose,
                                      const FieldTransform& view) const;
    bool drawMaterial(juce::Graphics& g, const FixtureDescription& fixture, const juce::Path& path,
                      const juce::AffineTransform& place) const;
    int bodyAt(juce::Point<float> p) const;
    bool isOn(std::size_t body, juce::Point<float> p) const;
    int actuatorAt(juce::Point<float> p) const;
    juce::String labelFor(int actuator) const;
    juce::Font badgeFont() const;
    void drawField(juce::Graphics& g, const FieldTransform& view);
    void drawBodies(juce::Graphics& g, const FieldTransform& view);
    bool drawSmallDisc(juce::Graphics& g, const FixtureDescription& fixture, juce::Colour colour,
                       double angle, const juce::AffineTransform& place, const FieldTransform& view);
    void drawHits(juce::Graphics& g, const FieldTransform& view) const;
    void addContact(const CollisionEvent& event, double nowMs, bool isFelt);
    float relativeAge(double shownAtMs) const; ///< 0: just shown, 1: faded
    static bool isTrueAt(const std::vector<bool>& flags, int actuator) {
        return static_cast<std::size_t>(actuator) < flags.size() && flags[static_cast<std::size_t>(actuator)];
    }
    bool isMuted(int actuator) const { return isTrueAt(muted_, actuator); }
    bool isWithoutOutput(int actuator) const { return isTrueAt(withoutOutput_, actuator); }
    void drawTraces(juce::Graphics& g, const FieldTransform& view) const;
    void drawRays(juce::Graphics& g, const FieldTransform& view) const;
    void drawHalos(juce::Graphics& g) const;
    void drawActuators(juce::Graphics& g) const;
    void drawSpot(juce::Graphics& g) const;
    void drawGrip(juce::Graphics& g) const;
    void drawFiles(juce::Graphics& g) const;

    Scene scene_;
    struct BodyState {       // effect of inputs on a body, also of those that a paused world has yet to reach
        bool isGone = false; // removed, or replaced by a body of the same name
        int replaced = -1;   // index of the body it replaces
    };
    DiscPictures discs_;
    mutable GlowPictures glows_;
    std::vector<BodyDescription> bodies_;
    std::vector<BodyState> bodyStates_; // one per body of bodies_
    std::size_t firstInputBody_ = 0;    // number of bodies from scriptedBodies(), which come first
    LayoutDescription layout_;
    PhantomPanner panner_;
    std::vector<bool> muted_, withoutOutput_; // per actuator
    std::deque<Snapshot> pendingPoses_;       // the first is drawn; the others are not due yet
    std::deque<Hit> hits_;
    std::deque<Trace> traces_;
    std::array<float, limits::maxActuators> peaks_{};
    double displayWidthMetres_ = 0.0, worldScale_ = 0.0, nowMs_ = 0.0;
    std::vector<MaterialPicture> pictures_;
    juce::BorderSize<int> padding_;
    int gainMapActuator_ = -1, selected_ = -1, margin_ = 38;
    bool showsMaterials_ = false;
    juce::Image gainMap_;
    mutable std::vector<juce::Rectangle<float>> badges_; // laid out within badgeField_; empty: not yet
    mutable juce::Rectangle<float> badgeField_;
    Grip grip_;
    std::optional<juce::Point<float>> dropAt_, filesAt_;
    std::optional<FieldShare> spot_;
};

// Physical size of the display, to convert mouse movements from pixels to metres.

constexpr double minDisplayMetres = 0.03, maxDisplayMetres = 30.0; // a watch, a wall

constexpr bool isDisplayWidth(double metres) noexcept {
    return metres >= minDisplayMetres && metres <= maxDisplayMetres;
}

/// The display that shows most of `component`; without a display, the component's window. M.
inline juce::Rectangle<int> displayOf(const juce::Component& component) {
    const auto* display =
        juce::Desktop::getInstance().getDisplays().getDisplayForRect(component.getScreenBounds());
    return display != nullptr ? totalAreaOf(*display) : component.getTopLevelComponent()->getLocalBounds();
}

/// Pixels of `component` per metre on its display, `displayMetres` wide; 0: by what the system reports. M.
inline double screenPixelsPerMetre(const juce::Component& component, double displayMetres) {
    if (displayMetres > 0.0) return displayOf(component).getWidth() / displayMetres;
    constexpr double defaultDpi = 96.0, metresPerInch = 0.0254; // if the system reports none
    const auto* display =
        juce::Desktop::getInstance().getDisplays().getDisplayForRect(component.getScreenBounds());
    return (display != nullptr && display->dpi > 0.0 ? display->dpi / display->scale : defaultDpi) /
           metresPerInch;
}

} // namespace physvib
