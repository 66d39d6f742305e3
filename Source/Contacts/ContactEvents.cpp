// SPDX-License-Identifier: MIT
// The order in which the stages work.
#include "Contacts/ContactEvents.h"
#include "Contacts/ImpactEvents.h"
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace physvib {

namespace {

// Two cameras per direct record, two voices each, of this step and of the one whose events still wait.
constexpr std::size_t heldImpacts = 8 * CollisionCatcher::maxDirectRecords;

constexpr double restingSteps = 1.5; // see ImpactSettings::thresholdMetresPerSecond

const ImpactSettings& checked(const ImpactSettings& settings) {
    const auto isPositive = [](double value) { return value > 0.0 && std::isfinite(value); };
    const auto isAmount = [](double value) { return value >= 0.0 && std::isfinite(value); };
    if (!isPositive(settings.fieldWidthMetres))
        throw std::invalid_argument("field width: expected more than 0 m");
    if (!isAmount(settings.normalisation.value_or(0.0)))
        throw std::invalid_argument("normalisation: expected 0 s/m or more");
    if (!isAmount(settings.handMassKg.value_or(0.0)))
        throw std::invalid_argument("hand mass: expected 0 kg or more");
    if (!isAmount(settings.driveGain)) throw std::invalid_argument("drive gain: expected 0 or more");
    if (!isAmount(settings.thresholdMetresPerSecond))
        throw std::invalid_argument("threshold: expected 0 m/s or more");
    return settings;
}

} // namespace

ContactEvents::ContactEvents(const BodyReader& bodies, const ImpactSettings& settings)
    : bodies_(bodies)
    , settings_(checked(settings))
    , catcher_(table_, graph_)
    , onset_(catcher_, table_, graph_)
    , release_(catcher_, table_, graph_, bodies)
    , held_(heldImpacts) {
    impacts_.reserve(heldImpacts);
}

void ContactEvents::configure(const ImpactSettings& settings) {
    settings_ = checked(settings);
    if (settings_.timing == ImpactTiming::onset)
        release_.reset();
    else
        onset_.reset();
}

void ContactEvents::remove(std::int32_t slot) {
    forget(slot);
    table_.unset(slot);
}

void ContactEvents::release(std::int32_t slot) {
    forget(slot);
    graph_.isolate(slot);
    table_.release(slot);
}

void ContactEvents::forget(std::int32_t slot) {
    const bool withdraws = !settings_.keepsHitsOfDestroyed;
    held_.withdraw(table_[slot].id, withdraws);
    catcher_.forget(slot);
    onset_.forget(slot, withdraws);
    release_.forget(slot, withdraws);
}

void ContactEvents::endLook() {
    vanished_.clear();
    table_.endLook(vanished_);
    for (const std::int32_t slot : vanished_) release(slot);
    for (std::int32_t slot = 0; slot < table_.size(); ++slot)
        if (table_[slot].isUsed()) graph_.setPassing(slot, table_[slot].isDynamic());
}

void ContactEvents::beginStep(std::int64_t endNs, Vector2 gravity) {
    span_.earliestNs = span_.startNs;
    span_.startNs = span_.endNs;
    span_.endNs = std::max(span_.startNs, endNs);
    span_.gravityMetresPerSecond2 = gravity;
    const double resting = restingSteps * static_cast<double>(gravity.length()) * span_.seconds();
    span_.thresholdMetresPerSecond = std::max(settings_.thresholdMetresPerSecond, resting);
    model_ = {settings_.normalisation.value_or(defaultNormalisation(settings_.fieldWidthMetres)),
              settings_.handMassKg.value_or(table_.largestMassKg()), settings_.driveGain};
    catcher_.beginStep();
}

void ContactEvents::endStep() {
    catcher_.settle();
    impacts_.clear();
    if (settings_.timing == ImpactTiming::onset)
        onset_.collect(span_, impacts_);
    else
        release_.collect(span_, impacts_);
    for (const Impact& impact : impacts_) addEvents(impact, table_, bodies_, model_, settings_.location, held_);
    catcher_.endStep();
}

void ContactEvents::take(std::vector<CollisionEvent>& events) {
    const auto first = static_cast<std::ptrdiff_t>(events.size());
    held_.release(settledNs(), events);
    for (auto event = events.begin() + first; event != events.end(); ++event)
        event->source.other = std::max(event->source.other, -1); // fixtures without values are nobody
}

} // namespace physvib
