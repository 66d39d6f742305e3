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
constexpr std::size_t maxPendingEvents = 8 * CollisionRecorder::maxDirectCollisions;

bool isAutomatic(const ImpactSettings& settings) noexcept {
    return settings.fullScaleNewtonSeconds == ImpactSettings::automatic;
}

const ImpactSettings& requireValid(const ImpactSettings& settings) {
    if (const std::string_view error = errorOf(settings); !error.empty())
        throw std::invalid_argument(std::string(error));
    return settings;
}

} // namespace

std::string_view errorOf(const ImpactSettings& settings) noexcept {
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
    , settings_(requireValid(settings))
    , recorder_(table_, graph_)
    , onset_(recorder_, table_, graph_)
    , release_(recorder_, table_, graph_, bodies)
    , lasting_(table_)
    , pendingEvents_(maxPendingEvents) {
    impacts_.reserve(CollisionRecorder::expectedCollisions);
}

void ContactEvents::configure(const ImpactSettings& settings) {
    settings_ = requireValid(settings);
    if (settings_.timing == ImpactTiming::onset)
        release_.reset();
    else
        onset_.reset();
}

std::int32_t ContactEvents::findOrAdd(std::uint64_t fixture, const BodyFacts& body) {
    const std::int32_t slot = table_.findOrAdd(fixture, body);
    graph_.setPassing(slot, body.isDynamic);
    return slot;
}

std::int32_t ContactEvents::updateBody(std::int32_t slot, const BodyFacts& body) {
    table_.updateBody(slot, body);
    graph_.setPassing(slot, body.isDynamic);
    return slot;
}

SetResult ContactEvents::set(std::uint64_t fixture, const BodyFacts& body, Vector2 centre,
                             const HapticFixture& values, std::int32_t id) {
    if (const std::string_view error = errorOf(values); !error.empty()) return {-1, error};
    if (id < FixtureTable::none) return {-1, "id: expected a number from 0 on"};
    const std::int32_t newId = table_.set(findOrAdd(fixture, body), values, centre, id);
    if (newId == FixtureTable::none) return {-1, "id: expected one that no other fixture has"};
    if (values.texture.roughness > 0.0) lasting_.reserve();
    return {newId, {}};
}

void ContactEvents::remove(std::int32_t slot) {
    forget(slot, true, !settings_.keepsHitsOfDestroyed);
    table_.removeValues(slot);
}

void ContactEvents::endOutsideStep(std::int32_t a, std::int32_t b, const BodyMotion& motionA,
                                   const BodyMotion& motionB) {
    processReports();
    recorder_.endOutsideStep(a, b);
    impacts_.clear();
    release_.endOutsideStep({a, b, 0, 1.0, motionA, motionB}, span_, impacts_);
    addImpacts();
}

void ContactEvents::handleDestruction(std::int32_t slot) {
    processReports();
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
    const bool dropsEvents = !settings_.keepsHitsOfDestroyed;
    forget(slot, dropsEvents, dropsEvents);
    graph_.isolate(slot);
    table_.release(slot);
}

void ContactEvents::forget(std::int32_t slot, bool dropsEvents, bool dropsCaused) {
    if (dropsEvents) pendingEvents_.removeEventsOf(table_[slot].id, dropsCaused);
    recorder_.forget(slot);
    onset_.forget(slot, dropsCaused);
    release_.forget(slot, dropsCaused);
    lasting_.forget(slot);
}

void ContactEvents::beginStep(std::int64_t endNs, Vector2 gravity, double largestMassKg) {
    span_.earliestNs = span_.startNs;
    span_.startNs = span_.endNs;
    span_.endNs = std::max(span_.startNs, endNs);
    span_.minThresholdMetresPerSecond = settings_.thresholdMetresPerSecond;
    span_.gravityMetresPerSecond2 = gravity;
    model_ = {settings_.normalisation.value_or(defaultNormalisation(settings_.fieldWidthMetres)),
              settings_.handMassKg.value_or(std::max(largestMassKg, table_.largestStaticMassKg(bodies_))),
              settings_.driveGain,
              isAutomatic(settings_) ? fullScale_.newtonSeconds() : settings_.fullScaleNewtonSeconds};
    recorder_.beginStep(span_);
    isProcessed_ = false;
    ContactCounts& tally = recorder_.tally();
    ++tally.steps;
    tally.zeroSteps += span_.endNs == span_.startNs ? 1 : 0;
    tally.longestStepSeconds = std::max(tally.longestStepSeconds, span_.seconds());
}

void ContactEvents::processReports() {
    if (recorder_.hasReports() || lasting_.hasReports()) processStep();
}

void ContactEvents::endStep() {
    processStep();
    recorder_.endStep();
    lasting_.endStep();
}

void ContactEvents::processStep() {
    if (std::exchange(isProcessed_, true)) return;
    recorder_.endReports();
    for (const Collision& collision : recorder_.collisions())
        if (!span_.isImpact(collision.impulse(), collision.lighterMassKg, collision.gravityScale))
            recorder_.countBelowThreshold(collision.a, collision.b,
                                          collision.impulse() / collision.lighterMassKg);
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
    if (!lasting_.hasReports()) return;
    EventMaker maker = makeEventMaker();
    lasting_.collectInto(span_, maker);
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
        recorder_.tally().settling += std::erase_if(
            impacts_, [endNs](const Impact& impact) { return static_cast<double>(impact.timeNs) < endNs; });
    if (impacts_.empty()) return;
    if (isAutomatic(settings_)) {
        fullScale_.learn(impacts_, span_, table_);
        model_.fullScaleNewtonSeconds = fullScale_.newtonSeconds();
    }
    EventMaker maker = makeEventMaker();
    for (const Impact& impact : impacts_) maker.add(impact);
}

EventMaker ContactEvents::makeEventMaker() noexcept {
    return {table_, pairSounds_, bodies_, model_, settings_, pendingEvents_, recorder_.tally()};
}

ContactCounts ContactEvents::recentCounts() const noexcept {
    ContactCounts counts = recorder_.tally();
    counts.dropped = drops() + overBudget_ - earlierCounts_.dropped;
    counts.thresholdMetresPerSecond = span_.thresholdMetresPerSecond(1.0F);
    counts.hasSources = table_.hasSources();
    for (std::int32_t slot = 0; slot < table_.size() && counts.hasSources && !counts.mayBePushed; ++slot)
        counts.mayBePushed = table_.isSource(slot) && table_[slot].isDynamic();
    counts.gravityMetresPerSecond2 = static_cast<double>(span_.gravityMetresPerSecond2.length());
    counts.configuredThresholdMetresPerSecond = settings_.thresholdMetresPerSecond;
    counts.fieldWidthMetres = settings_.fieldWidthMetres;
    counts.isMuted = settings_.isMuted;
    return counts;
}

ContactCounts ContactEvents::counts() const noexcept {
    ContactCounts total = earlierCounts_;
    return total += recentCounts();
}

ContactCounts ContactEvents::takeRecent() noexcept {
    const ContactCounts counts = recentCounts();
    earlierCounts_ += counts;
    recorder_.tally() = {};
    return counts;
}

void ContactEvents::shift(Vector2 offset) noexcept {
    settings_.fieldOrigin += offset;
    onset_.shift(offset);
    release_.shift(offset);
}

} // namespace physvib
