// SPDX-License-Identifier: GPL-3.0-or-later
// The world as it is felt now: bodies, hits as light, enchanters with what they play. Where a hand may act,
// bodies can be pulled and enchanters moved.
#pragma once
#include "Core/CollisionEvent.h"
#include "Core/PhantomPanner.h"
#include "Host/Views/Look.h"
#include "Host/Views/MaterialTexture.h"
#include "Scene/LayoutFile.h"
#include "Scene/Scene.h"
#include "Scene/World/SceneWorld.h"
#include <deque>
#include <functional>
#include <optional>
#include <span>

namespace physvib {

/// What is new since the last call of WorldView::update.
struct WorldMoment {
    std::vector<BodyPose> poses; ///< of the cast, as at `sessionNs`
    std::int64_t sessionNs = 0;
    std::int64_t aheadNs = 0;             ///< they are felt so much later
    std::span<const CollisionEvent> hits; ///< that have been played
    std::span<const float> peaks;         ///< per enchanter, 1 = full scale
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
    /// What modules say of themselves while they are dragged here.
    static constexpr const char* newEnchanter = "physvib-new-enchanter";

    WorldView();

    /// Another scene, or one with more bodies. M.
    void show(const Scene& scene);
    /// Enchanters, and how hits are spread over them. M.
    void show(const LayoutDescription& layout, const PhantomPanner& panner);
    /// M, a few times a second; repaints what is not as before.
    void update(WorldMoment moment);
    /// Bodies have the textures of their materials, where these have any; else one colour per material. M.
    void showMaterials(bool areShown) { showsMaterials_ = areShown, repaint(); }
    /// Instead of the textures of these materials. M.
    void showPictures(std::vector<MaterialPicture> pictures) { pictures_ = std::move(pictures), repaint(); }
    /// So many metres of the world are one on the display, see setDisplayWidth(); 0: the field is as large as
    /// fits. M.
    void setWorldScale(double metresPerMetre) { worldScale_ = metresPerMetre, repaint(); }
    /// Whether all of the field is seen at that scale. M.
    bool fits() const { return worldScale_ <= 0.0 || map().pixelsPerMetre <= fittingPixelsPerMetre(); }
    /// Behind the bodies: what that enchanter plays of a hit at each place; -1: nothing. M.
    void showGainsOf(int enchanter);
    /// How wide the display is that this is seen on, see screenPixelsPerMetre(). M.
    void setDisplayWidth(double metres) { displayWidthMetres_ = metres; }
    /// Room below the field for what is written over the view. M.
    void setFootRoom(int pixels) { footRoom_ = pixels; }
    /// Around the field: badges sit on its edge, where there are any. M.
    void setMargin(int pixels) { margin_ = pixels; }
    void select(int enchanter); ///< drawn with a ring; -1: none
    /// A cross in the field where something is to be felt; none: no cross. M.
    void showSpot(std::optional<FieldShare> spot);

    // What a hand does; what is not set cannot be done. M.
    /// in the field's axes; the point on the body, in the field's metres
    std::function<void(const std::string& body, Vector screenMetres, Vector pointMetres)> onPull;
    /// with Shift, while it is held: which point, as for onPull, and where in the field the hand is
    std::function<void(const std::string& body, Vector pointMetres, Vector toMetres)> onHold;
    std::function<void(const std::string& body)> onLetGo;      ///< of what was held
    std::function<juce::String(double screenMetres)> pullText; ///< beside the line while it is pulled
    /// while it is moved
    std::function<void(int enchanter, FieldShare to)> onMove;
    std::function<void(int enchanter)> onDetach; ///< dropped outside
    std::function<void(FieldShare at)> onAttach;
    std::function<void(int enchanter)> onSelect;
    std::function<void(const std::string& body, FieldShare at)> onMenu; ///< right click; body may be empty
    std::function<void(FieldShare at)> onSpot;                          ///< a click that drags nothing
    /// whether those that are dragged here may be dropped
    std::function<bool(const juce::StringArray& files)> takesFiles;
    /// dropped on that enchanter; -1: in the field
    std::function<void(const juce::StringArray& files, int enchanter, FieldShare at)> onFiles;

    void paint(juce::Graphics& g) override;
    void resized() override { gains_ = {}; }
    void mouseDown(const juce::MouseEvent& e) override;
    void mouseDrag(const juce::MouseEvent& e) override;
    void mouseUp(const juce::MouseEvent& e) override;
    void mouseMove(const juce::MouseEvent& e) override;
    bool isInterestedInDragSource(const SourceDetails& details) override;
    void itemDragMove(const SourceDetails& details) override;
    void itemDragExit(const SourceDetails&) override;
    void itemDropped(const SourceDetails& details) override;
    bool isInterestedInFileDrag(const juce::StringArray& files) override {
        return takesFiles && takesFiles(files);
    }
    void fileDragMove(const juce::StringArray& files, int x, int y) override;
    void fileDragExit(const juce::StringArray& files) override;
    void filesDropped(const juce::StringArray& files, int x, int y) override;

    /// Where things are, in pixels of this component. M.
    juce::Point<float> placeOfShare(FieldShare at) const;
    juce::Point<float> placeOfEnchanter(int enchanter) const;
    juce::Point<float> placeOfBody(const std::string& name) const; ///< outside the view if it is not there
    bool isHolding() const noexcept { return !grip_.held.empty(); }

    /// For who draws over this view. Places in metres of the field, also beyond its edges. M.
    juce::Point<float> placeOfMetres(Vector at) const { return map().at(at.x, at.y); }
    Vector metresAt(juce::Point<float> place) const;
    float pixelsPerMetre() const { return map().pixelsPerMetre; }
    std::optional<BodyPose> poseOfBody(const std::string& name) const; ///< as it is drawn; none: not there
    std::vector<std::string> bodiesAt(juce::Point<float> place) const; ///< of any type, the one on top first

private:
    struct Snapshot {
        std::int64_t timeNs;
        std::vector<BodyPose> poses;
    };
    struct Hit {
        CollisionEvent event;
        juce::Colour colour;
        double shownAtMs;
    };
    struct Trace { // what rolled or slid between two looks
        CollisionSource source;
        Vector fromMetres, toMetres;
        double amplitude;
        juce::Colour colour;
        double shownAtMs;
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
    struct Grip { // what the mouse holds
        int enchanter = -1, body = -1;
        juce::Point<float> from, to;
        bool isOutside = false;
        std::string held{}; // the body's name
        Vector point{};     // where on it
    };
    juce::Rectangle<float> roomOfField() const;
    float fittingPixelsPerMetre() const; ///< with which the field is as large as fits
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
    juce::Rectangle<float> badgeOf(int enchanter, const Map& at) const;
    void drawGround(juce::Graphics& g, const Map& at);
    void drawBodies(juce::Graphics& g, const Map& at) const;
    void drawHits(juce::Graphics& g, const Map& at) const;
    void take(const CollisionEvent& event, double nowMs);
    void drawTraces(juce::Graphics& g, const Map& at) const;
    void drawRays(juce::Graphics& g, const Map& at) const;
    void drawHalos(juce::Graphics& g, const Map& at) const;
    void drawEnchanters(juce::Graphics& g, const Map& at) const;
    void drawSpot(juce::Graphics& g) const;
    void drawGrip(juce::Graphics& g) const;
    void drawFiles(juce::Graphics& g) const;

    Scene scene_;
    struct Fate { // what inputs do to a body of the cast: it may not have happened yet where the world stands
                  // still
        bool isGone = false; // removed, or changed, in which case another has its name
        int before = -1;     // whose place it takes
    };
    std::vector<BodyDescription> cast_;
    std::vector<Fate> fates_;  // of them
    std::size_t scripted_ = 0; // below stands scriptedCast()
    LayoutDescription layout_;
    PhantomPanner panner_;
    std::deque<Snapshot> ahead_; // not felt yet, but for the first
    std::deque<Hit> hits_;
    std::deque<Trace> traces_;
    std::array<float, limits::maxEnchanters> peaks_{};
    double displayWidthMetres_ = 0.0, worldScale_ = 0.0;
    std::vector<MaterialPicture> pictures_;
    int shownGains_ = -1, selected_ = -1, footRoom_ = 0, margin_ = 38;
    bool showsMaterials_ = false;
    juce::Image gains_;
    Grip grip_;
    std::optional<juce::Point<float>> dropAt_, filesAt_;
    std::optional<FieldShare> spot_;
};

/// What `enchanter` plays of a hit at each place of the field, as opacity of `colour`. M.
juce::Image gainImage(const PhantomPanner& panner, int enchanter, juce::Colour colour, int width, int height);

} // namespace physvib
