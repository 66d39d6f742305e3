// SPDX-License-Identifier: MIT
// The bodies of a world that somebody tells us of, since we cannot look into it.
#pragma once
#include "Contacts/BodyReader.h"
#include "Contacts/ContactFeed.h"
#include "Contacts/IntegerMap.h"
#include <cstdint>
#include <vector>

namespace physvib {

/// Bodies by numbers (>= 0) of the engine's side. M only.
class FedBodies final : public BodyReader {
public:
    /// What contacts, and the stages behind them, call the body of that number.
    static std::uint64_t nameOf(std::int32_t id) noexcept { return static_cast<std::uint64_t>(id) + 1; }

    void set(std::int32_t id, const FedBody& body);
    void move(std::int32_t id, Vector2 centre, const BodyMotion& motion);
    void remove(std::int32_t id);
    /// The motion behind the engine's solver, in this step.
    void moveAfter(std::int32_t id, const BodyMotion& motion);
    /// Whether it has been told in this step, or need not be.
    bool hasAfter(std::int32_t id) const;
    bool isAnyAfter() const noexcept { return isAnyAfter_; }
    void endStep() noexcept { isAnyAfter_ = false, ++age_; }
    const FedBody& told(std::int32_t id) const { return at(nameOf(id)).told; }
    bool has(std::int32_t id) const noexcept { return slots_.find(nameOf(id)) != IntegerMap::none; }

    /// The largest mass of a body that can be moved, kg (m_max of Eq. 5.7).
    double largestMassKg();

    /// How fast B comes towards A at a point, m/s, by the motions told; the normal points from A to B.
    double approach(std::int32_t a, std::int32_t b, Vector2 point, Vector2 normal) const;

    /// The same behind the solver.
    double approachAfter(std::int32_t a, std::int32_t b, Vector2 point, Vector2 normal) const;

    /// How fast the point at which they touch may move along the two surfaces, m/s, at most: the sum of what
    /// each of the bodies moves and turns across the normal.
    double slide(std::int32_t a, std::int32_t b, Vector2 point, Vector2 normal) const;

    /// By how much an impulse of 1 N s at one point, along its normal, changes the speed along the other
    /// normal at the other point, 1/kg; both normals point from A to B.
    double coupling(std::int32_t a, std::int32_t b, Vector2 point, Vector2 normal, Vector2 otherPoint,
                    Vector2 otherNormal) const;

    /// Mass that a blow there has to do with, kg: the impulse by the change of the speed at which the
    /// surfaces meet. Infinite if neither can be moved.
    double effectiveMassKg(std::int32_t a, std::int32_t b, Vector2 point, Vector2 normal) const;

    BodyFacts facts(std::uint64_t body) const override;
    BodyMotion motion(std::uint64_t body) const override { return at(body).motion; }
    BodyMotion motionBefore(std::uint64_t body) const override { return at(body).motion; }
    Vector2 centre(std::uint64_t body) const override { return at(body).centre; }
    Vector2 toWorld(std::uint64_t body, Vector2 ofBody) const override { return at(body).centre + ofBody; }
    double inertia(std::uint64_t body) const override { return at(body).told.inertiaKgSquareMetres; }

private:
    struct Body {
        std::int32_t id;
        FedBody told;
        Vector2 centre;
        BodyMotion motion, after;
        std::uint64_t afterAge = 0; // the step in which `after` was told
    };
    const Body& at(std::uint64_t name) const { return bodies_[static_cast<std::size_t>(slots_.find(name))]; }
    void forgetLargest(const Body& body) noexcept;

    std::vector<Body> bodies_;
    IntegerMap slots_; // by name
    double largestMassKg_ = 0.0;
    bool isLargestKnown_ = true;
    std::uint64_t age_ = 1;
    bool isAnyAfter_ = false;
};

} // namespace physvib
