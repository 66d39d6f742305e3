// SPDX-License-Identifier: GPL-3.0-or-later
// Draws joints, the selection with its handles, and the shape being drawn.
#include "Mixer/World/DrawPane.h"
#include "Pictures/ShapeOutline.h"
#include <cmath>

namespace physvib {

namespace {

/// A line with turns between straight ends.
juce::Path coil(juce::Point<float> from, juce::Point<float> to, float wide, int turns) {
    const auto along = to - from;
    const float length = std::max(1e-3f, from.getDistanceFrom(to));
    const juce::Point<float> across{-along.y * wide / length, along.x * wide / length};
    juce::Path path;
    path.startNewSubPath(from);
    for (int k = 0; k < 2 * turns; ++k)
        path.lineTo(from +
                    along *
                        (0.15f + 0.7f * (static_cast<float>(k) + 0.5f) / (2.0f * static_cast<float>(turns))) +
                    across * (k % 2 == 0 ? 1.0f : -1.0f));
    path.lineTo(to);
    return path;
}

} // namespace

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
        line = coil({-9.0f, 0.0f}, {9.0f, 0.0f}, 6.0f, 3);
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

// Rotates and moves the anchor with the body from its drawn to its current pose.
Vector DrawPane::anchorNow(const JointDescription&, const Vector& anchor, const std::string& name) const {
    const auto* body = desk_.world().drawing().find(name);
    const auto place = placeNow(name);
    if (body == nullptr || !place) return anchor;
    const double turned = place->angleRadians - body->angleRadians, c = std::cos(turned),
                 s = std::sin(turned);
    const double x = anchor.x - body->positionMetres.x, y = anchor.y - body->positionMetres.y;
    return {place->metres.x + c * x - s * y, place->metres.y + s * x + c * y};
}

std::string DrawPane::jointAt(juce::Point<float> place) const {
    constexpr float near = 8.0f;
    for (const auto& joint : desk_.world().drawing().drawn().joints) {
        const bool isNear = std::visit(
            [&](const auto& kind) {
                if constexpr (requires { kind.anchorMetres; })
                    return view_.placeOfMetres(anchorNow(joint, kind.anchorMetres, joint.bodyA))
                               .getDistanceFrom(place) < near;
                else {
                    juce::Point<float> on;
                    const juce::Line<float> rope{
                        view_.placeOfMetres(anchorNow(joint, kind.anchorAMetres, joint.bodyA)),
                        view_.placeOfMetres(anchorNow(joint, kind.anchorBMetres, joint.bodyB))};
                    return rope.getDistanceFromPoint(place, on) < near;
                }
            },
            joint.joint);
        if (isNear) return joint.name;
    }
    return {};
}

void DrawPane::drawJoints(juce::Graphics& g) const {
    for (const auto& joint : desk_.world().drawing().drawn().joints) {
        if (!placeNow(joint.bodyA) || !placeNow(joint.bodyB)) continue;
        g.setColour(shade(*this, Shade::text).withAlpha(tool_ == DrawTool::hand ? 0.45f : 0.9f));
        const auto dot = [&](juce::Point<float> at, float radius) {
            g.fillEllipse(juce::Rectangle<float>{2.0f * radius, 2.0f * radius}.withCentre(at));
        };
        std::visit(
            [&](const auto& kind) {
                if constexpr (requires { kind.anchorMetres; }) {
                    const auto at = view_.placeOfMetres(anchorNow(joint, kind.anchorMetres, joint.bodyA));
                    dot(at, 3.0f);
                    if constexpr (requires { kind.maxForceNewtons; }) {
                        const double length = kind.travelMetres ? kind.travelMetres->upper : 0.0,
                                     size = std::hypot(kind.axis.x, kind.axis.y);
                        const Vector end{kind.anchorMetres.x + length * kind.axis.x / size,
                                         kind.anchorMetres.y + length * kind.axis.y / size};
                        g.drawLine({at, view_.placeOfMetres(anchorNow(joint, end, joint.bodyA))}, 1.5f);
                    } else
                        g.drawEllipse(juce::Rectangle<float>{12.0f, 12.0f}.withCentre(at), 1.4f);
                    if constexpr (requires { kind.maxTorqueNewtonMetres; })
                        if (kind.maxTorqueNewtonMetres > 0.0)
                            g.drawEllipse(juce::Rectangle<float>{17.0f, 17.0f}.withCentre(at), 1.4f);
                } else {
                    const auto a = view_.placeOfMetres(anchorNow(joint, kind.anchorAMetres, joint.bodyA)),
                               b = view_.placeOfMetres(anchorNow(joint, kind.anchorBMetres, joint.bodyB));
                    if (springHzOf(joint) > 0.0)
                        g.strokePath(coil(a, b, 6.0f, 6), juce::PathStrokeType{1.8f});
                    else
                        g.drawLine({a, b}, 1.8f);
                    dot(a, 3.0f);
                    dot(b, 3.0f);
                }
            },
            joint.joint);
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
    if (tool_ == DrawTool::spring) return g.strokePath(coil(from, to, 6.0f, 6), juce::PathStrokeType{2.0f});
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
