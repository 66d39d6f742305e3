// SPDX-License-Identifier: MIT
// Listener that receives Box2D's callbacks for an attachment and forwards them to the game's own listeners.
#pragma once
#include "Physics/CollisionFinder.h"
#include "Physics/WorldBodies.h"
#include <box2d/box2d.h>
#include <memory>

namespace physvib {

/// Listens to one b2World, and forwards every call to the listeners that were set before.
///
/// A world keeps bare pointers to its listeners and does not announce its destruction. So a listener may be
/// destroyed only once its world is known to have another one (`remove`); otherwise the attachment leaves it
/// behind, deactivated and forwarding calls. World thread (M) only.
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
    void deactivate() noexcept { finder_.reset(); }

    CollisionFinder& finder() noexcept { return *finder_; }

    void BeginContact(b2Contact* contact) override;
    void EndContact(b2Contact* contact) override;
    void PreSolve(b2Contact* contact, const b2Manifold* oldManifold) override;
    void PostSolve(b2Contact* contact, const b2ContactImpulse* impulse) override;
    void SayGoodbye(b2Joint* joint) override;
    void SayGoodbye(b2Fixture* fixture) override;

private:
    class Call;
    template <class Listener>
    static Listener* skipInactive(Listener* found, Listener* WorldListener::*next);
    template <class Listener>
    bool isReachedBy(Listener* found, Listener* WorldListener::*next) const;

    ContactEvents& events_;
    WorldBodies& bodies_;
    std::unique_ptr<CollisionFinder> finder_; // null: deactivated
    b2ContactListener* chained_ = nullptr;
    bool isAlone_ = false; // nothing to forward to: no other listener, or Box2D's own, which does nothing
    b2DestructionListener* chainedEnds_ = nullptr;
    const void* callFor_ = nullptr; // object of the call that is being forwarded
};

} // namespace physvib
