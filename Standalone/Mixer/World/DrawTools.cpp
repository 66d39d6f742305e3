// SPDX-License-Identifier: GPL-3.0-or-later
// Icons of the tools, and the timing of a rain.
#include "Mixer/World/DrawTools.h"
#include "Mixer/Widgets/MixerWidgets.h"
#include "Pictures/ShapeOutline.h"

namespace physvib {

juce::Path toolIcon(DrawTool tool) {
    juce::Path icon, line;
    const auto stroke = [&icon, &line](float width = 1.8f) {
        juce::PathStrokeType{width}.createStrokedPath(icon, line);
    };
    switch (tool) {
    case DrawTool::hand: // a ball being thrown
        icon.addEllipse(-8.0f, 0.0f, 8.0f, 8.0f);
        icon.addArrow({{0.0f, 0.0f}, {8.0f, -8.0f}}, 1.8f, 7.0f, 6.0f);
        break;
    case DrawTool::select:
        icon.startNewSubPath(-5.0f, -8.0f);
        for (const auto& [x, y] :
             {std::pair{-5.0f, 6.0f}, {-1.5f, 2.8f}, {0.8f, 8.0f}, {3.2f, 7.0f}, {1.0f, 2.0f}, {5.5f, 2.0f}})
            icon.lineTo(x, y);
        icon.closeSubPath();
        break;
    case DrawTool::ball: icon.addEllipse(-7.0f, -7.0f, 14.0f, 14.0f); break;
    case DrawTool::box: icon.addRectangle(-7.0f, -5.5f, 14.0f, 11.0f); break;
    case DrawTool::polygon: icon.addPolygon({}, 5, 8.0f); break;
    case DrawTool::line:
        line.startNewSubPath(-8.0f, 4.0f);
        line.cubicTo(-3.0f, -12.0f, 2.0f, 12.0f, 8.0f, -4.0f);
        stroke();
        break;
    case DrawTool::wall:
        line.addLineSegment({-7.0f, 5.0f, 7.0f, -5.0f}, 5.0f);
        icon = line;
        break;
    case DrawTool::rain:
        for (const auto& [x, y] : {std::pair{-6.0f, -6.0f},
                                   {2.0f, -7.0f},
                                   {-2.0f, 0.0f},
                                   {5.0f, 0.0f},
                                   {-6.0f, 5.0f},
                                   {2.0f, 6.0f}})
            icon.addEllipse(x - 2.0f, y - 2.0f, 4.5f, 4.5f);
        break;
    case DrawTool::conveyor:
        for (const float x : {-6.0f, 0.0f, 6.0f}) icon.addEllipse(x - 2.5f, 1.5f, 5.0f, 5.0f);
        line.addArrow({{-8.0f, -4.0f}, {8.0f, -4.0f}}, 1.8f, 7.0f, 6.0f);
        icon.addPath(line);
        break;
    case DrawTool::pin:
        icon.addEllipse(-4.0f, -4.0f, 8.0f, 8.0f);
        line.addEllipse(-8.0f, -8.0f, 16.0f, 16.0f);
        stroke(1.4f);
        break;
    case DrawTool::rope:
        icon.addEllipse(-9.0f, -7.0f, 5.0f, 5.0f);
        icon.addEllipse(4.0f, -7.0f, 5.0f, 5.0f);
        line.startNewSubPath(-6.5f, -4.0f);
        line.quadraticTo(0.0f, 13.0f, 6.5f, -4.0f);
        stroke(1.4f);
        break;
    case DrawTool::spring:
        line = coilOutline<juce::Path>(juce::Point{-9.0f, 0.0f}, juce::Point{9.0f, 0.0f}, 6.0f, 3);
        stroke(1.6f);
        break;
    case DrawTool::slider:
        icon.addRectangle(-4.0f, -4.0f, 8.0f, 8.0f);
        line.addLineSegment({-9.0f, 0.0f, 9.0f, 0.0f}, 1.5f);
        icon.addPath(line);
        break;
    case DrawTool::motor:
        line.addCentredArc(0.0f, 0.0f, 6.5f, 6.5f, 0.0f, -2.4f, 2.0f, true);
        stroke(2.0f);
        icon.addEllipse(-2.5f, -2.5f, 5.0f, 5.0f);
        icon.addTriangle(9.0f, 0.0f, 2.5f, 2.0f, 8.0f, 7.0f);
        break;
    case DrawTool::eraser:
        line.addRoundedRectangle(-8.0f, -4.0f, 16.0f, 8.0f, 2.0f);
        line.startNewSubPath(-2.0f, -4.0f);
        line.lineTo(-2.0f, 4.0f);
        stroke(1.6f);
        icon.applyTransform(juce::AffineTransform::rotation(-0.6f));
    }
    return icon;
}

namespace {

constexpr const char* rainEditName = "Let it rain";
constexpr double fountainHeightShare = 0.5; // height of a fountain, share of the field's
constexpr double sidewaysShare = 0.25;      // maximum sideways speed, share of the upward speed
constexpr int jetCount = 7;                 // with one jet, the balls would follow each other exactly

/// Starts all bodies at the middle of their places, with upward velocities.
void setFountainStart(std::vector<BodyDescription>& bodies, const Scene& scene) {
    Vector centroid;
    for (const BodyDescription& body : bodies) {
        centroid.x += body.positionMetres.x / static_cast<double>(bodies.size());
        centroid.y += body.positionMetres.y / static_cast<double>(bodies.size());
    }
    const double gravity = std::hypot(scene.gravityMetresPerSecond2.x, scene.gravityMetresPerSecond2.y),
                 upSpeed = std::sqrt(2.0 * gravity * fountainHeightShare * scene.fieldHeightMetres);
    for (std::size_t k = 0; k < bodies.size(); ++k) {
        const int jet = static_cast<int>(3 * k) % jetCount - jetCount / 2; // consecutive balls differ
        bodies[k].positionMetres = centroid;
        bodies[k].velocityMetresPerSecond = {2.0 * sidewaysShare * upSpeed * jet / (jetCount - 1), upSpeed};
    }
}

} // namespace

void Rain::start(std::vector<BodyDescription> bodies) {
    if (pattern_.isFountain) setFountainStart(bodies, model_.world().drawing().drawn());
    std::ranges::reverse(bodies);
    pendingBodies_ = std::move(bodies);
    scene_ = model_.mix().scene;
    runNumber_ = model_.session().world().runNumber();
    startNs_ = model_.session().world().sceneNs();
    spawnedCount_ = 0;
    model_.undoManager().beginNewTransaction(rainEditName);
    spawnDueBodies();
}

// Counts simulated time: a rain waits in a pause. It ends when the scene restarts or the rain is undone.
void Rain::spawnDueBodies() {
    if (pendingBodies_.empty()) return;
    const auto elapsedNs = model_.session().world().sceneNs() - startNs_;
    const bool isFirst = spawnedCount_ == 0; // before it, the step to redo may be an earlier rain
    const bool isUndone = !isFirst && model_.undoManager().getRedoDescription() == rainEditName;
    const bool isSameRun = scene_ == model_.mix().scene && runNumber_ == model_.session().world().runNumber();
    if (!isSameRun || isUndone) return pendingBodies_.clear();
    const auto dueCount = 1 + elapsedNs * pattern_.bodiesPerSecond / 1'000'000'000;
    std::vector<Action> actions;
    std::string name;
    for (; spawnedCount_ < dueCount && !pendingBodies_.empty(); ++spawnedCount_) {
        if (!isFirst) // another rain may have taken its name
            pendingBodies_.back().name =
                model_.world().drawing().unusedNames("rain", actions.size() + 1).back();
        name = pendingBodies_.back().name;
        actions.push_back(SpawnAction{std::move(pendingBodies_.back()), {}});
        pendingBodies_.pop_back();
    }
    if (actions.empty()) return;
    if (model_.reportIfError(model_.world().edit(rainEditName, std::move(actions), true)))
        return pendingBodies_.clear();
    if (isFirst) hintOnBody(model_, name);
}

} // namespace physvib
