// SPDX-License-Identifier: GPL-3.0-or-later
// Draws joints, the selection with its handles, and the shape being drawn.
#include "Mixer/World/DrawPane.h"
#include "Pictures/JointOutline.h"
#include "Pictures/ShapeOutline.h"
#include <cmath>

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

// Rotates and moves the point with the body from its drawn to its current pose.
Vector DrawPane::carried(const Vector& point, const std::string& name) const {
    const auto* body = desk_.world().drawing().find(name);
    const auto place = placeNow(name);
    if (body == nullptr || !place) return point;
    const double turned = place->angleRadians - body->angleRadians, c = std::cos(turned),
                 s = std::sin(turned);
    const double x = point.x - body->positionMetres.x, y = point.y - body->positionMetres.y;
    return {place->metres.x + c * x - s * y, place->metres.y + s * x + c * y};
}

juce::Line<float> DrawPane::lineNow(const JointDescription& joint) const {
    const auto pose = describedPose(joint);
    const bool isBetween = std::holds_alternative<DistanceJoint>(joint.joint);
    return {view_.placeOfMetres(carried(pose.aMetres, joint.bodyA)),
            view_.placeOfMetres(carried(pose.bMetres, isBetween ? joint.bodyB : joint.bodyA))};
}

std::string DrawPane::jointAt(juce::Point<float> place) const {
    constexpr float near = 8.0f;
    for (const auto& joint : desk_.world().drawing().drawn().joints) {
        juce::Point<float> on;
        if (lineNow(joint).getDistanceFromPoint(place, on) < near) return joint.name;
    }
    return {};
}

void DrawPane::drawJoints(juce::Graphics& g) const {
    g.setColour(shade(*this, Shade::text).withAlpha(tool_ == DrawTool::hand ? 0.45f : 0.9f));
    for (const auto& joint : desk_.world().drawing().drawn().joints) {
        if (!placeNow(joint.bodyA) || !placeNow(joint.bodyB)) continue;
        const auto line = lineNow(joint);
        g.strokePath(jointOutline<juce::Path>(joint.joint, line.getStart(), line.getEnd()),
                     juce::PathStrokeType{jointPixels});
    }
}

void DrawPane::drawOutline(juce::Graphics& g, const BodyDescription& body, const BodyPlace& place,
                           juce::Colour colour, bool isFilled) const {
    const float scale = view_.pixelsPerMetre();
    for (const auto& fixture : body.fixtures) {
        const auto where =
            juce::AffineTransform::rotation(static_cast<float>(-fixture.angleRadians))
                .translated(static_cast<float>(fixture.offsetMetres.x) * scale,
                            static_cast<float>(-fixture.offsetMetres.y) * scale)
                .followedBy(juce::AffineTransform::rotation(static_cast<float>(-place.angleRadians)))
                .translated(view_.placeOfMetres(place.metres));
        const auto path = shapeOutline<juce::Path>(fixture.shape, scale);
        g.setColour(colour.withAlpha(0.3f));
        if (isFilled && !std::holds_alternative<ChainShape>(fixture.shape)) g.fillPath(path, where);
        g.setColour(colour);
        g.strokePath(path, juce::PathStrokeType{1.8f}, where);
    }
}

void DrawPane::drawChosen(juce::Graphics& g) const {
    const auto accent = shade(*this, Shade::accent);
    const bool goes = isDrawing_ && (grip_ == Grip::move || grip_ == Grip::turn);
    const auto moved = goes ? movedNow() : std::map<std::string, BodyPlace>{};
    for (const std::string& name : chosen_) {
        const auto* body = desk_.world().drawing().find(name);
        const auto place = placeNow(name);
        if (body == nullptr || !place) continue;
        drawOutline(g, *body, *place, accent, false);
        if (const auto next = moved.find(name); next != moved.end())
            drawOutline(g, *body, next->second, accent, true);
    }
    if (isDrawing_ && grip_ == Grip::size && chosen_.size() == 1)
        if (const auto place = placeNow(chosen_[0])) drawOutline(g, sizedNow(), *place, accent, true);
    const auto marks = handles();
    if (!marks || tool_ != DrawTool::choose) return;
    const auto handle = [&](juce::Point<float> at, bool isRound) {
        const auto area = juce::Rectangle<float>{10.0f, 10.0f}.withCentre(at);
        g.setColour(shade(*this, Shade::well));
        isRound ? g.fillEllipse(area) : g.fillRect(area);
        g.setColour(accent);
        isRound ? g.drawEllipse(area, 1.8f) : g.drawRect(area, 1.8f);
    };
    for (const auto& corner : marks->corners) handle(corner, false);
    handle(marks->turn, true);
}

void DrawPane::drawStroke(juce::Graphics& g) const {
    if (!isDrawing_ || stroke_.empty()) return;
    const auto accent = shade(*this, Shade::accent);
    const auto from = view_.placeOfMetres(stroke_[0]), to = view_.placeOfMetres(to_);
    g.setColour(accent);
    if (tool_ == DrawTool::choose)
        return grip_ == Grip::around ? g.drawRect(juce::Rectangle<float>{from, to}, 1.2f) : void();
    if (tool_ == DrawTool::polygon || tool_ == DrawTool::line) {
        juce::Path path;
        path.startNewSubPath(from);
        for (const Vector& place : stroke_) path.lineTo(view_.placeOfMetres(place));
        path.lineTo(to);
        return g.strokePath(path, juce::PathStrokeType{2.0f});
    }
    if (tool_ == DrawTool::spring)
        return g.strokePath(coilOutline<juce::Path>(from, to, 6.0f, 6), juce::PathStrokeType{2.0f});
    if (tool_ == DrawTool::rope || tool_ == DrawTool::slider) return g.drawLine({from, to}, 2.0f);
    if (tool_ == DrawTool::rain) {
        if (const auto bodies = rainNow())
            for (const auto& body : bodies.value)
                drawOutline(g, body, {body.positionMetres, 0.0}, accent, true);
        return;
    }
    if (const auto body = drawnNow())
        drawOutline(g, body.value, {body.value.positionMetres, body.value.angleRadians}, accent, true);
}

void DrawPane::paint(juce::Graphics& g) {
    drawJoints(g);
    if (tool_ == DrawTool::hand) return;
    drawChosen(g);
    drawStroke(g);
}

} // namespace physvib
