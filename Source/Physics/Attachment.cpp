// SPDX-License-Identifier: MIT
// Comes into a world, and leaves it as it was.
#include "Physics/Attachment.h"
#include "Physics/WorldNames.h"
#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

namespace physvib {

namespace {

// Worlds may call these for as long as the program runs.
void keepForEver(std::unique_ptr<WorldListener> listener) {
    struct Kept {
        std::unique_ptr<WorldListener> listener;
        Kept* next;
    };
    static std::atomic<Kept*> newest{nullptr}; // worlds may live on threads of their own; never destroyed:
                                               // worlds may be, later
    auto* const kept = new Kept{std::move(listener), newest.load()};
    while (!newest.compare_exchange_weak(kept->next, kept)) {
    }
}

} // namespace

Attachment::Attachment(b2World& world, const ImpactSettings& settings)
    : world_(&world)
    , bodies_(world, sweeps_)
    , events_(bodies_, settings)
    , listener_(std::make_unique<WorldListener>(events_, sweeps_, bodies_)) {
    for (const b2Contact* contact = world.GetContactList(); contact != nullptr; contact = contact->GetNext())
        listener_->finder().begin(*contact);
    listener_->install(world);
}

Attachment::~Attachment() {
    if (world_ == nullptr) return;
    listener_->deafen();
    keepForEver(std::move(listener_));
}

void Attachment::detach() {
    if (world_ == nullptr) return;
    listener_->deafen();
    if (!listener_->remove(*world_)) keepForEver(std::move(listener_));
    world_ = nullptr;
}

SetResult Attachment::set(const b2Fixture& fixture, const HapticFixture& values, std::int32_t id) {
    if (fixture.GetBody()->GetWorld() != world_)
        return {-1, "fixture: expected one of the world attached to"};
    listener_->finder().find(fixture); // an heir of its address starts anew
    return events_.set(nameOf(fixture), factsOf(*fixture.GetBody()), centreOf(fixture), values, id);
}

const HapticFixture* Attachment::find(const b2Fixture& fixture) const noexcept {
    const FixtureTable& fixtures = events_.fixtures();
    const std::int32_t slot = fixtures.find(nameOf(fixture));
    const bool isIt = slot != FixtureTable::none && fixtures[slot].isNamed() &&
                      fixtures[slot].body.body == nameOf(*fixture.GetBody());
    return isIt ? &fixtures[slot].values : nullptr;
}

void Attachment::remove(const b2Fixture& fixture) {
    if (const std::int32_t slot = events_.fixtures().find(nameOf(fixture)); slot != FixtureTable::none)
        events_.remove(slot);
}

void Attachment::step(float stepSeconds, int velocityIterations, int positionIterations) {
    if (!(stepSeconds >= 0.0F) || world_ == nullptr) return;
    beginStep(static_cast<double>(stepSeconds));
    world_->Step(stepSeconds, velocityIterations, positionIterations); // within it nothing can be destroyed
    finishStep();
}

void Attachment::beginStep(double stepSeconds) {
    constexpr double longest = 3600.0; // keeps nonsense inside 64 bits
    const double seconds = stepSeconds > 0.0 ? std::min(stepSeconds, longest) : 0.0;
    beginStepUntil(timeNs() + std::llround(seconds * 1.0e9));
}

void Attachment::beginStepUntil(std::int64_t endNs) {
    if (world_ == nullptr) return;
    if (!listener_->isInstalled(*world_)) releaseUnseen();
    listener_->install(*world_);
    const double stepSeconds = static_cast<double>(std::max<std::int64_t>(0, endNs - timeNs())) * 1.0e-9;
    sweeps_.beginStep(*world_, stepSeconds);
    bodies_.doubt();
    events_.beginStep(endNs, toVector(world_->GetGravity()), sweeps_.largestMassKg());
}

void Attachment::endStep() {
    bodies_.doubt();
    finishStep();
}

void Attachment::finishStep() {
    if (world_ == nullptr) return;
    if (!listener_->isInstalled(*world_)) releaseUnseen();
    events_.endStep();
    listener_->finder().endStep();
}

// What was destroyed while nobody told us. Not often: a game has set a listener of its own.
void Attachment::releaseUnseen() {
    listener_->finder().forgetContacts();
    bodies_.doubt();
    for (std::int32_t slot = 0; slot < events_.fixtures().size(); ++slot)
        if (const KnownFixture& known = events_.fixtures()[slot];
            known.isUsed() && !bodies_.has(known.body.body))
            events_.release(slot);
}

void Attachment::shiftOrigin(b2Vec2 newOrigin) {
    if (world_ == nullptr) return;
    world_->ShiftOrigin(newOrigin);
    events_.shift(-toVector(newOrigin));
}

} // namespace physvib
