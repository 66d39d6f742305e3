// SPDX-License-Identifier: MIT
// Reads a b2World's bodies (WorldBodies), and keeps their state at the start of a step (BodySweeps).
#pragma once
#include "Contacts/Impact.h"
#include "Contacts/IndexMaps.h"
#include <algorithm>
#include <array>
#include <box2d/box2d.h>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace physvib {

// Access to private members of Box2D 2.4 that have no getter: how far a step has advanced a body, and a
// world's destruction listener.

namespace box2dPrivates {

struct Sweep {
    using Member = b2Sweep b2Body::*;
    friend Member member(Sweep);
};
struct Listener {
    using Member = b2DestructionListener* b2World::*;
    friend Member member(Listener);
};
template <class Tag, typename Tag::Member Pointer>
struct Reveal {
    friend typename Tag::Member member(Tag) { return Pointer; }
};
// Names in an explicit instantiation are exempt from access control (C++20 [temp.spec]): no cast, no assumed
// layout.
template struct Reveal<Sweep, &b2Body::m_sweep>;
template struct Reveal<Listener, &b2World::m_destructionListener>;

} // namespace box2dPrivates

/// 0 to 1: how far Box2D's time-of-impact solver last advanced the body; valid until that solver starts
/// again. World thread (M).
inline float advancedFractionOf(const b2Body& body) noexcept {
    return (body.*member(box2dPrivates::Sweep{})).alpha0;
}

/// The world's destruction listener; nullptr if there is none. World thread (M).
inline b2DestructionListener* destructionListenerOf(b2World& world) noexcept {
    return world.*member(box2dPrivates::Listener{});
}

/// The address of a body, fixture or contact, as the number by which later stages identify it.
template <class T>
std::uint64_t idOf(const T& object) noexcept {
    return reinterpret_cast<std::uintptr_t>(&object);
}
inline const b2Body& bodyOf(std::uint64_t id) noexcept {
    return *reinterpret_cast<const b2Body*>(static_cast<std::uintptr_t>(id));
}

inline Vector2 toVector(b2Vec2 v) noexcept { return {v.x, v.y}; }

inline BodyMotion motionOf(const b2Body& body) noexcept {
    return {toVector(body.GetLinearVelocity()), body.GetAngularVelocity()};
}

inline BodyFacts factsOf(const b2Body& body) noexcept {
    return {idOf(body), body.GetMass(), body.GetGravityScale(), body.GetType() == b2_dynamicBody,
            body.IsEnabled()};
}

/// Centre of mass of the fixture alone, in its body's frame.
inline Vector2 centreOf(const b2Fixture& fixture) {
    b2MassData mass;
    fixture.GetMassData(&mass);
    return toVector(mass.center);
}

/// Body states at the beginning of a step, and how far Box2D has advanced a body when it reports a contact.
/// Contacts of the regular solver are found at the beginning of a step, those of the time-of-impact solver at
/// the time to which the body has been moved. World thread (M).
class BodySweeps {
public:
    /// Call before b2World::Step. Visits each body once (Box2D does so several times) and no fixture.
    /// Allocates if the world has grown.
    void beginStep(const b2World& world, double stepSeconds) {
        lastStepSeconds_ = std::exchange(stepSeconds_, stepSeconds);
        // one more place than bodies: the last has no key
        sweeps_.resize(static_cast<std::size_t>(world.GetBodyCount()) + 1);
        Sweep* next = sweeps_.data();
        float largestKg = 0.0F;
        bool isKnown = true; // usually bodies and order are those of the last step
        for (const b2Body* body = world.GetBodyList(); body != nullptr; body = body->GetNext()) {
            if (body->GetType() == b2_staticBody) {
                isKnown &= next->key == (idOf(*body) | staticBit);
                next++->key = idOf(*body) | staticBit;
                continue;
            }
            isKnown &= next->key == idOf(*body);
            next->key = idOf(*body);
            next->centre = body->GetWorldCenter();
            next++->start = motionOf(*body);
            if (body->IsEnabled()) largestKg = std::max(largestKg, body->GetMass()); // kinematic: 0
        }
        largestMassKg_ = static_cast<double>(largestKg);
        if (isKnown && next->key == 0) return;
        for (; next != sweeps_.data() + sweeps_.size(); ++next) next->key = 0;
        ++listVersion_;
        indexBodies();
    }

    /// A number that changes whenever beginStep() has found other bodies, or another order.
    std::uint64_t listVersion() const noexcept { return listVersion_; }

    /// Reserves memory, so that steps with that many bodies and a few more do not allocate.
    void reserve(std::size_t bodies) {
        sweeps_.reserve(bodies + bodies / 4 + 3);
        indices_ = IntegerMap{sweeps_.capacity()};
    }

    double stepSeconds() const noexcept { return stepSeconds_; }
    double lastStepSeconds() const noexcept { return lastStepSeconds_; } ///< before it; 0: none

    /// The largest mass of an enabled dynamic body, kg (m_max of Eq. 5.7).
    double largestMassKg() const noexcept { return largestMassKg_; }

    /// In BeginContact, PreSolve and EndContact: how far this body has been advanced, 0 (start) to 1 (end of
    /// the step).
    double fraction(const b2Body& body) const noexcept {
        const Sweep* sweep = find(body);
        // otherwise Box2D's value is from an earlier step
        const bool hasMoved = sweep != nullptr && body.GetWorldCenter() != sweep->centre;
        return hasMoved ? static_cast<double>(advancedFractionOf(body)) : 0.0;
    }

    /// Hash of a world's list of bodies and their order (different lists collide with a probability of
    /// 2^-64).
    static std::uint64_t listHashOf(const b2World& world) noexcept {
        std::uint64_t hash = static_cast<std::uint64_t>(world.GetBodyCount()) + 1; // never 0
        for (const b2Body* body = world.GetBodyList(); body != nullptr; body = body->GetNext())
            hash = (hash ^ idOf(*body)) * 0x9E3779B97F4A7C15U;
        return hash;
    }

    /// Velocity before the step; for a body that was created later, its present one.
    BodyMotion startMotion(const b2Body& body) const noexcept {
        const Sweep* sweep = find(body);
        return sweep == nullptr ? motionOf(body) : sweep->start;
    }

private:
    static constexpr std::uint64_t staticBit = 1; // added to the address, which is even
    struct Sweep {
        std::uint64_t key = 0; // the body's address, used as such only; 0: none
        b2Vec2 centre;
        BodyMotion start;
    };
    const Sweep* find(const b2Body& body) const noexcept {
        const std::int32_t i = indices_.find(idOf(body));
        return i == IntegerMap::none ? nullptr : &sweeps_[static_cast<std::size_t>(i)];
    }
    void indexBodies() {
        indices_.clear();
        for (std::size_t i = 0; sweeps_[i].key != 0; ++i)
            if ((sweeps_[i].key & staticBit) == 0) indices_.set(sweeps_[i].key, static_cast<std::int32_t>(i));
    }

    double stepSeconds_ = 0.0, lastStepSeconds_ = 0.0;
    double largestMassKg_ = 0.0;
    std::vector<Sweep> sweeps_; // of all bodies (static ones without a state), then unused
    IntegerMap indices_;        // indices into sweeps_, by body that is not static
    std::uint64_t listVersion_ = 1;
};

/// Bodies are identified by their addresses. Box2D has no callback for a body whose fixtures were destroyed
/// before it, so a stored address may be invalid; it is looked up in the world's list before it is
/// dereferenced. A destroyed body is reported as static, without mass, disabled, at the origin. World thread
/// (M) only, within a step or right after it.
class WorldBodies final : public BodyReader {
public:
    WorldBodies(const b2World& world, const BodySweeps& sweeps) noexcept
        : world_(world)
        , sweeps_(sweeps) {}

    /// Call it when the world's owner may have destroyed bodies, except the two given. The next access to
    /// another one costs one pass over the world's list.
    void invalidate(const b2Body* a = nullptr, const b2Body* b = nullptr) noexcept {
        isListUnchanged_ = isIndexCurrent_ = false;
        knownBodies_ = {a, b};
    }
    /// Replaces invalidate() right after BodySweeps::beginStep(), which knows whether the list has changed.
    void beginStep() noexcept {
        invalidate();
        isListUnchanged_ = true;
        isIndexCurrent_ = indexedVersion_ == sweeps_.listVersion();
    }
    bool has(std::uint64_t body) const {
        if (!isIndexCurrent_) {
            for (const b2Body* const present : knownBodies_)
                if (present != nullptr && idOf(*present) == body) return true;
            refreshIndex();
        }
        return bodies_.find(body) != IntegerMap::none;
    }

    BodyFacts facts(std::uint64_t body) const override {
        return has(body) ? factsOf(bodyOf(body)) : BodyFacts{body, 0.0, 1.0F, false, false};
    }
    BodyMotion motion(std::uint64_t body) const override {
        return has(body) ? motionOf(bodyOf(body)) : BodyMotion{};
    }
    BodyMotion motionBefore(std::uint64_t body) const override {
        return has(body) ? sweeps_.startMotion(bodyOf(body)) : BodyMotion{};
    }
    Vector2 centre(std::uint64_t body) const override {
        return has(body) ? toVector(bodyOf(body).GetWorldCenter()) : Vector2{};
    }
    Vector3 toWorld(std::uint64_t body, Vector2 local) const override {
        return has(body) ? Vector3(toVector(bodyOf(body).GetWorldPoint({local.x, local.y}))) : local;
    }
    double inertia(std::uint64_t body) const override {
        if (!has(body)) return 0.0;
        const b2Body& b = bodyOf(body);
        return b.GetInertia() - b.GetMass() * b.GetLocalCenter().LengthSquared();
    }

private:
    // If the list has the same addresses in the same order, the index is still valid, even if a body was
    // replaced by another at its address.
    [[gnu::noinline]] void refreshIndex() const {
        isIndexCurrent_ = true;
        indexedVersion_ = isListUnchanged_ ? sweeps_.listVersion() : 0;
        const std::uint64_t hash = BodySweeps::listHashOf(world_);
        if (hash == listHash_) return;
        listHash_ = hash;
        bodies_.clear();
        for (const b2Body* body = world_.GetBodyList(); body != nullptr; body = body->GetNext())
            bodies_.set(idOf(*body), 0);
    }

    const b2World& world_;
    const BodySweeps& sweeps_;
    std::array<const b2Body*, 2> knownBodies_{};
    mutable bool isIndexCurrent_ = false;
    bool isListUnchanged_ = false;             // nothing has been destroyed since the sweeps' beginStep()
    mutable std::uint64_t indexedVersion_ = 0; // the sweeps' version of the indexed list; 0: not known
    mutable std::uint64_t listHash_ = 0;       // hash of that list
    mutable IntegerMap bodies_;                // bodies that exist
};

} // namespace physvib
