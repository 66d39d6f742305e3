// SPDX-License-Identifier: MIT
// Bodies of a world whose engine PhysVib cannot read: the caller reports their masses and motions.
#pragma once
#include "Contacts/BodyReader.h"
#include "Contacts/ContactFeed.h"
#include "Contacts/IntegerMap.h"
#include "Contacts/InverseInertia.h"
#include <cstdint>
#include <optional>
#include <vector>

namespace physvib {

/// Bodies by numbers (>= 0) of the engine's side. M only.
class ReportedBodies final : public BodyReader {
public:
    /// The number by which contacts and later stages identify that body.
    static std::uint64_t idOf(std::int32_t id) noexcept { return static_cast<std::uint64_t>(id) + 1; }

    void set(std::int32_t id, const FedBody& body);
    /// `inverse`: in the world's axes; without it, FedBody's moment of inertia counts about every axis.
    void move(std::int32_t id, Vector3 centre, const SpaceMotion& motion,
              const std::optional<InverseInertia>& inverse = {});
    void remove(std::int32_t id);
    /// The motion after the engine's solver, in this step.
    void moveAfter(std::int32_t id, const SpaceMotion& motion);
    /// True if that motion was reported in this step, or is not needed.
    bool hasAfter(std::int32_t id) const;
    bool isAnyAfter() const noexcept { return isAnyAfter_; }
    void endStep() noexcept { isAnyAfter_ = false, ++age_; }
    const FedBody& told(std::int32_t id) const { return at(idOf(id)).told; }
    bool has(std::int32_t id) const noexcept { return slots_.find(idOf(id)) != IntegerMap::none; }

    /// The largest mass of a movable body, kg (m_max of Eq. 5.7).
    double largestMassKg();

    /// Speed at which B approaches A at a point, m/s, from the reported motions; the normal points from A to
    /// B.
    double approach(std::int32_t a, std::int32_t b, Vector3 point, Vector3 normal) const;

    /// The same after the solver.
    double approachAfter(std::int32_t a, std::int32_t b, Vector3 point, Vector3 normal) const;

    /// Upper bound of the speed at which the contact point moves along the two surfaces, m/s: the sum of each
    /// body's motion and rotation across the normal.
    double slide(std::int32_t a, std::int32_t b, Vector3 point, Vector3 normal) const;

    /// Change of the speed along `otherNormal` at `otherPoint` by an impulse of 1 N s along `normal` at
    /// `point`, 1/kg. Both normals point from A to B.
    double coupling(std::int32_t a, std::int32_t b, Vector3 point, Vector3 normal, Vector3 otherPoint,
                    Vector3 otherNormal) const;

    /// How easily a body turns; all 0 if it is not movable, or its moment of inertia is not known.
    InverseInertia inverseInertia(std::int32_t id) const;
    /// Lever of a force along `normal` at `point`, about the body's centre of mass, m.
    Vector3 lever(std::int32_t id, Vector3 point, Vector3 normal) const {
        return cross(point - at(idOf(id)).centre, normal);
    }

    /// Effective mass at a contact point, kg: impulse per change of the approach speed. Infinite if neither
    /// body is movable.
    double effectiveMassKg(std::int32_t a, std::int32_t b, Vector3 point, Vector3 normal) const;

    BodyFacts facts(std::uint64_t body) const override;
    // The part in the plane: release timing alone asks for motions, and feeds do not have it.
    BodyMotion motion(std::uint64_t body) const override {
        const SpaceMotion& motion = at(body).motion;
        return {inPlane(motion.metresPerSecond), motion.radiansPerSecond.z};
    }
    BodyMotion motionBefore(std::uint64_t body) const override { return motion(body); }
    Vector2 centre(std::uint64_t body) const override { return inPlane(at(body).centre); }
    Vector3 toWorld(std::uint64_t body, Vector2 ofBody) const override { return at(body).centre + ofBody; }
    double inertia(std::uint64_t body) const override { return at(body).told.inertiaKgSquareMetres; }

private:
    struct Body {
        std::int32_t id;
        FedBody told;
        Vector3 centre;
        SpaceMotion motion, after;
        std::optional<InverseInertia> inverse{};
        std::uint64_t afterAge = 0; // the step in which `after` was reported
    };
    const Body& at(std::uint64_t name) const { return bodies_[static_cast<std::size_t>(slots_.find(name))]; }
    static double turning(const Body& body, Vector3 lever, Vector3 other) noexcept;
    void forgetLargest(const Body& body) noexcept;

    std::vector<Body> bodies_;
    IntegerMap slots_; // by idOf()
    double largestMassKg_ = 0.0;
    bool isLargestKnown_ = true;
    std::uint64_t age_ = 1;
    bool isAnyAfter_ = false;
};

} // namespace physvib
