// SPDX-License-Identifier: MIT
// Box2D listener that is one link in a chain of listeners.
#include "Physics/WorldListener.h"
#include "Physics/WorldBodies.h"
#include <typeinfo>
#include <utility>

namespace physvib {

/// A game's listener may forward calls to the listener that it replaced, which may be this one: each call is
/// processed once.
class WorldListener::Call {
public:
    Call(WorldListener& listener, const void* about) noexcept
        : callFor_(listener.callFor_)
        , outer_(std::exchange(listener.callFor_, about))
        , isFirst_(outer_ != about) {}
    ~Call() { callFor_ = outer_; }
    Call(const Call&) = delete;
    Call& operator=(const Call&) = delete;
    explicit operator bool() const noexcept { return isFirst_; }

private:
    const void*& callFor_;
    const void* outer_;
    bool isFirst_;
};

void WorldListener::BeginContact(b2Contact* contact) {
    const Call call{*this, contact};
    if (!call) return;
    if (finder_) finder_->begin(*contact);
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
    if (isAlone_ && finder_) return finder_->onPreSolve(*contact, *oldManifold);
    const Call call{*this, contact};
    if (!call) return;
    if (chained_ != nullptr) chained_->PreSolve(contact, oldManifold); // it may disable the contact
    if (finder_) finder_->onPreSolve(*contact, *oldManifold);
}

void WorldListener::PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) {
    if (isAlone_ && finder_) return finder_->onPostSolve(*contact, *impulse);
    const Call call{*this, contact};
    if (!call) return;
    if (finder_) finder_->onPostSolve(*contact, *impulse);
    if (chained_ != nullptr) chained_->PostSolve(contact, impulse);
}

void WorldListener::SayGoodbye(b2Joint* joint) {
    const Call call{*this, joint};
    if (call && chainedEnds_ != nullptr) chainedEnds_->SayGoodbye(joint);
}

void WorldListener::SayGoodbye(b2Fixture* fixture) {
    const Call call{*this, fixture};
    if (!call) return;
    if (const std::int32_t slot = finder_ ? finder_->find(*fixture) : FixtureTable::none;
        slot != FixtureTable::none) {
        finder_->forgetContacts();
        bodies_.invalidate(fixture->GetBody());
        events_.vanish(slot);
    }
    if (chainedEnds_ != nullptr) chainedEnds_->SayGoodbye(fixture);
}

// The first listener that is active: skips those of ended attachments.
template <class Listener>
Listener* WorldListener::skipInactive(Listener* found, Listener* WorldListener::*next) {
    for (auto* deaf = dynamic_cast<WorldListener*>(found); deaf != nullptr && !deaf->finder_;
         deaf = dynamic_cast<WorldListener*>(found))
        found = deaf->*next;
    return found;
}

// True if calls to `found` reach this listener through attachments that were made later.
template <class Listener>
bool WorldListener::isReachedBy(Listener* found, Listener* WorldListener::*next) const {
    if (found == this) return true; // the usual case
    for (auto* link = dynamic_cast<WorldListener*>(found); link != nullptr;
         link = dynamic_cast<WorldListener*>(link->*next))
        if (link == this) return true;
    return false;
}

void WorldListener::install(b2World& world) {
    if (b2ContactListener* found = world.GetContactManager().m_contactListener;
        !isReachedBy(found, &WorldListener::chained_)) {
        chained_ = skipInactive(found, &WorldListener::chained_);
        isAlone_ = chained_ == nullptr || typeid(*chained_) == typeid(b2ContactListener);
        world.SetContactListener(this);
        if (finder_) finder_->forgetContacts();
    }
    if (b2DestructionListener* found = destructionListenerOf(world);
        !isReachedBy(found, &WorldListener::chainedEnds_)) {
        chainedEnds_ = skipInactive(found, &WorldListener::chainedEnds_);
        world.SetDestructionListener(this);
    }
}

bool WorldListener::isInstalled(b2World& world) const {
    return isReachedBy(destructionListenerOf(world), &WorldListener::chainedEnds_);
}

bool WorldListener::remove(b2World& world) {
    b2ContactListener* const contacts = world.GetContactManager().m_contactListener;
    b2DestructionListener* const ends = destructionListenerOf(world);
    if (contacts == this) world.SetContactListener(chained_);
    if (ends == this) world.SetDestructionListener(chainedEnds_);
    return contacts == this && ends == this;
}

} // namespace physvib
