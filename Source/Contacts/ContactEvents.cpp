// SPDX-License-Identifier: MIT
// Runs the stages from contact reports to events, in their order.
#include "Contacts/ContactEvents.h"
#include "Contacts/EventMaker.h"
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace physvib {

namespace {

// Two haptic sources per direct collision, two voices each, of this step and the one whose events are held.
constexpr std::size_t heldImpacts = 8 * CollisionCatcher::maxDirectCollisions;

bool isAutomatic(const ImpactSettings& settings) noexcept {
    return settings.fullScaleNewtonSeconds == ImpactSettings::automatic;
}

const ImpactSettings& checked(const ImpactSettings& settings) {
    if (const std::string_view fault = faultOf(settings); !fault.empty())
        throw std::invalid_argument(std::string(fault));
    return settings;
}

} // namespace

std::string_view faultOf(const ImpactSettings& settings) noexcept {
    const auto isPositive = [](double value) { return value > 0.0 && std::isfinite(value); };
    const auto isAmount = [](double value) { return value >= 0.0 && std::isfinite(value); };
    if (!isPositive(settings.fieldWidthMetres)) return "field width: expected more than 0 m";
    if (!isAmount(settings.normalisation.value_or(0.0))) return "normalisation: expected 0 s/m or more";
    if (!isAmount(settings.handMassKg.value_or(0.0))) return "hand mass: expected 0 kg or more";
    if (!isAmount(settings.driveGain)) return "drive gain: expected 0 or more";
    if (!isAmount(settings.thresholdMetresPerSecond)) return "threshold: expected 0 m/s or more";
    if (settings.hitsPerStep.value_or(0) < 0) return "hits per step: expected 0 or more";
    if (!isAmount(settings.fullScaleNewtonSeconds) && !isAutomatic(settings))
        return "full-scale impulse: expected 0 (off), more than 0 N s, or -1 (automatic)";
    if (!isAmount(settings.settlingSeconds)) return "settling: expected 0 s or more";
    return {};
}

ContactEvents::ContactEvents(const BodyReader& bodies, const ImpactSettings& settings)
    : bodies_(bodies)
    , settings_(checked(settings))
    , catcher_(table_, graph_)
    , onset_(catcher_, table_, graph_)
    , release_(catcher_, table_, graph_, bodies)
    , lasting_(table_)
    , held_(heldImpacts) {
    impacts_.reserve(CollisionCatcher::expectedCollisions);
}

void ContactEvents::configure(const ImpactSettings& settings) {
    settings_ = checked(settings);
    if (settings_.timing == ImpactTiming::onset)
        release_.reset();
    else
        onset_.reset();
}

std::int32_t ContactEvents::know(std::uint64_t fixture, const BodyFacts& body) {
    const std::int32_t slot = table_.know(fixture, body);
    graph_.setPassing(slot, body.isDynamic);
    return slot;
}

std::int32_t ContactEvents::know(std::int32_t slot, const BodyFacts& body) {
    table_.know(slot, body);
    graph_.setPassing(slot, body.isDynamic);
    return slot;
}

SetResult ContactEvents::set(std::uint64_t fixture, const BodyFacts& body, Vector2 centre,
                             const HapticFixture& values, std::int32_t id) {
    if (const std::string_view fault = faultOf(values); !fault.empty()) return {-1, fault};
    if (id < FixtureTable::none) return {-1, "id: expected a number from 0 on"};
    const std::int32_t given = table_.set(know(fixture, body), values, centre, id);
    if (given == FixtureTable::none) return {-1, "id: expected one that no other fixture has"};
    if (values.texture.roughness > 0.0) lasting_.reserve();
    return {given, {}};
}

void ContactEvents::remove(std::int32_t slot) {
    forget(slot, true, !settings_.keepsHitsOfDestroyed);
    table_.unset(slot);
}

void ContactEvents::cut(std::int32_t a, std::int32_t b, const BodyMotion& motionA,
                        const BodyMotion& motionB) {
    conclude();
    catcher_.cut(a, b);
    impacts_.clear();
    release_.cut({a, b, 0, 1.0, motionA, motionB}, span_, impacts_);
    addImpacts();
}

void ContactEvents::vanish(std::int32_t slot) {
    conclude();
    if (settings_.keepsHitsOfDestroyed) {
        impacts_.clear();
        StepSpan span = span_;
        span.earliestNs = settledNs(); // earlier events may have been taken
        onset_.finish(slot, span, impacts_);
        release_.finish(slot, span, impacts_);
        addImpacts();
    }
    release(slot);
}

void ContactEvents::release(std::int32_t slot) {
    const bool isWithdrawn = !settings_.keepsHitsOfDestroyed;
    forget(slot, isWithdrawn, isWithdrawn);
    graph_.isolate(slot);
    table_.release(slot);
}

void ContactEvents::forget(std::int32_t slot, bool isWithdrawn, bool othersToo) {
    if (isWithdrawn) held_.withdraw(table_[slot].id, othersToo);
    catcher_.forget(slot);
    onset_.forget(slot, othersToo);
    release_.forget(slot, othersToo);
    lasting_.forget(slot);
}

void ContactEvents::beginStep(std::int64_t endNs, Vector2 gravity, double largestMassKg) {
    span_.earliestNs = span_.startNs;
    span_.startNs = span_.endNs;
    span_.endNs = std::max(span_.startNs, endNs);
    span_.leastMetresPerSecond = settings_.thresholdMetresPerSecond;
    span_.gravityMetresPerSecond2 = gravity;
    model_ = {settings_.normalisation.value_or(defaultNormalisation(settings_.fieldWidthMetres)),
              settings_.handMassKg.value_or(std::max(largestMassKg, table_.largestStaticMassKg(bodies_))),
              settings_.driveGain,
              isAutomatic(settings_) ? fullScale_.newtonSeconds() : settings_.fullScaleNewtonSeconds};
    catcher_.beginStep(span_);
    isConcluded_ = false;
    ContactCounts& tally = catcher_.tally();
    ++tally.steps;
    tally.zeroSteps += span_.endNs == span_.startNs ? 1 : 0;
    tally.longestStepSeconds = std::max(tally.longestStepSeconds, span_.seconds());
}

void ContactEvents::conclude() {
    if (catcher_.hasHeard() || lasting_.hasHeard()) finish();
}

void ContactEvents::endStep() {
    finish();
    catcher_.endStep();
    lasting_.endStep();
}

void ContactEvents::finish() {
    if (std::exchange(isConcluded_, true)) return;
    catcher_.settle();
    for (const Collision& collision : catcher_.collisions())
        if (!span_.isStrike(collision.impulse(), collision.lighterMassKg, collision.gravityScale))
            catcher_.passOver(collision.a, collision.b, collision.impulse() / collision.lighterMassKg);
    impacts_.clear();
    if (settings_.timing == ImpactTiming::onset)
        onset_.collect(span_, impacts_);
    else
        release_.collect(span_, impacts_);
    if (settings_.hitsPerStep) keepStrongest(static_cast<std::size_t>(*settings_.hitsPerStep));
    if (isAutomatic(settings_) || settings_.settlingSeconds > 0.0) { // learns from all, or looks at times
        lasting_.collect(span_, impacts_);
        return addImpacts();
    }
    addImpacts();
    if (!lasting_.hasHeard()) return;
    EventMaker maker = makeEvents();
    lasting_.collectFor(span_, maker);
}

void ContactEvents::keepStrongest(std::size_t count) {
    if (impacts_.size() <= count) return;
    const auto isStronger = [this](const Impact& a, const Impact& b) {
        return amplitudeOf(a, table_, bodies_, model_) > amplitudeOf(b, table_, bodies_, model_);
    };
    std::nth_element(impacts_.begin(), impacts_.begin() + static_cast<std::ptrdiff_t>(count), impacts_.end(),
                     isStronger);
    overBudget_ += impacts_.size() - count;
    impacts_.erase(impacts_.begin() + static_cast<std::ptrdiff_t>(count), impacts_.end());
}

void ContactEvents::addImpacts() {
    if (const double endNs = settings_.settlingSeconds * 1.0e9; endNs > 0.0)
        catcher_.tally().settling += std::erase_if(
            impacts_, [endNs](const Impact& impact) { return static_cast<double>(impact.timeNs) < endNs; });
    if (impacts_.empty()) return;
    if (isAutomatic(settings_)) {
        fullScale_.learn(impacts_, span_, table_);
        model_.fullScaleNewtonSeconds = fullScale_.newtonSeconds();
    }
    EventMaker maker = makeEvents();
    for (const Impact& impact : impacts_) maker.add(impact);
}

EventMaker ContactEvents::makeEvents() noexcept {
    return {table_, pairs_, bodies_, model_, settings_, held_, catcher_.tally()};
}

ContactCounts ContactEvents::recent() const noexcept {
    ContactCounts counts = catcher_.tally();
    counts.dropped = drops() + overBudget_ - past_.dropped;
    counts.thresholdMetresPerSecond = span_.thresholdMetresPerSecond(1.0F);
    counts.hasSources = table_.hasCameras();
    for (std::int32_t slot = 0; slot < table_.size() && counts.hasSources && !counts.mayBePushed; ++slot)
        counts.mayBePushed = table_.isCamera(slot) && table_[slot].isDynamic();
    counts.gravityMetresPerSecond2 = static_cast<double>(span_.gravityMetresPerSecond2.length());
    counts.wantedThreshold = settings_.thresholdMetresPerSecond;
    counts.fieldWidthMetres = settings_.fieldWidthMetres;
    counts.isMuted = settings_.isMuted;
    return counts;
}

ContactCounts ContactEvents::counts() const noexcept {
    ContactCounts all = past_;
    return all += recent();
}

ContactCounts ContactEvents::takeRecent() noexcept {
    const ContactCounts now = recent();
    past_ += now;
    catcher_.tally() = {};
    return now;
}

void ContactEvents::shift(Vector2 by) noexcept {
    settings_.fieldOrigin += by;
    onset_.shift(by);
    release_.shift(by);
}

} // namespace physvib
