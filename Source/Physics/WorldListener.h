// SPDX-License-Identifier: MIT
// Box2D's callbacks: taken by the attachment, and handed on to the game's own listeners as they are.
#pragma once
#include "Physics/BlowFinder.h"
#include "Physics/WorldBodies.h"
#include <box2d/box2d.h>
#include <memory>

namespace physvib {

/// Listens to one b2World, and hands every call on to the listeners that were there before.
///
/// A world keeps bare pointers to its listeners and tells nobody when it ends. So a listener is only
/// destroyed once its world is known to have another one (`remove`); an attachment that ends without that
/// leaves it behind, deaf, handing on calls. M only.
class WorldListener final : public b2ContactListener, public b2DestructionListener {
public:
    WorldListener(ContactEvents& events, BodySweeps& sweeps, WorldBodies& bodies)
        : events_(events)
        , bodies_(bodies)
        , finder_(std::make_unique<BlowFinder>(events, sweeps)) {}
    WorldListener(const WorldListener&) = delete;
    WorldListener& operator=(const WorldListener&) = delete;

    /// Becomes the world's listener, or is again after a game has set another or none; what it finds is
    /// called as well.
    void install(b2World& world);

    /// Whether the world tells it what is destroyed.
    bool isInstalled(b2World& world) const;

    /// Gives the world back what it had, unless somebody has set something else that may call it: then false.
    bool remove(b2World& world);

    /// From now on it hands calls on, and touches nothing else.
    void deafen() noexcept { finder_.reset(); }

    BlowFinder& finder() noexcept { return *finder_; }

    void BeginContact(b2Contact* contact) override;
    void EndContact(b2Contact* contact) override;
    void PreSolve(b2Contact* contact, const b2Manifold* oldManifold) override;
    void PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) override;
    void SayGoodbye(b2Joint* joint) override;
    void SayGoodbye(b2Fixture* fixture) override;

private:
    class Call;
    template <class Listener>
    static Listener* behindDeaf(Listener* found, Listener* WorldListener::*next);
    template <class Listener>
    bool isReachedBy(Listener* found, Listener* WorldListener::*next) const;

    ContactEvents& events_;
    WorldBodies& bodies_;
    std::unique_ptr<BlowFinder> finder_; // none: deaf
    b2ContactListener* chained_ = nullptr;
    bool isAlone_ = false; // nothing to hand on: there is no other, or only Box2D's own, which does nothing
    b2DestructionListener* chainedEnds_ = nullptr;
    const void* callFor_ = nullptr; // what the call that is being handed on is about
};

} // namespace physvib
