// SPDX-License-Identifier: MIT
// Installs the listener in a world, runs the stages around each step, and restores the world.
#include "Physics/Attachment.h"
#include "Contacts/ContactCounts.h"
#include "Contacts/ContactEvents.h"
#include "Contacts/FixtureTable.h"
#include "Physics/WorldBodies.h"
#include "Physics/WorldListener.h"
#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>
#include <utility>

// A look at a world's haptic sources, to explain why they touch nothing.

class b2World;

namespace physvib {

class FixtureTable;
struct ContactCounts;

/// Notes the sources that are sensors, filtered from every other fixture, disabled or asleep. World thread
/// (M), not inside a step.
void noteSources(const b2World& world, const FixtureTable& fixtures, ContactCounts& counts);

} // namespace physvib

namespace physvib {
namespace {

// A world may call a listener for as long as the program runs.
void keepForEver(std::unique_ptr<WorldListener> listener) {
    struct Kept {
        std::unique_ptr<WorldListener> listener;
        Kept* next;
    };
    static std::atomic<Kept*> newest{nullptr}; // worlds may live on several threads; never destroyed,
                                               // since a world may outlive it
    auto* const kept = new Kept{std::move(listener), newest.load()};
    while (!newest.compare_exchange_weak(kept->next, kept)) {
    }
}

} // namespace

static_assert(Attachment::nextId == FixtureTable::none);

struct Attachment::Parts {
    Parts(const b2World& world, const ImpactSettings& settings)
        : bodies(world, sweeps)
        , events(bodies, settings)
        , listener(std::make_unique<WorldListener>(events, sweeps, bodies)) {}

    BodySweeps sweeps;
    WorldBodies bodies;
    ContactEvents events;
    std::unique_ptr<WorldListener> listener;
};

Attachment::Attachment(b2World& world, const ImpactSettings& settings)
    : world_(&world)
    , parts_(std::make_unique<Parts>(world, settings)) {
    for (const b2Contact* contact = world.GetContactList(); contact != nullptr; contact = contact->GetNext())
        parts_->listener->finder().begin(*contact);
    parts_->listener->install(world);
}

Attachment::~Attachment() {
    if (world_ == nullptr) return;
    parts_->listener->deactivate();
    keepForEver(std::move(parts_->listener));
}

void Attachment::detach() {
    if (world_ == nullptr) return;
    parts_->listener->deactivate();
    if (!parts_->listener->remove(*world_)) keepForEver(std::move(parts_->listener));
    world_ = nullptr;
}

void Attachment::configure(const ImpactSettings& settings) { parts_->events.configure(settings); }
const ImpactSettings& Attachment::settings() const noexcept { return parts_->events.settings(); }

SetResult Attachment::set(const b2Fixture& fixture, const HapticFixture& values, std::int32_t id) {
    if (fixture.GetBody()->GetWorld() != world_)
        return {-1, "fixture: expected one of the world attached to"};
    // a fixture that reuses the address of a destroyed one gets new state
    parts_->listener->finder().find(fixture);
    return parts_->events.set(idOf(fixture), factsOf(*fixture.GetBody()), centreOf(fixture), values, id);
}

std::string_view Attachment::setPair(int surface, int other, const PairSound& sound) {
    return parts_->events.setPair(surface, other, sound);
}

const HapticFixture* Attachment::find(const b2Fixture& fixture) const noexcept {
    const FixtureTable& fixtures = parts_->events.fixtures();
    const std::int32_t slot = fixtures.find(idOf(fixture));
    const bool isIt = slot != FixtureTable::none && fixtures[slot].isNamed() &&
                      fixtures[slot].body.body == idOf(*fixture.GetBody());
    return isIt ? &fixtures[slot].values : nullptr;
}

void Attachment::remove(const b2Fixture& fixture) {
    if (const std::int32_t slot = parts_->events.fixtures().find(idOf(fixture)); slot != FixtureTable::none)
        parts_->events.remove(slot);
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
    if (!parts_->listener->isInstalled(*world_)) releaseUnseen();
    parts_->listener->install(*world_);
    const double stepSeconds = static_cast<double>(std::max<std::int64_t>(0, endNs - timeNs())) * 1.0e-9;
    parts_->sweeps.beginStep(*world_, stepSeconds);
    parts_->bodies.invalidate();
    parts_->events.beginStep(endNs, toVector(world_->GetGravity()), parts_->sweeps.largestMassKg());
}

void Attachment::endStep() {
    parts_->bodies.invalidate();
    finishStep();
}

void Attachment::finishStep() {
    if (world_ == nullptr) return;
    if (!parts_->listener->isInstalled(*world_)) releaseUnseen();
    parts_->events.endStep();
    parts_->listener->finder().endStep();
}

// Releases fixtures that were destroyed while a listener of the game had replaced ours.
void Attachment::releaseUnseen() {
    parts_->listener->finder().forgetContacts();
    parts_->bodies.invalidate();
    for (std::int32_t slot = 0; slot < parts_->events.fixtures().size(); ++slot)
        if (const KnownFixture& known = parts_->events.fixtures()[slot];
            known.isUsed() && !parts_->bodies.has(known.body.body))
            parts_->events.release(slot);
}

void Attachment::shiftOrigin(b2Vec2 newOrigin) {
    if (world_ == nullptr) return;
    world_->ShiftOrigin(newOrigin);
    parts_->events.shift(-toVector(newOrigin));
}

std::int64_t Attachment::timeNs() const noexcept { return parts_->events.timeNs(); }
std::int64_t Attachment::settledNs() const noexcept { return parts_->events.settledNs(); }
void Attachment::take(std::vector<CollisionEvent>& events) { parts_->events.drain(events); }
void Attachment::flush(std::vector<CollisionEvent>& events) { parts_->events.flush(events); }
std::uint64_t Attachment::drops() const noexcept { return parts_->events.drops(); }
std::uint64_t Attachment::overBudget() const noexcept { return parts_->events.overBudget(); }
ContactCounts Attachment::counts() const noexcept { return parts_->events.counts(); }

std::string Attachment::explain(const OutputFacts* output) {
    ContactEvents& events = parts_->events;
    if (world_ != nullptr) noteSources(*world_, events.fixtures(), events.catcher().tally());
    const ContactCounts recent = events.takeRecent();
    return inNames(physvib::explain(recent, events.counts(), output), Names::cpp);
}

const ImpactModel& Attachment::impactModel() const noexcept { return parts_->events.impactModel(); }

// Finds haptic sources that Box2D lets touch nothing. It starts from the world's own lists, because a
// fixture in the table may have been destroyed unseen.

namespace {

// As b2ContactFilter decides.
bool mayTouch(const b2Filter& a, const b2Filter& b) noexcept {
    if (a.groupIndex == b.groupIndex && a.groupIndex != 0) return a.groupIndex > 0;
    return (a.maskBits & b.categoryBits) != 0 && (a.categoryBits & b.maskBits) != 0;
}

bool isFiltered(const b2World& world, const b2Fixture& source) {
    bool hasOthers = false;
    for (const b2Body* body = world.GetBodyList(); body != nullptr; body = body->GetNext())
        for (const b2Fixture* f = body->GetFixtureList(); f != nullptr && body != source.GetBody();
             f = f->GetNext()) {
            if (mayTouch(source.GetFilterData(), f->GetFilterData())) return false;
            hasOthers = true;
        }
    return hasOthers;
}

std::optional<EngineNote> noteOf(const b2World& world, const b2Fixture& source) {
    const b2Body& body = *source.GetBody();
    if (!body.IsEnabled()) return EngineNote::disabled;
    if (source.IsSensor()) return EngineNote::sensor;
    if (isFiltered(world, source)) return EngineNote::filtered;
    if (body.GetType() != b2_staticBody && !body.IsAwake()) return EngineNote::asleep;
    return {};
}

} // namespace

void noteSources(const b2World& world, const FixtureTable& fixtures, ContactCounts& counts) {
    for (const b2Body* body = world.GetBodyList(); body != nullptr; body = body->GetNext())
        for (const b2Fixture* f = body->GetFixtureList(); f != nullptr; f = f->GetNext())
            if (const std::int32_t slot = fixtures.find(idOf(*f));
                slot != FixtureTable::none && fixtures.isCamera(slot))
                if (const auto note = noteOf(world, *f)) counts.note(*note, fixtures[slot].id);
}
} // namespace physvib
