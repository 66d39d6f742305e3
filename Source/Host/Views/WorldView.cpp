// SPDX-License-Identifier: GPL-3.0-or-later
// Draws the world fast enough for a software renderer: only plain paths and gradients, no blur.
#include "Host/Views/WorldView.h"
#include "Pictures/ShapeOutline.h"
#include "Scene/World/BodyLists.h"
#include <algorithm>
#include <cmath>
#include <juce_audio_basics/juce_audio_basics.h>
#include <tuple>

namespace physvib {
namespace {

constexpr double hitMs = 450.0;              // how long a hit glows
constexpr std::size_t maxHits = 48;          // glowing at the same time; more would only glare
constexpr std::size_t maxTraces = 400;       // enough for 30 sliding pairs
constexpr double minShownGain = 0.02;        // an actuator with a smaller gain counts as silent
constexpr float wallPixels = 11.0f;          // bodies around the field are drawn as a frame of this width
constexpr float minMediumTextHeight = 24.0f; // lower badges have small text
constexpr float minSpokePixels = 4.0f;       // radius of a circle whose rotation is seen
constexpr std::size_t quickDrawBodies = 200; // with more bodies, small circles are drawn from cached pictures

float glowLevel(double amplitude) {
    return juce::jlimit(
        0.12f, 1.0f,
        1.0f + static_cast<float>(juce::Decibels::gainToDecibels(std::abs(amplitude), -50.0)) / 50.0f);
}

bool isSame(const std::vector<BodyPose>& a, const std::vector<BodyPose>& b) {
    return std::ranges::equal(a, b, [](const BodyPose& p, const BodyPose& q) {
        return p.xMetres == q.xMetres && p.yMetres == q.yMetres && p.angleRadians == q.angleRadians &&
               p.isPresent == q.isPresent;
    });
}

/// Gain of an actuator at each place of the field, as opacity of the colour.
juce::Image gainImage(const PhantomPanner& panner, int actuator, juce::Colour colour, int width, int height) {
    juce::Image image{juce::Image::ARGB, std::max(1, width), std::max(1, height), true};
    PhantomPanner::Gains gains{};
    juce::Image::BitmapData pixels{image, juce::Image::BitmapData::writeOnly};
    for (int y = 0; y < image.getHeight(); ++y)
        for (int x = 0; x < image.getWidth(); ++x) {
            panner.gainsAt((x + 0.5) / image.getWidth() * panner.fieldWidthMetres(),
                           (1.0 - (y + 0.5) / image.getHeight()) * panner.fieldHeightMetres(), gains);
            const auto share =
                static_cast<float>(juce::jlimit(0.0, 1.0, gains[static_cast<std::size_t>(actuator)]));
            pixels.setPixelColour(x, y, colour.withAlpha(0.75f * share));
        }
    return image;
}

} // namespace

WorldView::WorldView() {
    setOpaque(true);
    setTitle("World");
    setDescription("Bodies as they are felt now. Drag a body to push it, with Shift to hold it.");
}

void WorldView::show(const Scene& scene) {
    const auto isOfName = [](const BodyDescription& a, const BodyDescription& b) { return a.name == b.name; };
    const bool isNew =
        scene.name != scene_.name || !std::ranges::equal(scene.bodies, scene_.bodies, isOfName);
    scene_ = scene;
    bodies_ = allBodies(scene_);
    firstInputBody_ = scriptedBodies(scene_).size();
    followInputs();
    if (isNew) {
        pendingPoses_.clear();
        hits_.clear();
        traces_.clear();
        grip_.body = -1; // the index may now denote another body
        if (std::ranges::find(bodies_, grip_.held, &BodyDescription::name) == bodies_.end())
            grip_.held.clear();
    }
    repaint();
}

void WorldView::show(const LayoutDescription& layout, const PhantomPanner& panner, std::vector<bool> muted,
                     std::vector<bool> withoutOutput) {
    if (layout.actuators != layout_.actuators) grip_.actuator = -1; // the index may now denote another one
    layout_ = layout;
    panner_ = panner;
    muted_ = std::move(muted);
    withoutOutput_ = std::move(withoutOutput);
    gainMap_ = {};
    badges_.clear();
    repaint();
}

void WorldView::showGainMap(int actuator) {
    if (actuator == gainMapActuator_) return;
    gainMapActuator_ = actuator;
    gainMap_ = {};
    repaint();
}

void WorldView::update(WorldFrame moment) {
    if (!pendingPoses_.empty() && moment.sessionNs < pendingPoses_.back().timeNs)
        pendingPoses_.clear(); // a new scene run
    const auto before = pendingPoses_.empty() ? std::vector<BodyPose>{} : pendingPoses_.front().poses;
    if (!moment.poses.empty()) pendingPoses_.push_back({moment.sessionNs, std::move(moment.poses)});
    while (pendingPoses_.size() > 1 && pendingPoses_[1].timeNs + moment.aheadNs <= moment.sessionNs)
        pendingPoses_.pop_front();
    bool hasChanged = !hits_.empty() || !traces_.empty() || !moment.hits.empty() ||
                      (!pendingPoses_.empty() && !isSame(before, pendingPoses_.front().poses));
    const double now = nowMs_ = moment.nowMs;
    for (const auto& event : moment.hits) addContact(event, now, moment.isFelt);
    while (!hits_.empty() && (hits_.size() > maxHits || now - hits_.front().shownAtMs > hitMs))
        hits_.pop_front();
    while (!traces_.empty() && (traces_.size() > maxTraces || now - traces_.front().shownAtMs > hitMs))
        traces_.pop_front();
    for (std::size_t j = 0; j < std::min(moment.peaks.size(), peaks_.size()); ++j) {
        hasChanged = hasChanged || std::abs(std::sqrt(peaks_[j]) - std::sqrt(moment.peaks[j])) > 0.01f;
        if (hasChanged) peaks_[j] = moment.peaks[j];
    }
    if (hasChanged) repaint();
}

juce::Colour WorldView::eventColour(const CollisionEvent& event) const {
    for (std::size_t i = 0; i < scene_.materials.size(); ++i)
        if (scene_.materials[i].frequencyHz == event.frequencyHz &&
            scene_.materials[i].decayPerSecond == event.decayPerSecond)
            return palette::material(scene_.materials, static_cast<int>(i));
    return palette::grey;
}

juce::Rectangle<float> WorldView::fieldArea() const {
    return padding_.subtractedFrom(getLocalBounds()).reduced(margin_, std::max(0, margin_ - 6)).toFloat();
}

float WorldView::fittingPixelsPerMetre() const {
    const auto room = fieldArea();
    return std::min(room.getWidth() / static_cast<float>(std::max(scene_.fieldWidthMetres, 1e-6)),
                    room.getHeight() / static_cast<float>(std::max(scene_.fieldHeightMetres, 1e-6)));
}

WorldView::FieldTransform WorldView::map() const {
    const auto room = fieldArea();
    const auto width = static_cast<float>(std::max(scene_.fieldWidthMetres, 1e-6)),
               height = static_cast<float>(std::max(scene_.fieldHeightMetres, 1e-6));
    const float scale =
        worldScale_ > 0.0 ? static_cast<float>(screenPixelsPerMetre(*this, displayWidthMetres_) / worldScale_)
                          : fittingPixelsPerMetre();
    return {room.withSizeKeepingCentre(width * scale, height * scale), scale};
}

// Inputs that remove or replace bodies; bodies that the script spawns may appear again.
void WorldView::followInputs() {
    bodyStates_.assign(bodies_.size(), {});
    std::size_t next = firstInputBody_;
    for (const LiveInput& input : scene_.inputs) {
        const BodyDescription* added = bodyAddedBy(input.action);
        const auto* removal = std::get_if<RemoveAction>(&input.action);
        if (added == nullptr && removal == nullptr) continue;
        const std::string& name = added ? added->name : removal->body;
        for (std::size_t i = next; i-- > 0;)
            if (bodies_[i].name == name) {
                const auto* change = std::get_if<ChangeAction>(&input.action);
                if (change != nullptr && change->stays && !bodyStates_[i].isGone)
                    bodyStates_[next].replaced = static_cast<int>(i);
                if (i < scene_.bodies.size() || i >= firstInputBody_) bodyStates_[i].isGone = true;
                break;
            }
        if (added != nullptr) ++next;
    }
}

// The pose in the world, or the start pose of a body that has not appeared yet.
BodyPose WorldView::worldPose(std::size_t body) const {
    if (!pendingPoses_.empty() && body < pendingPoses_.front().poses.size())
        return pendingPoses_.front().poses[body];
    if (const int before = bodyStates_[body].replaced; before >= 0)
        if (const BodyPose pose = worldPose(static_cast<std::size_t>(before)); pose.isPresent) return pose;
    const auto& b = bodies_[body];
    return {b.positionMetres.x, b.positionMetres.y, b.angleRadians,
            body < scene_.bodies.size() || body >= firstInputBody_};
}

BodyPose WorldView::bodyPose(std::size_t body) const {
    BodyPose pose = worldPose(body);
    pose.isPresent = pose.isPresent && !bodyStates_[body].isGone;
    return pose;
}

juce::AffineTransform WorldView::toTransform(const BodyPose& pose, const FieldTransform& view) const {
    return juce::AffineTransform::rotation(static_cast<float>(-pose.angleRadians))
        .translated(view.toPixel(pose.xMetres, pose.yMetres));
}

juce::AffineTransform WorldView::toTransform(const FixtureDescription& fixture, const BodyPose& pose,
                                             const FieldTransform& view) const {
    return juce::AffineTransform::rotation(static_cast<float>(-fixture.angleRadians))
        .translated(static_cast<float>(fixture.offsetMetres.x) * view.pixelsPerMetre,
                    static_cast<float>(-fixture.offsetMetres.y) * view.pixelsPerMetre)
        .followedBy(toTransform(pose, view));
}

juce::Point<float> WorldView::actuatorPixel(int actuator) const {
    const auto& layout = layout_.geometry;
    const auto& place = layout.places[static_cast<std::size_t>(actuator)];
    return map().toPixel(place.xMetres / layout.extentWidthMetres * scene_.fieldWidthMetres,
                         place.yMetres / layout.extentHeightMetres * scene_.fieldHeightMetres);
}

juce::Point<float> WorldView::pixelOfShare(FieldShare place) const {
    return map().toPixel(place.x * scene_.fieldWidthMetres, place.y * scene_.fieldHeightMetres);
}

juce::Point<float> WorldView::pixelOfBody(const std::string& name) const {
    for (std::size_t i = 0; i < bodies_.size(); ++i)
        if (const auto pose = bodyPose(i); bodies_[i].name == name && pose.isPresent)
            return map().toPixel(pose.xMetres, pose.yMetres);
    return {-1e4f, -1e4f};
}

std::optional<BodyPose> WorldView::poseOfBody(const std::string& name) const {
    for (std::size_t i = bodies_.size(); i-- > 0;)
        if (const auto pose = bodyPose(i); bodies_[i].name == name && pose.isPresent) return pose;
    return std::nullopt;
}

Vector WorldView::metresAt(juce::Point<float> place) const {
    const auto view = map();
    return {static_cast<double>((place.x - view.field.getX()) / view.pixelsPerMetre),
            static_cast<double>((view.field.getBottom() - place.y) / view.pixelsPerMetre)};
}

juce::String WorldView::labelFor(int actuator) const {
    return juce::String::fromUTF8(layout_.actuators[static_cast<std::size_t>(actuator)].label.c_str());
}

juce::Font WorldView::badgeFont() const {
    const bool isLow = !badges_.empty() && badges_.front().getHeight() < minMediumTextHeight;
    return text::font(isLow ? text::small : text::medium, juce::Font::bold);
}

const std::vector<juce::Rectangle<float>>& WorldView::badges() const {
    const auto field = map().field;
    const auto count = static_cast<std::size_t>(layout_.geometry.count);
    if (badges_.size() == count && field == badgeField_) return badges_;
    std::vector<juce::Point<float>> places;
    for (int j = 0; j < layout_.geometry.count; ++j) places.push_back(actuatorPixel(j));
    badgeField_ = field;
    badges_.clear();
    for (int pass = 0; pass < 2; ++pass) { // the second with the text that fits the height
        std::vector<float> widths;
        for (int j = 0; j < layout_.geometry.count; ++j)
            widths.push_back(text::width(badgeFont(), labelFor(j)) + 8.0f);
        badges_ = layOutBadges(places, widths, getLocalBounds().reduced(4).toFloat());
    }
    return badges_;
}

void WorldView::paint(juce::Graphics& g) {
    g.setColour(shade(*this, Shade::panel));
    if (getWidth() < 2 * margin_ + 20 || getHeight() < 2 * margin_ + 20) return g.fillAll();
    const auto view = map();
    juce::RectangleList<int> around{getLocalBounds()}; // the field is filled by drawField
    around.subtract(view.field.reduced(1.0f).toNearestInt());
    g.fillRectList(around);
    drawHalos(g);
    drawField(g, view);
    {
        const juce::Graphics::ScopedSaveState savedState{g};
        g.reduceClipRegion(view.field.expanded(wallPixels).toNearestInt());
        drawBodies(g, view);
    }
    drawRays(g, view);
    drawTraces(g, view);
    drawHits(g, view);
    drawSpot(g);
    drawActuators(g);
    drawGrip(g);
    drawFiles(g);
}

void WorldView::drawField(juce::Graphics& g, const FieldTransform& view) {
    g.setColour(shade(*this, Shade::well));
    g.fillRect(view.field);
    if (gainMapActuator_ < 0 || gainMapActuator_ >= layout_.geometry.count || panner_.channels() == 0) return;
    const auto field = view.field.toNearestInt();
    if (gainMap_.isNull()) // smooth enough, and fast enough while an actuator is dragged
        gainMap_ =
            gainImage(panner_, gainMapActuator_, actuatorColour(*this, gainMapActuator_), 96, 54)
                .rescaled(field.getWidth(), field.getHeight(), juce::Graphics::mediumResamplingQuality);
    g.drawImageAt(gainMap_, field.getX(), field.getY());
}

bool WorldView::drawMaterial(juce::Graphics& g, const FixtureDescription& fixture, const juce::Path& path,
                             const juce::AffineTransform& place) const {
    const auto index = static_cast<std::size_t>(fixture.material);
    if (!showsMaterials_ || index >= scene_.materials.size()) return false;
    const auto& material = scene_.materials[index];
    const auto look = findMaterialLook(material.name);
    const bool isHollow = look && isHollowDensity(*look, material.densityKgPerSquareMetre);
    if (const MaterialPicture* const picture = findPicture(pictures_, material.name))
        return fillWithPicture(g, path, place, picture->image, isHollow), true;
    if (look) fillWithMaterial(g, path, place, *look, isHollow);
    return look.has_value();
}

// Draws a small plain circle from a cached picture; false: nothing was drawn.
bool WorldView::drawSmallDisc(juce::Graphics& g, const FixtureDescription& fixture, juce::Colour colour,
                              double angle, const juce::AffineTransform& place, const FieldTransform& view) {
    const auto* circle = std::get_if<CircleShape>(&fixture.shape);
    if (circle == nullptr || showsMaterials_) return false;
    const float r = static_cast<float>(circle->radiusMetres) * view.pixelsPerMetre;
    if (r < minSpokePixels) return false; // drawn larger than it is
    const auto none = juce::Colours::transparentBlack;
    return discs_.draw(g,
                       {r, colour, palette::well.withAlpha(0.45f),
                        fixture.isCamera ? shade(*this, Shade::hapticSource) : none},
                       juce::Point<float>{}.transformedBy(place), static_cast<float>(-angle));
}

void WorldView::drawBodies(juce::Graphics& g, const FieldTransform& view) {
    const juce::Graphics::ScopedSaveState savedState{g};
    const bool areMany = bodies_.size() > quickDrawBodies;
    if (areMany) g.setImageResamplingQuality(juce::Graphics::lowResamplingQuality); // whole pixels
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const auto& body = bodies_[i];
        const BodyPose pose = bodyPose(i);
        if (!pose.isPresent) continue;
        for (const auto& fixture : body.fixtures) {
            const auto place = toTransform(fixture, pose, view);
            const auto colour =
                palette::material(scene_.materials, fixture.material)
                    .withMultipliedBrightness(body.type == BodyType::dynamicBody ? 0.95f : 0.62f);
            if (areMany &&
                drawSmallDisc(g, fixture, colour, pose.angleRadians + fixture.angleRadians, place, view))
                continue;
            const auto path = shapeOutline<juce::Path>(fixture.shape, view.pixelsPerMetre);
            const bool isLine = std::holds_alternative<ChainShape>(fixture.shape);
            g.setColour(colour);
            if (isLine)
                g.strokePath(path, juce::PathStrokeType{3.0f}, place);
            else if (!drawMaterial(g, fixture, path, place))
                g.fillPath(path, place);
            const auto* circle = std::get_if<CircleShape>(&fixture.shape);
            const float r = circle ? static_cast<float>(circle->radiusMetres) * view.pixelsPerMetre : 0.0f;
            if (r >= minSpokePixels) { // shows the rotation
                juce::Path spoke;
                spoke.startNewSubPath(0.0f, 0.0f);
                spoke.lineTo(r * DiscPictures::spokeShare, 0.0f);
                g.setColour(palette::well.withAlpha(0.45f));
                g.strokePath(spoke, juce::PathStrokeType{DiscPictures::spokeWidth}, place);
            }
            if (!fixture.isCamera) continue;
            g.setColour(shade(*this, Shade::hapticSource));
            g.strokePath(path, juce::PathStrokeType{isLine ? 1.0f : DiscPictures::rimWidth}, place);
        }
    }
}

// All grains of one update form one segment of a contact's path, which starts where the last one ended.
void WorldView::addContact(const CollisionEvent& event, double nowMs, bool isFelt) {
    if (isFelt && std::ranges::find(muted_, true) != muted_.end()) { // felt if an unmuted one plays it
        PhantomPanner::Gains gains{};
        panner_.gainsAt(event, gains);
        isFelt = false;
        for (int j = 0; j < panner_.channels(); ++j)
            isFelt = isFelt || (gains[static_cast<std::size_t>(j)] >= minShownGain && !isMuted(j));
    }
    if (event.source.kind == ContactKind::hit)
        return hits_.push_back({event, eventColour(event), nowMs, isFelt});
    const auto isSamePair = [&](const Trace& t) {
        return t.source.fixture == event.source.fixture && t.source.other == event.source.other;
    };
    const auto last = std::find_if(traces_.rbegin(), traces_.rend(), isSamePair);
    const Vector point{event.x, event.y};
    if (last == traces_.rend() || last->shownAtMs != nowMs)
        return traces_.push_back({event.source, last == traces_.rend() ? point : last->toMetres, point,
                                  event.amplitude, eventColour(event), nowMs, isFelt});
    // the middle between the points of a two-point contact
    last->toMetres = {0.5 * (last->toMetres.x + point.x), 0.5 * (last->toMetres.y + point.y)};
    if (std::abs(event.amplitude) > std::abs(last->amplitude)) last->amplitude = event.amplitude;
}

float WorldView::relativeAge(double shownAtMs) const {
    return static_cast<float>(juce::jlimit(0.0, 1.0, (nowMs_ - shownAtMs) / hitMs));
}

// Traces have a white core, as hits have, and cover the outlines that they follow; weak ones remain visible.
void WorldView::drawTraces(juce::Graphics& g, const FieldTransform& view) const {
    for (const auto& trace : traces_) {
        const float level = glowLevel(trace.amplitude),
                    fade = (1.0f - relativeAge(trace.shownAtMs)) * (0.4f + 0.6f * level);
        juce::Path path;
        path.startNewSubPath(view.toPixel(trace.fromMetres.x, trace.fromMetres.y));
        path.lineTo(view.toPixel(trace.toMetres.x, trace.toMetres.y));
        if (!trace.isFelt) {
            g.setColour(shade(*this, Shade::muted).withAlpha(fade));
            g.strokePath(path, juce::PathStrokeType{1.5f});
            continue;
        }
        const auto amber = trace.colour.interpolatedWith(shade(*this, Shade::highlight), 0.7f);
        for (const auto& [colour, pixels, alpha] : {std::tuple{amber, 10.0f + 12.0f * level, 0.22f},
                                                    {amber, 5.0f + 6.0f * level, 0.45f},
                                                    {juce::Colours::white, 1.5f + 1.5f * level, 0.9f}}) {
            g.setColour(colour.withAlpha(alpha * fade));
            g.strokePath(
                path, juce::PathStrokeType{pixels, juce::PathStrokeType::curved, juce::PathStrokeType::butt});
        }
    }
}

void WorldView::drawHits(juce::Graphics& g, const FieldTransform& view) const {
    const auto amber = shade(*this, Shade::highlight);
    const bool isLight = shade(*this, Shade::well).getPerceivedBrightness() > 0.5f; // needs thick lines
    for (const auto& hit : hits_) {
        const float age = relativeAge(hit.shownAtMs), level = glowLevel(hit.event.amplitude),
                    fade = (1.0f - age) * std::sqrt(level);
        const auto centre = view.toPixel(hit.event.x, hit.event.y);
        const float radius = 10.0f + 34.0f * level * (0.5f + 0.5f * age);
        const auto ring = juce::Rectangle<float>{1.5f * radius, 1.5f * radius}.withCentre(centre);
        if (!hit.isFelt) { // only what is felt glows
            g.setColour(shade(*this, Shade::muted).withAlpha(1.0f - age));
            g.drawEllipse(ring, 1.4f);
            continue;
        }
        glows_.draw(g, centre, radius, hit.colour.interpolatedWith(amber, 0.7f).withAlpha(0.85f * fade));
        g.setColour(amber.withAlpha(isLight ? std::sqrt(fade) : 0.8f * fade));
        g.drawEllipse(ring, isLight ? 2.0f : 1.4f);
        g.setColour(juce::Colours::white.withAlpha(fade));
        g.fillEllipse(juce::Rectangle<float>{6.0f, 6.0f}.withCentre(centre));
    }
}

// Lines from the strongest current hit to each actuator; width and brightness show the actuator's gain.
void WorldView::drawRays(juce::Graphics& g, const FieldTransform& view) const {
    const auto light = [this](const Hit& hit) {
        return hit.isFelt ? glowLevel(hit.event.amplitude) * (1.0f - relativeAge(hit.shownAtMs)) : 0.0f;
    };
    const auto strongest = std::ranges::max_element(hits_, {}, light);
    if (strongest == hits_.end() || panner_.channels() == 0) return;
    PhantomPanner::Gains gains{};
    panner_.gainsAt(strongest->event, gains);
    const auto from = view.toPixel(strongest->event.x, strongest->event.y);
    for (int j = 0; j < layout_.geometry.count; ++j) {
        const auto gain = static_cast<float>(gains[static_cast<std::size_t>(j)]);
        if (gains[static_cast<std::size_t>(j)] < minShownGain || isMuted(j)) continue;
        g.setColour(
            actuatorColour(*this, j).withAlpha(std::min(1.0f, 1.3f * std::sqrt(gain) * light(*strongest))));
        g.drawLine({from, badgeAt(j).getCentre()}, 1.0f + 4.0f * gain);
    }
}

void WorldView::drawHalos(juce::Graphics& g) const {
    for (int j = 0; j < layout_.geometry.count; ++j) {
        const float share = std::sqrt(juce::jlimit(0.0f, 1.0f, peaks_[static_cast<std::size_t>(j)]));
        if (share > 0.03f)
            glows_.draw(g, badgeAt(j).getCentre(), 20.0f + 70.0f * share,
                        actuatorColour(*this, j).withAlpha(std::min(0.8f, 0.25f + 0.6f * share)));
    }
}

namespace {
/// The edge of a badge that is connected to nothing.
void drawDashes(juce::Graphics& g, juce::Rectangle<float> badge) {
    constexpr float dashes[]{4.0f, 4.0f};
    juce::Path edge, dashed;
    edge.addRoundedRectangle(badge, 7.0f);
    juce::PathStrokeType{2.0f}.createDashedStroke(dashed, edge, dashes, 2);
    g.fillPath(dashed);
}
} // namespace

void WorldView::drawActuators(juce::Graphics& g) const {
    for (int j = 0; j < layout_.geometry.count; ++j) // lines to the true places of moved badges
        if (const juce::Line<float> leader{actuatorPixel(j), badgeAt(j).getCentre()};
            !badgeAt(j).contains(leader.getStart())) {
            g.setColour(actuatorColour(*this, j));
            g.drawLine(leader, 1.5f);
            g.fillEllipse(juce::Rectangle<float>{7.0f, 7.0f}.withCentre(leader.getStart()));
        }
    for (int j = 0; j < layout_.geometry.count; ++j) {
        const auto colour = isMuted(j) ? shade(*this, Shade::muted) : actuatorColour(*this, j);
        const auto badge = badgeAt(j);
        const float share = std::sqrt(juce::jlimit(0.0f, 1.0f, peaks_[static_cast<std::size_t>(j)]));
        // may extend over the field
        if (share > 0.03f)
            glows_.draw(g, badge.getCentre(), 18.0f + 34.0f * share, colour.withAlpha(0.5f * share));
        g.setColour(shade(*this, Shade::well));
        g.fillRoundedRectangle(badge, 7.0f);
        g.setColour(colour);
        if (j == selected_)
            g.fillRoundedRectangle(badge, 7.0f);
        else if (isWithoutOutput(j))
            drawDashes(g, badge);
        else
            g.drawRoundedRectangle(badge, 7.0f, 2.0f);
        if (j == selected_) g.setColour(shade(*this, Shade::well));
        g.setFont(badgeFont());
        g.drawText(labelFor(j), badge.reduced(3.0f, 0.0f), juce::Justification::centred, true);
        if (!isMuted(j) || isWithoutOutput(j)) continue;
        for (const auto& [corner, other] : {std::pair{badge.getBottomLeft(), badge.getTopRight()},
                                            {badge.getTopRight(), badge.getBottomLeft()}})
            g.drawLine({corner, corner + (other - corner) * 0.3f}, 2.0f); // strikes out the corners
    }
}

void WorldView::drawSpot(juce::Graphics& g) const {
    if (!spot_) return;
    const auto centre = pixelOfShare(*spot_);
    g.setColour(shade(*this, Shade::text));
    g.drawEllipse(juce::Rectangle<float>{16.0f, 16.0f}.withCentre(centre), 1.5f);
    for (const auto& direction : {juce::Point<float>{1.0f, 0.0f}, {-1.0f, 0.0f}, {0.0f, 1.0f}, {0.0f, -1.0f}})
        g.drawLine({centre + direction * 5.0f, centre + direction * 13.0f}, 1.5f);
}

// Highlights the actuator or the place that would play the dropped files, with a label on the field's side.
void WorldView::drawFiles(juce::Graphics& g) const {
    if (!filesAt_) return;
    const auto view = map();
    const int actuator = actuatorAt(*filesAt_);
    const auto target =
        actuator >= 0
            ? badgeAt(actuator).expanded(5.0f)
            : juce::Rectangle<float>{26.0f, 26.0f}.withCentre(pixelOfShare(view.toShare(*filesAt_)));
    const float corner = actuator >= 0 ? 10.0f : 13.0f;
    const auto words = actuator >= 0 ? "felt on " + labelFor(actuator) + " alone" : juce::String{"felt here"};
    const auto font = text::font(text::small);
    const float below = 0.5f * target.getHeight() + 15.0f;
    const auto plate = juce::Rectangle<float>{text::width(font, words) + 14.0f, 20.0f}
                           .withCentre(target.getCentre().translated(
                               0.0f, target.getCentreY() < view.field.getCentreY() ? below : -below))
                           .constrainedWithin(getLocalBounds().reduced(4).toFloat());
    g.setColour(shade(*this, Shade::raised).withAlpha(0.95f));
    g.fillRoundedRectangle(plate, 5.0f);
    g.setColour(shade(*this, Shade::accent).withAlpha(0.25f));
    g.fillRoundedRectangle(target, corner);
    g.setColour(shade(*this, Shade::accent));
    g.drawRoundedRectangle(target, corner, 2.5f);
    g.setFont(font);
    g.drawText(words, plate, juce::Justification::centred, false);
}

// A line from the body to the mouse.
void WorldView::drawHold(juce::Graphics& g) const {
    if (grip_.body < 0) return;
    const auto view = map();
    const auto point =
        juce::Point<float>{static_cast<float>(grip_.point.x), static_cast<float>(-grip_.point.y)} *
        view.pixelsPerMetre;
    const auto start = point.transformedBy(toTransform(bodyPose(static_cast<std::size_t>(grip_.body)), view)),
               hand = pixelOfShare(view.toShare(grip_.end));
    g.setColour(shade(*this, Shade::text));
    g.drawLine({start, hand}, 1.8f);
    g.fillEllipse(juce::Rectangle<float>{7.0f, 7.0f}.withCentre(start));
    g.drawEllipse(juce::Rectangle<float>{18.0f, 18.0f}.withCentre(hand), 1.8f);
}

void WorldView::drawGrip(juce::Graphics& g) const {
    if (dropAt_) {
        const auto badge = juce::Rectangle<float>{maxBadgeHeight, maxBadgeHeight}.withCentre(*dropAt_);
        g.setColour(shade(*this, Shade::accent));
        g.drawRoundedRectangle(badge, 7.0f, 2.0f);
        g.setFont(text::font(text::large));
        g.drawText("+", badge, juce::Justification::centred, false);
    }
    if (isHolding()) return drawHold(g);
    if (grip_.body < 0 || grip_.start.getDistanceFrom(grip_.end) < 3.0f) return;
    juce::Path line, dashed;
    line.startNewSubPath(grip_.start);
    line.lineTo(grip_.end);
    constexpr float dashes[]{6.0f, 5.0f};
    juce::PathStrokeType{1.8f}.createDashedStroke(dashed, line, dashes, 2);
    g.setColour(shade(*this, Shade::text));
    g.fillPath(dashed);
    if (!flingText) return;
    g.setFont(text::font(text::small));
    const auto words = juce::Rectangle<float>{130.0f, 18.0f}
                           .withCentre(grip_.end.translated(0.0f, -16.0f))
                           .constrainedWithin(getLocalBounds().reduced(4).toFloat());
    g.drawText(
        flingText(grip_.start.getDistanceFrom(grip_.end) / screenPixelsPerMetre(*this, displayWidthMetres_)),
        words, juce::Justification::centred, false);
}

namespace {

/// Whether the mouse moved; a long press without movement is no drag, as in JUCE.
bool isDrag(const juce::MouseEvent& e) { return e.source.hasMovedSignificantlySincePressed(); }

} // namespace

bool WorldView::isOn(std::size_t body, juce::Point<float> p) const {
    constexpr float near = 6.0f; // pixels from a line that still hit it
    const auto view = map();
    const auto pose = bodyPose(body);
    if (!pose.isPresent) return false;
    const bool moves = bodies_[body].type == BodyType::dynamicBody;
    return std::ranges::any_of(bodies_[body].fixtures, [&](const FixtureDescription& fixture) {
        auto path = shapeOutline<juce::Path>(fixture.shape, view.pixelsPerMetre);
        path.applyTransform(toTransform(fixture, pose, view));
        if (juce::Point<float> nearest; std::holds_alternative<ChainShape>(fixture.shape))
            return path.getNearestPoint(p, nearest), nearest.getDistanceFrom(p) < near;
        return path.contains(p) ||
               (moves && path.getBounds().withSizeKeepingCentre(16.0f, 16.0f).contains(p));
    });
}

int WorldView::bodyAt(juce::Point<float> p) const {
    for (int i = static_cast<int>(bodies_.size()) - 1; i >= 0; --i) // the topmost
        if (const auto body = static_cast<std::size_t>(i);
            bodies_[body].type == BodyType::dynamicBody && isOn(body, p))
            return i;
    return -1;
}

std::vector<std::string> WorldView::bodiesAt(juce::Point<float> place) const {
    std::vector<std::string> names;
    for (std::size_t i = bodies_.size(); i-- > 0;)
        if (isOn(i, place)) names.push_back(bodies_[i].name);
    return names;
}

WorldView::Target WorldView::targetAt(juce::Point<float> place) const {
    Target target{actuatorAt(place), {}, map().toShare(place)};
    if (target.actuator >= 0) return target;
    const auto under = bodiesAt(place);
    if (!under.empty()) target.body = under.front();
    return target;
}

int WorldView::actuatorAt(juce::Point<float> p) const {
    for (int j = layout_.geometry.count - 1; j >= 0; --j)
        if (badgeAt(j).expanded(3.0f).contains(p)) return j;
    return -1;
}

void WorldView::mouseMove(const juce::MouseEvent& e) {
    const bool canGrip = (onMove && actuatorAt(e.position) >= 0) || (onFling && bodyAt(e.position) >= 0);
    setMouseCursor(canGrip ? juce::MouseCursor::DraggingHandCursor : juce::MouseCursor::NormalCursor);
}

void WorldView::mouseDown(const juce::MouseEvent& e) {
    grip_ = {onSelect || onMove ? actuatorAt(e.position) : -1, -1, e.position, e.position};
    const int body = grip_.actuator < 0 ? bodyAt(e.position) : -1;
    if (e.mods.isPopupMenu()) {
        grip_ = {};
        if (onMenu) onMenu(e.position);
        return;
    }
    if (onFling) grip_.body = body;
    if (onSelect) onSelect(grip_.actuator);
    if (!onHold || body < 0 || !e.mods.isShiftDown()) return;
    grip_.held = bodies_[static_cast<std::size_t>(body)].name;
    grip_.point = bodyPoint(grip_);
    hold();
}

void WorldView::hold() {
    const auto share = map().toShare(grip_.end);
    onHold(grip_.held, grip_.point, {share.x * scene_.fieldWidthMetres, share.y * scene_.fieldHeightMetres});
}

void WorldView::mouseDrag(const juce::MouseEvent& e) {
    grip_.end = e.position;
    grip_.isOutside = !getLocalBounds().toFloat().contains(e.position);
    if (grip_.actuator >= 0 && onMove && !grip_.isOutside && isDrag(e))
        onMove(grip_.actuator, map().toShare(e.position));
    if (isHolding()) hold();
    if (grip_.body >= 0) repaint();
}

void WorldView::cancelDrag() {
    const Grip grip = std::exchange(grip_, {});
    if (!grip.held.empty()) onRelease(grip.held);
    repaint();
}

void WorldView::mouseUp(const juce::MouseEvent& e) {
    const Grip grip = std::exchange(grip_, {});
    repaint();
    if (!grip.held.empty()) return onRelease(grip.held);
    if (grip.actuator >= 0 && grip.isOutside && onDetach) return onDetach(grip.actuator);
    if (onSpot && grip.actuator < 0 && !e.mods.isPopupMenu() && !isDrag(e) &&
        map().field.contains(e.position))
        return onSpot(map().toShare(e.position));
    if (grip.body < 0 || !onFling || !isDrag(e)) return;
    const auto drag = (e.position - grip.start).toDouble() / screenPixelsPerMetre(*this, displayWidthMetres_);
    onFling(bodies_[static_cast<std::size_t>(grip.body)].name, {drag.x, -drag.y}, bodyPoint(grip));
}

// The point in the body's own, rotated coordinates.
Vector WorldView::bodyPoint(const Grip& grip) const {
    const auto view = map();
    const auto pose = bodyPose(static_cast<std::size_t>(grip.body));
    const auto start = (grip.start - view.toPixel(pose.xMetres, pose.yMetres)) / view.pixelsPerMetre;
    const double c = std::cos(pose.angleRadians), s = std::sin(pose.angleRadians);
    return {c * start.x - s * start.y, -s * start.x - c * start.y};
}

bool WorldView::isInterestedInDragSource(const SourceDetails& details) {
    return onAttach && details.description == newActuatorDrag;
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
    onAttach(map().toShare(details.localPosition.toFloat()));
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
    const auto pixel = juce::Point<int>{x, y}.toFloat();
    onFiles(files, actuatorAt(pixel), map().toShare(pixel));
}

} // namespace physvib
