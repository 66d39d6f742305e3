// SPDX-License-Identifier: MIT
// Draws the world panel: field, bodies, impacts as light, actuators.
#include "Pictures/PictureParts.h"
#include "Pictures/ShapeOutline.h"
#include "Scene/World/BodyLists.h"

namespace physvib::picture {

FieldMap fittedFieldMap(const PictureInput& input, Area room) {
    const double width = std::max(input.fieldWidthMetres, 1e-9),
                 height = std::max(input.fieldHeightMetres, 1e-9);
    const double scale = std::min(room.width / width, room.height / height);
    const auto w = static_cast<float>(width * scale), h = static_cast<float>(height * scale);
    return {room.toFloat().withSizeKeepingCentre(std::max(w, 1.0f), std::max(h, 1.0f)), scale};
}

Point project(const PictureInput& input, const FieldMap& map, double x, double y, double z) {
    constexpr double obliqueFactor = 0.35;
    const double obliqueShift = isFlat(input.layout) ? 0.0 : obliqueFactor * z;
    return map.pointAt(x - obliqueShift, y - obliqueShift);
}

Point channelPoint(const PictureInput& input, const FieldMap& map, int channel) {
    const auto& place = input.layout.places[static_cast<std::size_t>(channel)];
    const auto share = [](double part, double whole) { return whole > 0.0 ? part / whole : 0.5; };
    return project(input, map, share(place.xMetres, input.layout.extentWidthMetres) * input.fieldWidthMetres,
                   share(place.yMetres, input.layout.extentHeightMetres) * input.fieldHeightMetres,
                   share(place.zMetres, input.layout.extentWidthMetres) * input.fieldWidthMetres);
}

namespace {

// Bodies outside the field, usually walls, are visible in a frame of at most this width around it.
constexpr float wallPixels = 12.0f;

// Strokes a chain, which is a line, and fills all other shapes.
void drawFixture(const Canvas& canvas, const FixtureDescription& fixture, Colour colour,
                 const Transform& body, const FieldMap& map) {
    const auto transform =
        Transform::rotation(static_cast<float>(-fixture.angleRadians))
            .translated(map.pixels(fixture.offsetMetres.x), -map.pixels(fixture.offsetMetres.y))
            .followedBy(body);
    const auto outline = shapeOutline<Path>(fixture.shape, map.pixelsPerMetre);
    const bool isLine = std::holds_alternative<ChainShape>(fixture.shape);
    canvas.graphics.setColour(colour);
    isLine ? canvas.graphics.strokePath(outline, 3.0f, transform)
           : canvas.graphics.fillPath(outline, transform);
    if (const auto* circle = std::get_if<CircleShape>(&fixture.shape)) {
        // a spoke shows the rotation
        canvas.graphics.setColour(palette::well.withAlpha(0.5f));
        canvas.graphics.strokePath(Path{}.startNewSubPath({}).lineTo(map.pixels(circle->radiusMetres), 0.0f),
                                   1.5f, transform);
    }
    if (!fixture.isCamera) return;
    canvas.graphics.setColour(palette::camera);
    canvas.graphics.strokePath(outline, isLine ? 1.0f : 2.0f, transform);
}

void drawBody(const Canvas& canvas, const Scene& scene, const BodyDescription& body, const BodyPose& pose,
              const FieldMap& map) {
    const float brightness = body.type == BodyType::dynamicBody ? 0.9f : 0.6f;
    const auto transform = Transform::rotation(static_cast<float>(-pose.angleRadians))
                               .translated(map.pointAt(pose.xMetres, pose.yMetres));
    for (const auto& fixture : body.fixtures)
        drawFixture(
            canvas, fixture,
            palette::materialOf(scene.materials, fixture.material).withMultipliedBrightness(brightness),
            transform, map);
}

void drawJoint(const Canvas& canvas, const JointPose& joint, const FieldMap& map) {
    canvas.graphics.setColour(palette::text.withAlpha(0.6f));
    canvas.graphics.strokePath(jointOutline<Path>(joint.joint, map.pointAt(joint.aMetres.x, joint.aMetres.y),
                                                  map.pointAt(joint.bMetres.x, joint.bMetres.y)),
                               jointPixels);
}

} // namespace

void drawBodies(const Canvas& canvas, const PictureInput& input, const FieldMap& map) {
    if (input.scene == nullptr) return;
    const Painter::ClipScope clipScope(canvas.graphics);
    canvas.graphics.reduceClip(map.field.expanded(wallPixels).rounded());
    const auto bodies = allBodies(*input.scene);
    const auto& poses = input.poses.bodies;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const auto& position = bodies[i].positionMetres;
        const BodyPose start{position.x, position.y, bodies[i].angleRadians, i < input.scene->bodies.size()};
        const BodyPose& pose = i < poses.size() ? poses[i] : start;
        if (pose.isPresent) drawBody(canvas, *input.scene, bodies[i], pose, map);
    }
    for (const JointPose& joint : input.poses.joints) drawJoint(canvas, joint, map);
    if (poses.empty())
        for (const auto& joint : input.scene->joints) drawJoint(canvas, jointPose(joint), map);
}

namespace {

void drawGlows(const Canvas& canvas, const PictureInput& input, const HitColours& colours,
               const FieldMap& map, Area clipArea) {
    const auto* const strongest = strongestEvent(input.events);
    if (!strongest) return;
    const double loudestDb = decibels(strongest->amplitude);
    Light hits(clipArea), traces(clipArea); // apart, because thousands of grains would outshine a hit
    for (const auto& event : input.events) {
        const auto level = static_cast<float>(1.0 + (decibels(event.amplitude) - loudestDb) / 40.0);
        if (level <= 0.0f) continue;
        const auto point = project(input, map, event.x, event.y, event.z);
        if (isHit(event))
            hits.add(point, 5.0f + 33.0f * level * level, 0.05f + 0.9f * level * level,
                     colours.colourOf(event));
        else
            traces.add(point, 4.0f + 4.0f * level, 0.2f + 0.75f * level,
                       colours.colourOf(event)); // together they form a line
    }
    traces.draw(canvas.graphics);
    hits.draw(canvas.graphics);
}

/// A channel's level in the strongest hit; the loudest channel has 1. 0 if the picture has no sound.
float relativeLevel(const PictureInput& input, int channel) {
    const bool hasSound =
        input.zoom != nullptr && channel < input.zoom->channels() && input.zoom->peak() > 0.0f;
    return hasSound ? input.zoom->peak(channel) / input.zoom->peak() : 0.0f;
}

void drawHalos(const Canvas& canvas, const PictureInput& input, const FieldMap& map) {
    for (int c = 0; c < input.layout.count; ++c) {
        const auto centre = channelPoint(input, map, c);
        const float share = relativeLevel(input, c) * relativeLevel(input, c), radius = 20.0f + 60.0f * share;
        const auto colour = palette::actuator(c);
        canvas.graphics.setGradient(
            {centre, radius, colour.withAlpha(0.45f * share), colour.withAlpha(0.0f)});
        canvas.graphics.fillEllipse(boxAround(centre, 2.0f * radius, 2.0f * radius));
    }
}

// Rings where a hit struck, and a line to each actuator, as wide and bright as the level that it plays.
void drawStrongest(const Canvas& canvas, const PictureInput& input, const FieldMap& map,
                   const CollisionEvent& hit) {
    const auto centre = project(input, map, hit.x, hit.y, hit.z);
    for (int c = 0; c < input.layout.count; ++c) {
        const float share = relativeLevel(input, c);
        if (share <= 0.0f) continue;
        canvas.graphics.setColour(palette::actuator(c).withAlpha(0.65f * share));
        canvas.graphics.drawLine(centre, channelPoint(input, map, c), 0.8f + 2.2f * share);
    }
    for (int ring = 1; ring <= 3; ++ring) {
        const auto r = 9.0f * static_cast<float>(ring);
        canvas.graphics.setColour(palette::highlight.withAlpha(1.0f - 0.27f * static_cast<float>(ring)));
        canvas.graphics.drawEllipse(boxAround(centre, 2.0f * r, 2.0f * r), 1.6f);
    }
    canvas.graphics.setColour(palette::white);
    canvas.graphics.fillEllipse(boxAround(centre, 8.0f, 8.0f));
}

std::string describeStrongest(const CollisionEvent& hit) {
    return (isHit(hit) ? "Strongest hit at " : "Strongest grain at ") +
           number(static_cast<double>(hit.timeNs) * 1e-9, 3) + " s: " + shortNumber(hit.frequencyHz) +
           " Hz, " + "\xcf\x84" + " " + shortNumber(hit.decayPerSecond) + " /s, " +
           decibelText(hit.amplitude) + ", at (" + number(hit.x, 2) + ", " + number(hit.y, 2) + ") m";
}

// "wall right, struck by ball 3", as far as the event and the scene know.
std::string describeBodies(const PictureInput& input, const CollisionEvent& hit) {
    const auto bodies = input.scene != nullptr ? allBodies(*input.scene) : std::vector<BodyDescription>{};
    const auto name = [&](std::int32_t fixture) {
        const auto body = bodyOfFixture(bodies, fixture);
        return body < bodies.size() ? cleanLine(bodies[body].name) : std::string();
    };
    const auto feltBody = name(hit.source.fixture), otherBody = name(hit.source.other);
    const auto verb = isHit(hit)                             ? ", struck by "
                      : hit.source.kind == ContactKind::roll ? ", rolled over by "
                                                             : ", slid over by ";
    return feltBody.empty() || otherBody.empty() ? feltBody : feltBody + verb + otherBody;
}

float closestPairPixels(const PictureInput& input, const FieldMap& map) {
    float closest = 400.0f; // pixels; also for a single actuator
    for (int a = 0; a < input.layout.count; ++a)
        for (int b = a + 1; b < input.layout.count; ++b)
            closest = std::min(closest, channelPoint(input, map, a).distanceTo(channelPoint(input, map, b)));
    return closest;
}

void drawBadge(const Canvas& canvas, std::string_view label, Box badge, Colour colour) {
    canvas.graphics.setColour(palette::well);
    canvas.graphics.fillRounded(badge, 6.0f);
    canvas.graphics.setColour(colour);
    canvas.graphics.drawRounded(badge, 6.0f, 2.0f);
    canvas.text(label, badge.rounded(), Align::centre, colour, smallText, true);
}

} // namespace

// Badges are as large as the closest pair allows; without room for labels they are dots.
void drawActuators(const Canvas& canvas, const PictureInput& input, const FieldMap& map, Area panel) {
    const float closest = closestPairPixels(input, map), size = std::clamp(0.8f * closest, 7.0f, 32.0f);
    for (int c = 0; c < input.layout.count; ++c) {
        const auto centre = channelPoint(input, map, c);
        const auto label = actuatorLabel(input, c);
        const float width =
            std::max(size, static_cast<float>(canvas.textWidth(label, smallText, true)) + 14.0f);
        if (size >= 21.0f && width <= std::max(size, 0.8f * closest)) {
            const auto within = panel.reduced(6).toFloat();
            drawBadge(canvas, label, boxAround(centre, width, size).constrainedWithin(within),
                      palette::actuator(c));
        } else {
            canvas.graphics.setColour(palette::actuator(c));
            canvas.graphics.fillEllipse(boxAround(centre, 0.7f * size, 0.7f * size));
        }
    }
}

void drawWorld(const Canvas& canvas, const PictureInput& input, const HitColours& colours, Area panel) {
    canvas.panel(panel);
    const Area clipArea = panel;
    panel = panel.reduced(20, 12);
    const auto heading = panel.removeFromTop(24), second = panel.removeFromBottom(20),
               first = panel.removeFromBottom(26);
    const auto map = fittedFieldMap(input, panel.reduced(22, 22));
    const auto* const strongest = strongestEvent(input.events);
    {
        const Painter::ClipScope clipScope(canvas.graphics);
        canvas.graphics.reduceClip(clipArea);
        canvas.well(map.field.rounded());
        canvas.graphics.setColour(palette::line);
        canvas.graphics.drawRounded(map.field, 3.0f, 1.0f);
        drawHalos(canvas, input, map);
        drawBodies(canvas, input, map);
        drawGlows(canvas, input, colours, map, clipArea);
        if (strongest) drawStrongest(canvas, input, map, *strongest);
        drawActuators(canvas, input, map, clipArea);
    }
    auto remark =
        shortNumber(input.fieldWidthMetres) + " \xc3\x97 " + shortNumber(input.fieldHeightMetres) + " m";
    if (input.scene != nullptr && strongest) remark += ", bodies as at the strongest hit";
    canvas.heading("WORLD", remark, heading);
    if (!strongest) return canvas.text("Nothing was struck.", first, Align::left, palette::muted, mediumText);
    canvas.text(describeStrongest(*strongest), first, Align::left, palette::highlight, mediumText);
    canvas.text(describeBodies(input, *strongest), second, Align::left, palette::muted);
}

} // namespace physvib::picture
