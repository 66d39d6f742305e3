// SPDX-License-Identifier: GPL-3.0-or-later
// Icons of the tools, and the timing of a rain.
#include "Mixer/World/DrawTools.h"
#include "Mixer/Widgets/Parts.h"
#include "Pictures/ShapeOutline.h"

namespace physvib {

juce::Path signOf(DrawTool tool) {
    juce::Path p, line;
    const auto stroke = [&p, &line](float width = 1.8f) {
        juce::PathStrokeType{width}.createStrokedPath(p, line);
    };
    switch (tool) {
    case DrawTool::hand: // a ball being thrown
        p.addEllipse(-8.0f, 0.0f, 8.0f, 8.0f);
        p.addArrow({{0.0f, 0.0f}, {8.0f, -8.0f}}, 1.8f, 7.0f, 6.0f);
        break;
    case DrawTool::choose:
        p.startNewSubPath(-5.0f, -8.0f);
        for (const auto& [x, y] :
             {std::pair{-5.0f, 6.0f}, {-1.5f, 2.8f}, {0.8f, 8.0f}, {3.2f, 7.0f}, {1.0f, 2.0f}, {5.5f, 2.0f}})
            p.lineTo(x, y);
        p.closeSubPath();
        break;
    case DrawTool::ball: p.addEllipse(-7.0f, -7.0f, 14.0f, 14.0f); break;
    case DrawTool::box: p.addRectangle(-7.0f, -5.5f, 14.0f, 11.0f); break;
    case DrawTool::polygon: p.addPolygon({}, 5, 8.0f); break;
    case DrawTool::line:
        line.startNewSubPath(-8.0f, 4.0f);
        line.cubicTo(-3.0f, -12.0f, 2.0f, 12.0f, 8.0f, -4.0f);
        stroke();
        break;
    case DrawTool::wall:
        line.addLineSegment({-7.0f, 5.0f, 7.0f, -5.0f}, 5.0f);
        p = line;
        break;
    case DrawTool::rain:
        for (const auto& [x, y] : {std::pair{-6.0f, -6.0f},
                                   {2.0f, -7.0f},
                                   {-2.0f, 0.0f},
                                   {5.0f, 0.0f},
                                   {-6.0f, 5.0f},
                                   {2.0f, 6.0f}})
            p.addEllipse(x - 2.0f, y - 2.0f, 4.5f, 4.5f);
        break;
    case DrawTool::conveyor:
        for (const float x : {-6.0f, 0.0f, 6.0f}) p.addEllipse(x - 2.5f, 1.5f, 5.0f, 5.0f);
        line.addArrow({{-8.0f, -4.0f}, {8.0f, -4.0f}}, 1.8f, 7.0f, 6.0f);
        p.addPath(line);
        break;
    case DrawTool::pin:
        p.addEllipse(-4.0f, -4.0f, 8.0f, 8.0f);
        line.addEllipse(-8.0f, -8.0f, 16.0f, 16.0f);
        stroke(1.4f);
        break;
    case DrawTool::rope:
        p.addEllipse(-9.0f, -7.0f, 5.0f, 5.0f);
        p.addEllipse(4.0f, -7.0f, 5.0f, 5.0f);
        line.startNewSubPath(-6.5f, -4.0f);
        line.quadraticTo(0.0f, 13.0f, 6.5f, -4.0f);
        stroke(1.4f);
        break;
    case DrawTool::spring:
        line = coilOutline<juce::Path>(juce::Point{-9.0f, 0.0f}, juce::Point{9.0f, 0.0f}, 6.0f, 3);
        stroke(1.6f);
        break;
    case DrawTool::slider:
        p.addRectangle(-4.0f, -4.0f, 8.0f, 8.0f);
        line.addLineSegment({-9.0f, 0.0f, 9.0f, 0.0f}, 1.5f);
        p.addPath(line);
        break;
    case DrawTool::motor:
        line.addCentredArc(0.0f, 0.0f, 6.5f, 6.5f, 0.0f, -2.4f, 2.0f, true);
        stroke(2.0f);
        p.addEllipse(-2.5f, -2.5f, 5.0f, 5.0f);
        p.addTriangle(9.0f, 0.0f, 2.5f, 2.0f, 8.0f, 7.0f);
        break;
    case DrawTool::eraser:
        line.addRoundedRectangle(-8.0f, -4.0f, 16.0f, 8.0f, 2.0f);
        line.startNewSubPath(-2.0f, -4.0f);
        line.lineTo(-2.0f, 4.0f);
        stroke(1.6f);
        p.applyTransform(juce::AffineTransform::rotation(-0.6f));
    }
    return p;
}

namespace {

constexpr const char* rainStep = "Let it rain";
constexpr double rise = 0.5;     // height of a fountain, share of the field's
constexpr double spread = 0.25;  // maximum sideways speed, share of the upward speed
constexpr int differentJets = 7; // balls of one jet would follow each other exactly

/// Starts all bodies at the middle of their places, with upward velocities.
void makeFountain(std::vector<BodyDescription>& bodies, const Scene& scene) {
    Vector middle;
    for (const BodyDescription& body : bodies) {
        middle.x += body.positionMetres.x / static_cast<double>(bodies.size());
        middle.y += body.positionMetres.y / static_cast<double>(bodies.size());
    }
    const double gravity = std::hypot(scene.gravityMetresPerSecond2.x, scene.gravityMetresPerSecond2.y),
                 up = std::sqrt(2.0 * gravity * rise * scene.fieldHeightMetres);
    for (std::size_t k = 0; k < bodies.size(); ++k) {
        const int jet = static_cast<int>(3 * k) % differentJets - differentJets / 2; // neighbours differ
        bodies[k].positionMetres = middle;
        bodies[k].velocityMetresPerSecond = {2.0 * spread * up * jet / (differentJets - 1), up};
    }
}

} // namespace

void Rain::begin(std::vector<BodyDescription> bodies) {
    if (pattern_.isFountain) makeFountain(bodies, model_.world().drawing().drawn());
    std::ranges::reverse(bodies);
    falling_ = std::move(bodies);
    fromNs_ = model_.session().world().sceneNs();
    spawned_ = 0;
    model_.undoManager().beginNewTransaction(rainStep);
    spawnDueBodies();
}

// In simulated time: a rain waits in a pause, and ends when the scene restarts or the rain is undone.
void Rain::spawnDueBodies() {
    if (falling_.empty()) return;
    const auto passed = model_.session().world().sceneNs() - fromNs_;
    const bool isUndone = model_.undoManager().getRedoDescription() == rainStep;
    if (passed < 0 || isUndone) return falling_.clear();
    const auto due = 1 + passed * pattern_.perSecond / 1'000'000'000;
    const bool isFirst = spawned_ == 0;
    std::vector<Action> actions;
    std::string name;
    for (; spawned_ < due && !falling_.empty(); ++spawned_) {
        if (!isFirst) // another rain may have taken its name
            falling_.back().name = model_.world().drawing().freeNames("rain", actions.size() + 1).back();
        name = falling_.back().name;
        actions.push_back(SpawnAction{std::move(falling_.back()), {}});
        falling_.pop_back();
    }
    if (actions.empty()) return;
    if (model_.reportFault(model_.world().edit(rainStep, std::move(actions), true))) return falling_.clear();
    if (isFirst) hintOnBody(model_, name);
}

} // namespace physvib
