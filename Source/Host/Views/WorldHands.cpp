// SPDX-License-Identifier: GPL-3.0-or-later
// Mouse input in the world view: pulls bodies; moves, attaches and detaches actuators.
#include "Host/Views/DisplayScale.h"
#include "Host/Views/WorldView.h"
#include "Pictures/ShapeOutline.h"
#include <algorithm>
#include <cmath>

namespace physvib {
namespace {

/// Whether the mouse moved; a long press without movement is no drag, as in JUCE.
bool isDrag(const juce::MouseEvent& e) { return e.source.hasMovedSignificantlySincePressed(); }

} // namespace

bool WorldView::isOn(std::size_t body, juce::Point<float> p) const {
    constexpr float near = 6.0f; // pixels from a line that still hit it
    const auto at = map();
    const auto pose = poseOf(body);
    if (!pose.isPresent) return false;
    const bool moves = cast_[body].type == BodyType::dynamicBody;
    return std::ranges::any_of(cast_[body].fixtures, [&](const FixtureDescription& fixture) {
        auto path = shapeOutline<juce::Path>(fixture.shape, at.pixelsPerMetre);
        path.applyTransform(placeOf(fixture, pose, at));
        if (juce::Point<float> nearest; std::holds_alternative<ChainShape>(fixture.shape))
            return path.getNearestPoint(p, nearest), nearest.getDistanceFrom(p) < near;
        return path.contains(p) ||
               (moves && path.getBounds().withSizeKeepingCentre(16.0f, 16.0f).contains(p));
    });
}

int WorldView::bodyAt(juce::Point<float> p) const {
    for (int i = static_cast<int>(cast_.size()) - 1; i >= 0; --i) // the topmost
        if (const auto body = static_cast<std::size_t>(i);
            cast_[body].type == BodyType::dynamicBody && isOn(body, p))
            return i;
    return -1;
}

std::vector<std::string> WorldView::bodiesAt(juce::Point<float> place) const {
    std::vector<std::string> names;
    for (std::size_t i = cast_.size(); i-- > 0;)
        if (isOn(i, place)) names.push_back(cast_[i].name);
    return names;
}

WorldView::Target WorldView::targetAt(juce::Point<float> place) const {
    Target target{enchanterAt(place), {}, map().shareAt(place)};
    if (target.enchanter >= 0) return target;
    const auto under = bodiesAt(place);
    if (!under.empty()) target.body = under.front();
    return target;
}

int WorldView::enchanterAt(juce::Point<float> p) const {
    for (int j = layout_.geometry.count - 1; j >= 0; --j)
        if (badgeAt(j).expanded(3.0f).contains(p)) return j;
    return -1;
}

void WorldView::mouseMove(const juce::MouseEvent& e) {
    const bool canGrip = (onMove && enchanterAt(e.position) >= 0) || (onPull && bodyAt(e.position) >= 0);
    setMouseCursor(canGrip ? juce::MouseCursor::DraggingHandCursor : juce::MouseCursor::NormalCursor);
}

void WorldView::mouseDown(const juce::MouseEvent& e) {
    grip_ = {onSelect || onMove ? enchanterAt(e.position) : -1, -1, e.position, e.position};
    const int body = grip_.enchanter < 0 ? bodyAt(e.position) : -1;
    if (e.mods.isPopupMenu()) {
        grip_ = {};
        if (onMenu) onMenu(e.position);
        return;
    }
    if (onPull) grip_.body = body;
    if (onSelect) onSelect(grip_.enchanter);
    if (!onHold || body < 0 || !e.mods.isShiftDown()) return;
    grip_.held = cast_[static_cast<std::size_t>(body)].name;
    grip_.point = pointOf(grip_);
    hold();
}

void WorldView::hold() {
    const auto share = map().shareAt(grip_.to);
    onHold(grip_.held, grip_.point, {share.x * scene_.fieldWidthMetres, share.y * scene_.fieldHeightMetres});
}

void WorldView::mouseDrag(const juce::MouseEvent& e) {
    grip_.to = e.position;
    grip_.isOutside = !getLocalBounds().toFloat().contains(e.position);
    if (grip_.enchanter >= 0 && onMove && !grip_.isOutside && isDrag(e))
        onMove(grip_.enchanter, map().shareAt(e.position));
    if (isHolding()) hold();
    if (grip_.body >= 0) repaint();
}

void WorldView::mouseUp(const juce::MouseEvent& e) {
    const Grip grip = std::exchange(grip_, {});
    repaint();
    if (!grip.held.empty()) return onLetGo(grip.held);
    if (grip.enchanter >= 0 && grip.isOutside && onDetach) return onDetach(grip.enchanter);
    if (onSpot && grip.enchanter < 0 && !e.mods.isPopupMenu() && !isDrag(e) &&
        map().field.contains(e.position))
        return onSpot(map().shareAt(e.position));
    if (grip.body < 0 || !onPull || !isDrag(e)) return;
    const auto way = (e.position - grip.from).toDouble() / screenPixelsPerMetre(*this, displayWidthMetres_);
    onPull(cast_[static_cast<std::size_t>(grip.body)].name, {way.x, -way.y}, pointOf(grip));
}

// The point in the body's own, rotated coordinates.
Vector WorldView::pointOf(const Grip& grip) const {
    const auto at = map();
    const auto pose = poseOf(static_cast<std::size_t>(grip.body));
    const auto start = (grip.from - at.at(pose.xMetres, pose.yMetres)) / at.pixelsPerMetre;
    const double c = std::cos(pose.angleRadians), s = std::sin(pose.angleRadians);
    return {c * start.x - s * start.y, -s * start.x - c * start.y};
}

bool WorldView::isInterestedInDragSource(const SourceDetails& details) {
    return onAttach && details.description == newEnchanter;
}

void WorldView::itemDragMove(const SourceDetails& details) {
    dropAt_ = details.localPosition.toFloat();
    repaint();
}

void WorldView::itemDragExit(const SourceDetails&) {
    dropAt_.reset();
    repaint();
}

void WorldView::itemDropped(const SourceDetails& details) {
    dropAt_.reset();
    onAttach(map().shareAt(details.localPosition.toFloat()));
}

void WorldView::fileDragMove(const juce::StringArray&, int x, int y) {
    filesAt_ = juce::Point<int>{x, y}.toFloat();
    repaint();
}

void WorldView::fileDragExit(const juce::StringArray&) {
    filesAt_.reset();
    repaint();
}

void WorldView::filesDropped(const juce::StringArray& files, int x, int y) {
    fileDragExit(files);
    const auto at = juce::Point<int>{x, y}.toFloat();
    onFiles(files, enchanterAt(at), map().shareAt(at));
}

} // namespace physvib
