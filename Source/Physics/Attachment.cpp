// SPDX-License-Identifier: MIT
// Comes into a world, and leaves it as it was.
#include "Physics/Attachment.h"
#include "Physics/ImpactEvents.h"
#include "Physics/InstalledListener.h"
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace physvib {

namespace {

// Two cameras per direct record, two voices each, of this step and of the one whose events still wait.
constexpr std::size_t heldImpacts = 8 * CollisionCatcher::maxDirectRecords;

constexpr double restingSteps = 1.5; // see AttachmentSettings::thresholdMetresPerSecond

const AttachmentSettings& checked(const AttachmentSettings& settings) {
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

Attachment::Attachment(b2World& world, const AttachmentSettings& settings)
    : world_(world)
    , chained_(destructionListenerOf(world))
    , settings_(checked(settings))
    , catcher_(table_, graph_, *world.GetContactManager().m_contactListener)
    , onset_(catcher_, table_, graph_)
    , release_(catcher_, table_, graph_)
    , held_(heldImpacts) {
    impacts_.reserve(heldImpacts);
    refresh();
    for (const b2Contact* contact = world.GetContactList(); contact != nullptr; contact = contact->GetNext())
        catcher_.meet(*contact);
    world.SetContactListener(&catcher_);
    world.SetDestructionListener(this);
}

Attachment::~Attachment() {
    if (world_.GetContactManager().m_contactListener == &catcher_)
        world_.SetContactListener(&catcher_.chained());
    if (destructionListenerOf(world_) == this) world_.SetDestructionListener(chained_);
}

void Attachment::configure(const AttachmentSettings& settings) {
    settings_ = checked(settings);
    if (settings_.timing == ImpactTiming::onset)
        release_.reset();
    else
        onset_.reset();
}

std::int32_t Attachment::set(const b2Fixture& fixture, const HapticFixture& values) {
    check(fixture);
    return table_.set(fixture, values);
}

void Attachment::set(const b2Fixture& fixture, const HapticFixture& values, std::int32_t id) {
    check(fixture);
    table_.set(fixture, values, id);
}

const HapticFixture* Attachment::find(const b2Fixture& fixture) const noexcept {
    const std::int32_t slot = table_.find(fixture);
    return slot != FixtureTable::none && table_[slot].isNamed() ? &table_[slot].values : nullptr;
}

void Attachment::remove(const b2Fixture& fixture) {
    const std::int32_t slot = table_.find(fixture);
    if (slot == FixtureTable::none) return;
    forget(slot);
    table_.unset(slot);
}

void Attachment::step(float stepSeconds, int velocityIterations, int positionIterations) {
    if (!(stepSeconds > 0.0F)) return;
    beginStep(static_cast<double>(stepSeconds));
    world_.Step(stepSeconds, velocityIterations, positionIterations);
    endStep();
}

void Attachment::beginStep(double stepSeconds) {
    constexpr double longest = 3600.0; // keeps nonsense inside 64 bits
    const double seconds = stepSeconds > 0.0 ? std::min(stepSeconds, longest) : 0.0;
    beginStepUntil(timeNs() + std::llround(seconds * 1.0e9));
}

void Attachment::beginStepUntil(std::int64_t endNs) {
    span_.earliestNs = span_.startNs;
    span_.startNs = span_.endNs;
    span_.endNs = std::max(span_.startNs, endNs);
    refresh();
    span_.gravity = world_.GetGravity();
    const double resting = restingSteps * static_cast<double>(span_.gravity.Length()) * span_.seconds();
    span_.thresholdMetresPerSecond = std::max(settings_.thresholdMetresPerSecond, resting);
    model_ = {settings_.normalisation.value_or(defaultNormalisation(settings_.fieldWidthMetres)),
              settings_.handMassKg.value_or(table_.largestMassKg()), settings_.driveGain};
    catcher_.beginStep(world_, span_.seconds());
}

void Attachment::endStep() {
    catcher_.settle();
    impacts_.clear();
    if (settings_.timing == ImpactTiming::onset)
        onset_.collect(span_, impacts_);
    else
        release_.collect(span_, impacts_);
    for (const Impact& impact : impacts_) addEvents(impact, table_, model_, settings_.location, held_);
    catcher_.endStep();
}

void Attachment::take(std::vector<CollisionEvent>& events) {
    const auto first = static_cast<std::ptrdiff_t>(events.size());
    held_.release(settledNs(), events);
    for (auto event = events.begin() + first; event != events.end(); ++event)
        event->source.other = std::max(event->source.other, -1); // fixtures without values are nobody
}

std::uint64_t Attachment::drops() const noexcept {
    return catcher_.drops() + release_.drops() + held_.drops();
}

void Attachment::SayGoodbye(b2Joint* joint) {
    if (chained_ != nullptr) chained_->SayGoodbye(joint);
}

void Attachment::SayGoodbye(b2Fixture* fixture) {
    if (const std::int32_t slot = table_.find(*fixture); slot != FixtureTable::none) release(slot);
    if (chained_ != nullptr) chained_->SayGoodbye(fixture);
}

void Attachment::refresh() {
    vanished_.clear();
    table_.refresh(world_, vanished_);
    for (const std::int32_t slot : vanished_) release(slot);
    for (std::int32_t slot = 0; slot < table_.size(); ++slot)
        if (table_[slot].fixture != nullptr) graph_.setPassing(slot, table_[slot].isDynamic());
}

void Attachment::forget(std::int32_t slot) {
    const bool withdraws = !settings_.keepsHitsOfDestroyed;
    held_.withdraw(table_[slot].id, withdraws);
    catcher_.forget(slot);
    onset_.forget(slot, withdraws);
    release_.forget(slot, withdraws);
}

void Attachment::release(std::int32_t slot) {
    forget(slot);
    graph_.isolate(slot);
    table_.release(slot);
}

void Attachment::check(const b2Fixture& fixture) const {
    if (fixture.GetBody()->GetWorld() != &world_)
        throw std::invalid_argument("fixture: expected one of the world attached to");
}

} // namespace physvib
