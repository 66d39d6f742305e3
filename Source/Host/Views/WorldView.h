// SPDX-License-Identifier: GPL-3.0-or-later
// View of the world as it is currently felt: bodies, hits as flashes, actuators with their levels. The user
// can drag bodies and actuators where that is enabled. Also the physical size of displays.
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

/// News since the last call of WorldView::update.
struct WorldMoment {
    std::vector<BodyPose> poses; ///< of the bodies, at `sessionNs`
    std::int64_t sessionNs = 0;
    std::int64_t aheadNs = 0;                                ///< output latency of these poses
    std::span<const CollisionEvent> hits;                    ///< that have been played
    std::span<const float> peaks;                            ///< per actuator, 1 = full scale
    bool isFelt = true;                                      ///< false: the hits are silenced and only drawn
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
    static constexpr const char* newEnchanter = "physvib-new-enchanter";

    WorldView();

    /// Shows another scene, or the same with more bodies. M.
    void show(const Scene& scene);
    /// Sets the actuators, their panning law and which are muted; `without`: which of these lack an output.
    /// M.
    void show(const LayoutDescription& layout, const PhantomPanner& panner, std::vector<bool> muted = {},
              std::vector<bool> without = {});
    /// M, several times a second; repaints if something has changed.
    void update(WorldMoment moment);
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
    void showGainsOf(int enchanter);
    /// Width of the display, see screenPixelsPerMetre(). M.
    void setDisplayWidth(double metres) { displayWidthMetres_ = metres; }
    /// Space kept free around the field, for text and tools over the view. M.
    void setRoom(juce::BorderSize<int> pixels) { room_ = pixels, resized(), repaint(); }
    /// Width kept free around the field, for the actuators on its edge. M.
    void setMargin(int pixels) { margin_ = pixels; }
    /// Draws that actuator as selected; -1: none. M.
    void select(int enchanter) { setShown(*this, selected_, enchanter); }
    /// Draws a cross at a place in the field; none: no cross. M.
    void showSpot(std::optional<FieldShare> spot) { setShown(*this, spot_, spot); }

    // Callbacks for mouse input; without a callback the action is disabled. M.
    /// After the drag of a body: the way on the screen in the field's axes, and the body's point, in metres.
    std::function<void(const std::string& body, Vector screenMetres, Vector pointMetres)> onPull;
    /// With Shift, while the body is held: its point, as for onPull, and the mouse in the field.
    std::function<void(const std::string& body, Vector pointMetres, Vector toMetres)> onHold;
    std::function<void(const std::string& body)> onLetGo;      ///< of the body that was held
    std::function<juce::String(double screenMetres)> pullText; ///< text beside the line while pulling
    /// While an actuator is dragged: its new place.
    std::function<void(int enchanter, FieldShare to)> onMove;
    std::function<void(int enchanter)> onDetach; ///< dropped outside
    std::function<void(FieldShare at)> onAttach;
    std::function<void(int enchanter)> onSelect;
    std::function<void(juce::Point<float> place)> onMenu; ///< right click; targetAt() says on what
    std::function<void(FieldShare at)> onSpot;            ///< a click without a drag
    /// Whether the dragged files may be dropped.
    std::function<bool(const juce::StringArray& files)> acceptsFiles;
    /// Files dropped on that actuator; -1: in the field.
    std::function<void(const juce::StringArray& files, int enchanter, FieldShare at)> onFiles;

    void paint(juce::Graphics& g) override;
    void resized() override { gains_ = {}, badges_.clear(); }
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
    juce::Point<float> placeOfShare(FieldShare at) const;
    juce::Point<float> placeOfEnchanter(int enchanter) const;
    juce::Point<float> placeOfBody(const std::string& name) const; ///< outside the view if the body is absent
    bool isHolding() const noexcept { return !grip_.held.empty(); }
    bool isDragging() const noexcept { return grip_.body >= 0 || grip_.enchanter >= 0; }
    void cancelDrag(); ///< releases what is dragged without throwing it

    /// For components that draw over this view. Places in metres of the field; they may lie outside it. M.
    juce::Point<float> placeOfMetres(Vector at) const { return map().at(at.x, at.y); }
    Vector metresAt(juce::Point<float> place) const;
    float pixelsPerMetre() const { return map().pixelsPerMetre; }
    std::optional<BodyPose> poseOfBody(const std::string& name) const; ///< as drawn; none: absent
    std::vector<std::string> bodiesAt(juce::Point<float> place) const; ///< of any type, topmost first
    /// What lies at a place: an actuator, else the topmost body, else nothing.
    struct Target {
        int enchanter = -1;
        std::string body;
        FieldShare at;
    };
    Target targetAt(juce::Point<float> place) const;
    /// In pixels, of the displayed layout, which may be one refresh older than the session's.
    const std::vector<juce::Rectangle<float>>& badges() const;
    juce::Rectangle<float> badgeAt(int enchanter) const {
        return badges()[static_cast<std::size_t>(enchanter)];
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
    struct Map {
        juce::Rectangle<float> field;
        float pixelsPerMetre;
        juce::Point<float> at(double x, double y) const {
            return {field.getX() + static_cast<float>(x) * pixelsPerMetre,
                    field.getBottom() - static_cast<float>(y) * pixelsPerMetre};
        }
        FieldShare shareAt(juce::Point<float> p) const {
            return {
                juce::jlimit(0.0, 1.0, static_cast<double>((p.x - field.getX()) / field.getWidth())),
                juce::jlimit(0.0, 1.0, static_cast<double>((field.getBottom() - p.y) / field.getHeight()))};
        }
    };
    struct Grip { // what the mouse drags
        int enchanter = -1, body = -1;
        juce::Point<float> from, to;
        bool isOutside = false;
        std::string held{}; // name of the body
        Vector point{};     // point on the body
    };
    juce::Rectangle<float> roomOfField() const;
    float fittingPixelsPerMetre() const; ///< scale at which the field just fits
    Map map() const;
    Vector pointOf(const Grip& grip) const;
    void hold();
    void drawHold(juce::Graphics& g) const;
    juce::Colour colourOf(const CollisionEvent& event) const;
    BodyPose poseOf(std::size_t body) const;
    BodyPose poseBefore(std::size_t body) const;
    void followInputs();
    juce::AffineTransform placeOf(const BodyPose& pose, const Map& at) const;
    juce::AffineTransform placeOf(const FixtureDescription& fixture, const BodyPose& pose,
                                  const Map& at) const;
    bool drawMaterial(juce::Graphics& g, const FixtureDescription& fixture, const juce::Path& path,
                      const juce::AffineTransform& place) const;
    int bodyAt(juce::Point<float> p) const;
    bool isOn(std::size_t body, juce::Point<float> p) const;
    int enchanterAt(juce::Point<float> p) const;
    juce::String labelOf(int enchanter) const;
    juce::Font badgeFont() const;
    void drawGround(juce::Graphics& g, const Map& at);
    void drawBodies(juce::Graphics& g, const Map& at);
    bool drawSmall(juce::Graphics& g, const FixtureDescription& fixture, juce::Colour colour, double angle,
                   const juce::AffineTransform& place, const Map& at);
    void drawHits(juce::Graphics& g, const Map& at) const;
    void addHit(const CollisionEvent& event, double nowMs, bool isFelt);
    float ageOf(double shownAtMs) const; ///< 0: just shown, 1: faded
    static bool isSet(const std::vector<bool>& of, int enchanter) {
        return static_cast<std::size_t>(enchanter) < of.size() && of[static_cast<std::size_t>(enchanter)];
    }
    bool isMuted(int enchanter) const { return isSet(muted_, enchanter); }
    bool isWithoutOutput(int enchanter) const { return isSet(without_, enchanter); }
    void drawTraces(juce::Graphics& g, const Map& at) const;
    void drawRays(juce::Graphics& g, const Map& at) const;
    void drawHalos(juce::Graphics& g) const;
    void drawEnchanters(juce::Graphics& g) const;
    void drawSpot(juce::Graphics& g) const;
    void drawGrip(juce::Graphics& g) const;
    void drawFiles(juce::Graphics& g) const;

    Scene scene_;
    struct Fate {            // effect of inputs on a body; the input may lie ahead while the world is paused
        bool isGone = false; // removed, or replaced by a body of the same name
        int before = -1;     // index of the body it replaces
    };
    BallPictures balls_;
    mutable GlowPictures glows_;
    std::vector<BodyDescription> cast_;
    std::vector<Fate> fates_;  // one per body of cast_
    std::size_t scripted_ = 0; // number of bodies from scriptedCast(), which come first
    LayoutDescription layout_;
    PhantomPanner panner_;
    std::vector<bool> muted_, without_; // per actuator
    std::deque<Snapshot> ahead_;        // poses not felt yet, except the first
    std::deque<Hit> hits_;
    std::deque<Trace> traces_;
    std::array<float, limits::maxEnchanters> peaks_{};
    double displayWidthMetres_ = 0.0, worldScale_ = 0.0, nowMs_ = 0.0;
    std::vector<MaterialPicture> pictures_;
    juce::BorderSize<int> room_;
    int shownGains_ = -1, selected_ = -1, margin_ = 38;
    bool showsMaterials_ = false;
    juce::Image gains_;
    mutable std::vector<juce::Rectangle<float>> badges_; // of badgesIn_; empty: to be placed
    mutable juce::Rectangle<float> badgesIn_;
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
    return display != nullptr ? wholeOf(*display) : component.getTopLevelComponent()->getLocalBounds();
}

/// Pixels of `component` per metre on its display, `displayMetres` wide; 0: by what the system reports. M.
inline double screenPixelsPerMetre(const juce::Component& component, double displayMetres) {
    if (displayMetres > 0.0) return displayOf(component).getWidth() / displayMetres;
    constexpr double usualDpi = 96.0, metresPerInch = 0.0254; // if the system reports none
    const auto* display =
        juce::Desktop::getInstance().getDisplays().getDisplayForRect(component.getScreenBounds());
    return (display != nullptr && display->dpi > 0.0 ? display->dpi / display->scale : usualDpi) /
           metresPerInch;
}

} // namespace physvib
