// SPDX-License-Identifier: MIT
// Installs the listener in a world, runs the stages around each step, and restores the world.
#include "Physics/Attachment.h"
#include "Contacts/ContactCounts.h"
#include "Contacts/ContactEvents.h"
#include "Contacts/FixtureTable.h"
#include "Physics/CollisionFinder.h"
#include "Physics/WorldBodies.h"
#include <algorithm>
#include <atomic>
#include <box2d/box2d.h>
#include <cmath>
#include <memory>
#include <optional>
#include <typeinfo>
#include <utility>

namespace physvib {

/// Listens to one b2World, and forwards every call to the listeners that were set before.
///
/// A world keeps bare pointers to its listeners and does not announce its destruction. So a listener may be
/// destroyed only once its world is known to have another one (`remove`); otherwise the attachment leaves it
/// behind, deactivated and forwarding calls. World thread (M).
class WorldListener final : public b2ContactListener, public b2DestructionListener {
public:
    WorldListener(ContactEvents& events, BodySweeps& sweeps, WorldBodies& bodies)
        : events_(events)
        , bodies_(bodies)
        , finder_(std::make_unique<CollisionFinder>(events, sweeps)) {}
    WorldListener(const WorldListener&) = delete;
    WorldListener& operator=(const WorldListener&) = delete;

    /// Sets itself as the world's listener, also again after a game has set another one or none, and forwards
    /// to the one that it replaces.
    void install(b2World& world);

    /// True if the world reports destructions to it.
    bool isInstalled(b2World& world) const;

    /// Restores the world's earlier listeners. False, and nothing is restored, if another listener has been
    /// set that may forward to this one.
    bool remove(b2World& world);

    /// From now on it only forwards calls.
    void deactivate() noexcept {
        finder_.reset();
        isAlone_ = false;
    }

    CollisionFinder& finder() noexcept { return *finder_; }

    void BeginContact(b2Contact* contact) override;
    void EndContact(b2Contact* contact) override;
    void PreSolve(b2Contact* contact, const b2Manifold* oldManifold) override;
    void PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) override;
    void SayGoodbye(b2Joint* joint) override;
    void SayGoodbye(b2Fixture* fixture) override;

private:
    [[gnu::noinline]] void forward(b2Contact* contact, const b2Manifold* oldManifold);
    [[gnu::noinline]] void forward(b2Contact* contact, const b2ContactImpulse* impulse);
    class Call;
    template <class Listener>
    static Listener* skipInactive(Listener* current, Listener* WorldListener::*next);
    template <class Listener>
    bool isReachedBy(Listener* current, Listener* WorldListener::*next) const;

    ContactEvents& events_;
    WorldBodies& bodies_;
    std::unique_ptr<CollisionFinder> finder_; // null: deactivated
    b2ContactListener* chained_ = nullptr;
    // active, and nothing to forward to: no other listener, or Box2D's own, which does nothing
    bool isAlone_ = false;
    b2DestructionListener* chainedDestruction_ = nullptr;
    const void* forwardedObject_ = nullptr; // object of the call that is being forwarded
};

namespace {

// A world may call a listener for as long as the program runs.
void keepUntilExit(std::unique_ptr<WorldListener> listener) {
    struct Node {
        std::unique_ptr<WorldListener> listener;
        Node* next;
    };
    static std::atomic<Node*> newest{nullptr}; // worlds may live on several threads; never destroyed,
                                               // since a world may outlive it
    auto* const node = new Node{std::move(listener), newest.load()};
    while (!newest.compare_exchange_weak(node->next, node)) {
    }
}

// True if b2ContactFilter lets fixtures with these filters touch.
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

std::optional<EngineNote> findNote(const b2World& world, const b2Fixture& source) {
    const b2Body& body = *source.GetBody();
    if (!body.IsEnabled()) return EngineNote::disabled;
    if (source.IsSensor()) return EngineNote::sensor;
    if (isFiltered(world, source)) return EngineNote::filtered;
    if (body.GetType() != b2_staticBody && !body.IsAwake()) return EngineNote::asleep;
    return {};
}

// Notes the sources that are sensors, filtered from every other fixture, disabled or asleep. It starts from
// the world's own lists, because a fixture in the table may have been destroyed unseen. Not inside a step.
void noteSources(const b2World& world, const FixtureTable& fixtures, ContactCounts& counts) {
    for (const b2Body* body = world.GetBodyList(); body != nullptr; body = body->GetNext())
        for (const b2Fixture* f = body->GetFixtureList(); f != nullptr; f = f->GetNext())
            if (const std::int32_t slot = fixtures.find(idOf(*f));
                slot != FixtureTable::none && fixtures.isSource(slot))
                if (const auto note = findNote(world, *f)) counts.note(*note, fixtures[slot].id);
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
        parts_->listener->finder().begin(*contact, false);
    parts_->listener->install(world);
    parts_->sweeps.reserve(static_cast<std::size_t>(world.GetBodyCount()));
}

Attachment::~Attachment() {
    if (world_ == nullptr) return;
    parts_->listener->deactivate();
    keepUntilExit(std::move(parts_->listener));
}

void Attachment::detach() {
    if (world_ == nullptr) return;
    parts_->listener->deactivate();
    if (!parts_->listener->remove(*world_)) keepUntilExit(std::move(parts_->listener));
    world_ = nullptr;
}

void Attachment::configure(const ImpactSettings& settings) { parts_->events.configure(settings); }
const ImpactSettings& Attachment::settings() const noexcept { return parts_->events.settings(); }

SetResult Attachment::set(const b2Fixture& fixture, const HapticFixture& values, std::int32_t id) {
    if (fixture.GetBody()->GetWorld() != world_)
        return {-1, "fixture: expected one of the world attached to"};
    // a fixture that reuses the address of a destroyed one gets new state
    parts_->listener->finder().findSlot(fixture);
    return parts_->events.set(idOf(fixture), factsOf(*fixture.GetBody()), centreOf(fixture), values, id);
}

std::string_view Attachment::setPair(int surface, int other, const PairSound& sound) {
    return parts_->events.setPair(surface, other, sound);
}

const HapticFixture* Attachment::find(const b2Fixture& fixture) const noexcept {
    const FixtureTable& fixtures = parts_->events.fixtures();
    const std::int32_t slot = fixtures.find(idOf(fixture));
    const bool hasValues = slot != FixtureTable::none && fixtures[slot].hasHapticValues() &&
                           fixtures[slot].body.body == idOf(*fixture.GetBody());
    return hasValues ? &fixtures[slot].values : nullptr;
}

void Attachment::remove(const b2Fixture& fixture) {
    if (const std::int32_t slot = parts_->events.fixtures().find(idOf(fixture)); slot != FixtureTable::none)
        parts_->events.remove(slot);
}

void Attachment::step(float stepSeconds, int velocityIterations, int positionIterations) {
    if (!(stepSeconds >= 0.0F) || world_ == nullptr) return;
    beginStep(static_cast<double>(stepSeconds));
    parts_->bodies.beginStep(); // within it nothing can be destroyed
    world_->Step(stepSeconds, velocityIterations, positionIterations);
    finishStep();
}

void Attachment::beginStep(double stepSeconds) {
    constexpr double longest = 3600.0; // keeps nonsense inside 64 bits
    const double seconds = stepSeconds > 0.0 ? std::min(stepSeconds, longest) : 0.0;
    beginStepUntil(timeNs() + std::llround(seconds * 1.0e9));
}

void Attachment::beginStepUntil(std::int64_t endNs) {
    if (world_ == nullptr) return;
    if (!parts_->listener->isInstalled(*world_)) releaseDestroyedFixtures();
    parts_->listener->install(*world_);
    const double stepSeconds = static_cast<double>(std::max<std::int64_t>(0, endNs - timeNs())) * 1.0e-9;
    parts_->sweeps.beginStep(*world_, stepSeconds);
    parts_->bodies.beginStep();
    parts_->events.beginStep(endNs, toVector(world_->GetGravity()), parts_->sweeps.largestMassKg());
    parts_->bodies.invalidate(); // the game may destroy bodies before its step
}

void Attachment::endStep() {
    parts_->bodies.invalidate();
    finishStep();
}

void Attachment::finishStep() {
    if (world_ == nullptr) return;
    if (!parts_->listener->isInstalled(*world_)) releaseDestroyedFixtures();
    parts_->events.endStep();
    parts_->listener->finder().endStep();
}

// Releases fixtures that were destroyed while a listener of the game had replaced ours.
void Attachment::releaseDestroyedFixtures() {
    parts_->listener->finder().clearCache();
    parts_->bodies.invalidate();
    for (std::int32_t slot = 0; slot < parts_->events.fixtures().size(); ++slot)
        if (const FixtureEntry& entry = parts_->events.fixtures()[slot];
            entry.isUsed() && !parts_->bodies.has(entry.body.body))
            parts_->events.release(slot);
}

void Attachment::shiftOrigin(b2Vec2 newOrigin) {
    if (world_ == nullptr) return;
    world_->ShiftOrigin(newOrigin);
    parts_->events.shift(-toVector(newOrigin));
}

std::int64_t Attachment::timeNs() const noexcept { return parts_->events.timeNs(); }
std::int64_t Attachment::settledNs() const noexcept { return parts_->events.settledNs(); }
void Attachment::take(std::vector<CollisionEvent>& events) { parts_->events.appendFinal(events); }
void Attachment::flush(std::vector<CollisionEvent>& events) { parts_->events.flush(events); }
std::uint64_t Attachment::drops() const noexcept { return parts_->events.drops(); }
std::uint64_t Attachment::overBudget() const noexcept { return parts_->events.overBudget(); }
ContactCounts Attachment::counts() const noexcept { return parts_->events.counts(); }

std::string Attachment::explain(const OutputFacts* output) {
    ContactEvents& events = parts_->events;
    if (world_ != nullptr) noteSources(*world_, events.fixtures(), events.recorder().tally());
    const ContactCounts recent = events.takeRecent();
    return replaceNames(physvib::explain(recent, events.counts(), output), Names::cpp);
}

const ImpactModel& Attachment::impactModel() const noexcept { return parts_->events.impactModel(); }

/// A game's listener may forward calls to the listener that it replaced, which may be this one: each call is
/// processed once.
class WorldListener::Call {
public:
    Call(WorldListener& listener, const void* object) noexcept
        : forwardedObject_(listener.forwardedObject_)
        , outerObject_(std::exchange(listener.forwardedObject_, object))
        , isFirst_(outerObject_ != object) {}
    ~Call() { forwardedObject_ = outerObject_; }
    Call(const Call&) = delete;
    Call& operator=(const Call&) = delete;
    explicit operator bool() const noexcept { return isFirst_; }

private:
    const void*& forwardedObject_;
    const void* outerObject_;
    bool isFirst_;
};

void WorldListener::BeginContact(b2Contact* contact) {
    const Call call{*this, contact};
    if (!call) return;
    if (finder_) finder_->begin(*contact, isAlone_);
    if (chained_ != nullptr) chained_->BeginContact(contact);
}

void WorldListener::EndContact(b2Contact* contact) {
    const Call call{*this, contact};
    if (!call) return;
    if (finder_) {
        const b2Body &a = *contact->GetFixtureA()->GetBody(), &b = *contact->GetFixtureB()->GetBody();
        // Ended by the game outside a step; it may have destroyed other bodies without a callback.
        if (!a.GetWorld()->IsLocked()) bodies_.invalidate(&a, &b);
        finder_->end(*contact);
    }
    if (chained_ != nullptr) chained_->EndContact(contact);
}

void WorldListener::PreSolve(b2Contact* contact, const b2Manifold* oldManifold) {
    if (isAlone_) return finder_->onPreSolve(*contact, *oldManifold);
    forward(contact, oldManifold);
}

void WorldListener::forward(b2Contact* contact, const b2Manifold* oldManifold) {
    const Call call{*this, contact};
    if (!call) return;
    if (chained_ != nullptr) chained_->PreSolve(contact, oldManifold); // it may disable the contact
    if (finder_) finder_->onPreSolve(*contact, *oldManifold);
}

void WorldListener::PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) {
    if (isAlone_) return finder_->onPostSolve(*contact, *impulse);
    forward(contact, impulse);
}

void WorldListener::forward(b2Contact* contact, const b2ContactImpulse* impulse) {
    const Call call{*this, contact};
    if (!call) return;
    if (finder_) finder_->onPostSolve(*contact, *impulse);
    if (chained_ != nullptr) chained_->PostSolve(contact, impulse);
}

void WorldListener::SayGoodbye(b2Joint* joint) {
    const Call call{*this, joint};
    if (call && chainedDestruction_ != nullptr) chainedDestruction_->SayGoodbye(joint);
}

void WorldListener::SayGoodbye(b2Fixture* fixture) {
    const Call call{*this, fixture};
    if (!call) return;
    if (const std::int32_t slot = finder_ ? finder_->findSlot(*fixture) : FixtureTable::none;
        slot != FixtureTable::none) {
        finder_->clearCache();
        bodies_.invalidate(fixture->GetBody());
        events_.handleDestruction(slot);
    }
    if (chainedDestruction_ != nullptr) chainedDestruction_->SayGoodbye(fixture);
}

// The first listener that is active: skips those of ended attachments.
template <class Listener>
Listener* WorldListener::skipInactive(Listener* current, Listener* WorldListener::*next) {
    for (auto* inactive = dynamic_cast<WorldListener*>(current); inactive != nullptr && !inactive->finder_;
         inactive = dynamic_cast<WorldListener*>(current))
        current = inactive->*next;
    return current;
}

// True if calls to `current` reach this listener through attachments that were made later.
template <class Listener>
bool WorldListener::isReachedBy(Listener* current, Listener* WorldListener::*next) const {
    if (current == this) return true; // the usual case
    for (auto* link = dynamic_cast<WorldListener*>(current); link != nullptr;
         link = dynamic_cast<WorldListener*>(link->*next))
        if (link == this) return true;
    return false;
}

void WorldListener::install(b2World& world) {
    if (b2ContactListener* current = world.GetContactManager().m_contactListener;
        !isReachedBy(current, &WorldListener::chained_)) {
        chained_ = skipInactive(current, &WorldListener::chained_);
        isAlone_ = finder_ && (chained_ == nullptr || typeid(*chained_) == typeid(b2ContactListener));
        world.SetContactListener(this);
        if (finder_) finder_->clearCache();
    }
    if (b2DestructionListener* current = destructionListenerOf(world);
        !isReachedBy(current, &WorldListener::chainedDestruction_)) {
        chainedDestruction_ = skipInactive(current, &WorldListener::chainedDestruction_);
        world.SetDestructionListener(this);
    }
}

bool WorldListener::isInstalled(b2World& world) const {
    return isReachedBy(destructionListenerOf(world), &WorldListener::chainedDestruction_);
}

bool WorldListener::remove(b2World& world) {
    b2ContactListener* const contacts = world.GetContactManager().m_contactListener;
    b2DestructionListener* const destructions = destructionListenerOf(world);
    if (contacts == this) world.SetContactListener(chained_);
    if (destructions == this) world.SetDestructionListener(chainedDestruction_);
    return contacts == this && destructions == this;
}

} // namespace physvib
