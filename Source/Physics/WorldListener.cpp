// SPDX-License-Identifier: MIT
// A link in the chain of a world's listeners.
#include "Physics/WorldListener.h"
#include "Physics/BoxPrivates.h"
#include "Physics/WorldNames.h"
#include <typeinfo>
#include <utility>

namespace physvib {

/// A listener of the game may hand calls on to the one it found, which may be us: each call is taken once.
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
        // cut by the game, which may have destroyed others unheard
        if (!a.GetWorld()->IsLocked()) bodies_.doubt(&a, &b);
        finder_->end(*contact);
    }
    if (chained_ != nullptr) chained_->EndContact(contact);
}

void WorldListener::PreSolve(b2Contact* contact, const b2Manifold* oldManifold) {
    if (isAlone_ && finder_) return finder_->look(*contact, *oldManifold);
    const Call call{*this, contact};
    if (!call) return;
    if (chained_ != nullptr) chained_->PreSolve(contact, oldManifold); // it may switch the contact off
    if (finder_) finder_->look(*contact, *oldManifold);
}

void WorldListener::PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) {
    if (isAlone_ && finder_) return finder_->push(*contact, *impulse);
    const Call call{*this, contact};
    if (!call) return;
    if (finder_) finder_->push(*contact, *impulse);
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
        bodies_.doubt(fixture->GetBody());
        events_.vanish(slot);
    }
    if (chainedEnds_ != nullptr) chainedEnds_->SayGoodbye(fixture);
}

// What a world's listener really is: those of attachments that have ended are passed over.
template <class Listener>
Listener* WorldListener::behindDeaf(Listener* found, Listener* WorldListener::*next) {
    for (auto* deaf = dynamic_cast<WorldListener*>(found); deaf != nullptr && !deaf->finder_;
         deaf = dynamic_cast<WorldListener*>(found))
        found = deaf->*next;
    return found;
}

// Whether calls of `found` come here anyway, through attachments that were made later.
template <class Listener>
bool WorldListener::isReachedBy(Listener* found, Listener* WorldListener::*next) const {
    if (found == this) return true; // the rule
    for (auto* link = dynamic_cast<WorldListener*>(found); link != nullptr;
         link = dynamic_cast<WorldListener*>(link->*next))
        if (link == this) return true;
    return false;
}

void WorldListener::install(b2World& world) {
    if (b2ContactListener* found = world.GetContactManager().m_contactListener;
        !isReachedBy(found, &WorldListener::chained_)) {
        chained_ = behindDeaf(found, &WorldListener::chained_);
        isAlone_ = chained_ == nullptr || typeid(*chained_) == typeid(b2ContactListener);
        world.SetContactListener(this);
        if (finder_) finder_->forgetContacts();
    }
    if (b2DestructionListener* found = destructionListenerOf(world);
        !isReachedBy(found, &WorldListener::chainedEnds_)) {
        chainedEnds_ = behindDeaf(found, &WorldListener::chainedEnds_);
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
