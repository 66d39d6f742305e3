// SPDX-License-Identifier: MIT
// Jolt 5: construct PhysVibJolt, give each body a number (set, from 0), and call update() instead of
// PhysicsSystem::Update. It is the system's listener of contacts: give it your own, which it calls. Contacts
// are those in space; the field is the x, y plane, and z goes across it. C++17 and later.
#pragma once
#include <Jolt/Jolt.h>

#include <Jolt/Physics/Body/Body.h>
#include <Jolt/Physics/Body/BodyLock.h>
#include <Jolt/Physics/Collision/ContactListener.h>
#include <Jolt/Physics/PhysicsSystem.h>
#include <algorithm>
#include <cmath>
#include <mutex>
#include <physvib/physvib.h>
#include <string>
#include <unordered_map>
#include <vector>

/// Must exist while the system steps; one thread, whatever Jolt's jobs are.
class PhysVibJolt final : public JPH::ContactListener {
public:
    /// All arguments outlive this object. `own`: the game's listener, which is called first; null: none.
    PhysVibJolt(JPH::PhysicsSystem& system, physvib_world name, JPH::ContactListener* own = nullptr)
        : system_(system)
        , name_(name)
        , own_(own) {
        system.SetContactListener(this);
    }
    ~PhysVibJolt() override { system_.SetContactListener(own_); }
    PhysVibJolt(const PhysVibJolt&) = delete;
    PhysVibJolt& operator=(const PhysVibJolt&) = delete;

    /// The first error so far, e.g. a touching body without a number; empty: none.
    const std::string& error() const { return error_; }

    /// Sets a body's values (from physvib_body_init); mass and gravity factor are Jolt's of the step.
    void set(JPH::BodyID id, int number, physvib_body values) {
        check(physvib_world_set_body(name_, number, &values));
        bodies_[key(id)] = {id, number, values, {}, {}, {}};
    }
    /// Call before the body is destroyed.
    void remove(JPH::BodyID id) {
        const auto found = bodies_.find(key(id));
        if (found == bodies_.end()) return;
        check(physvib_world_remove_body(name_, found->second.number));
        bodies_.erase(found);
    }

    /// One collision step of `seconds`.
    JPH::EPhysicsUpdateError update(float seconds, JPH::TempAllocator* memory, JPH::JobSystem* jobs) {
        begin(seconds);
        const JPH::EPhysicsUpdateError result = system_.Update(seconds, 1, memory, jobs);
        end();
        return result;
    }

    /// Why nothing is felt since the last call, in one sentence: error(), or what physvib_world_explain says
    /// after a look at all bodies.
    std::string explain() const {
        if (!error_.empty()) return error_;
        for (const auto& [_, held] : bodies_)
            if (const JPH::Body* body = find(held.id); body != nullptr) {
                if (body->IsSensor()) physvib_world_note(name_, held.number, PHYSVIB_NOTE_SENSOR);
                if (!body->IsInBroadPhase()) physvib_world_note(name_, held.number, PHYSVIB_NOTE_DISABLED);
                if (body->IsDynamic() && !body->IsActive())
                    physvib_world_note(name_, held.number, PHYSVIB_NOTE_ASLEEP);
            }
        char text[512] = "";
        physvib_world_explain(name_, text, sizeof text);
        return text;
    }

    // Of Jolt, on its threads: the game's listener first, then what touches is kept.
    /// Jolt's.
    JPH::ValidateResult OnContactValidate(const JPH::Body& a, const JPH::Body& b, JPH::RVec3Arg offset,
                                          const JPH::CollideShapeResult& found) override {
        return own_ != nullptr ? own_->OnContactValidate(a, b, offset, found)
                               : JPH::ContactListener::OnContactValidate(a, b, offset, found);
    }
    /// Jolt's.
    void OnContactAdded(const JPH::Body& a, const JPH::Body& b, const JPH::ContactManifold& manifold,
                        JPH::ContactSettings& settings) override {
        if (own_ != nullptr) own_->OnContactAdded(a, b, manifold, settings);
        keep(a, b, manifold, settings);
    }
    /// Jolt's.
    void OnContactPersisted(const JPH::Body& a, const JPH::Body& b, const JPH::ContactManifold& manifold,
                            JPH::ContactSettings& settings) override {
        if (own_ != nullptr) own_->OnContactPersisted(a, b, manifold, settings);
        keep(a, b, manifold, settings);
    }
    /// Jolt's.
    void OnContactRemoved(const JPH::SubShapeIDPair& pair) override {
        if (own_ != nullptr) own_->OnContactRemoved(pair);
    }

private:
    struct Vector { // doubles, whatever Jolt's are
        double x = 0, y = 0, z = 0;
        Vector() = default;
        Vector(double ofX, double ofY, double ofZ)
            : x(ofX)
            , y(ofY)
            , z(ofZ) {}
        template <class Jolts>
        explicit Vector(Jolts v)
            : Vector(v.GetX(), v.GetY(), v.GetZ()) {}
        Vector plus(const Vector& b, double times) const {
            return {x + times * b.x, y + times * b.y, z + times * b.z};
        }
        double dot(const Vector& b) const { return x * b.x + y * b.y + z * b.z; }
        Vector cross(const Vector& b) const {
            return {y * b.z - z * b.y, z * b.x - x * b.z, x * b.y - y * b.x};
        }
        double length() const { return std::sqrt(dot(*this)); }
    };
    struct Motion {
        Vector at, velocity, spin, free; // free: what the velocity becomes if nothing is touched
        double falls = 0;                // share of gravity
    };
    struct Held {
        JPH::BodyID id;
        int number;
        physvib_body values;
        Motion before;
        Vector lost, lostTurn;
    };
    struct Touch {
        JPH::BodyID a, b;
        Vector at, normal;
        double gap, restitution;
    };

    static std::uint32_t key(JPH::BodyID id) { return id.GetIndexAndSequenceNumber(); }
    const JPH::Body* find(JPH::BodyID id) const {
        return system_.GetBodyLockInterfaceNoLock().TryGetBody(id);
    }

    void keep(const JPH::Body& a, const JPH::Body& b, const JPH::ContactManifold& manifold,
              const JPH::ContactSettings& settings) {
        if (settings.mIsSensor) return;
        const std::lock_guard lock{touching_};
        for (JPH::uint i = 0; i < manifold.mRelativeContactPointsOn1.size(); ++i) {
            const Vector on1(manifold.GetWorldSpaceContactPointOn1(i)),
                on2(manifold.GetWorldSpaceContactPointOn2(i)), normal(manifold.mWorldSpaceNormal);
            touches_.push_back({a.GetID(), b.GetID(), on1, normal, on2.plus(on1, -1).dot(normal),
                                static_cast<double>(settings.mCombinedRestitution)});
        }
    }

    void begin(double seconds) {
        seconds_ = seconds;
        const Vector g(system_.GetGravity());
        check(physvib_world_begin_step(name_, seconds, g.length()));
        for (auto& [_, held] : bodies_)
            if (const JPH::Body* body = find(held.id); body != nullptr) move(held, *body, g);
    }
    void move(Held& held, const JPH::Body& body, const Vector& g) {
        const bool moves = body.IsDynamic();
        const JPH::MotionProperties* const motion = moves ? body.GetMotionProperties() : nullptr;
        const double mass = moves ? 1.0 / static_cast<double>(motion->GetInverseMass()) : 0.0,
                     scale = moves ? static_cast<double>(motion->GetGravityFactor()) : 1.0;
        if (mass != held.values.mass_kg || scale != held.values.gravity_scale) {
            held.values.mass_kg = mass, held.values.gravity_scale = scale;
            check(physvib_world_set_body(name_, held.number, &held.values));
        }
        Motion now{Vector(body.GetCenterOfMassPosition()),
                   Vector(body.GetLinearVelocity()),
                   Vector(body.GetAngularVelocity()),
                   {},
                   moves && body.IsActive() ? scale : 0.0};
        const Motion& last = held.before;
        if (now.at.plus(last.at, -1).length() > 0 || now.velocity.plus(last.velocity, -1).length() > 0)
            held.lost = held.lostTurn = {}; // the game has moved it
        now.free = now.velocity.plus(g, now.falls * seconds_);
        held.before = now;
        double inverse[6] = {};
        if (moves) {
            const JPH::Mat44 i = body.GetInverseInertia();
            const Vector x(i.GetAxisX()), y(i.GetAxisY()), z(i.GetAxisZ());
            const double of[] = {x.x, y.y, z.z, x.y, x.z, y.z};
            std::copy(of, of + 6, inverse);
        }
        const double at[] = {now.at.x, now.at.y, now.at.z}, v[] = {now.free.x, now.free.y, now.free.z},
                     spin[] = {now.spin.x, now.spin.y, now.spin.z};
        check(physvib_world_move_in_space(name_, held.number, at, v, spin, inverse));
    }

    void end() {
        for (auto& [_, held] : bodies_)
            if (const JPH::Body* body = find(held.id); body != nullptr && body->IsDynamic()) {
                const Vector velocity(body->GetLinearVelocity()), turns(body->GetAngularVelocity());
                const double v[] = {velocity.x, velocity.y, velocity.z}, spin[] = {turns.x, turns.y, turns.z};
                check(physvib_world_moved_in_space(name_, held.number, v, spin));
            } else if (body != nullptr) { // what is moved by its place has its speed within the step
                held.before.velocity = Vector(body->GetLinearVelocity());
                held.before.spin = Vector(body->GetAngularVelocity());
            }
        for (const Touch& touch : touches_) tell(touch);
        touches_.clear();
        for (auto& [_, held] : bodies_)
            if (const JPH::Body* body = find(held.id); body != nullptr && body->IsDynamic())
                stop(held, *body);
        last_ = seconds_;
        check(physvib_world_end_step(name_));
    }

    Vector speedAt(const Held& held, const Vector& at) const {
        return held.before.velocity.plus(held.before.spin.cross(at.plus(held.before.at, -1)), 1);
    }
    double lostAt(const Held& held, const Touch& touch) const {
        return held.lost.plus(held.lostTurn.cross(touch.at.plus(held.before.at, -1)), 1).dot(touch.normal);
    }
    // Jolt looks ahead: what will not touch in this step is left out.
    void tell(const Touch& touch) {
        const auto a = bodies_.find(key(touch.a)), b = bodies_.find(key(touch.b));
        if (a == bodies_.end() || b == bodies_.end()) {
            if (error_.empty()) error_ = "expected a number (set) of every body that touches";
            return;
        }
        const Vector g(system_.GetGravity());
        const double
            speed = speedAt(a->second, touch.at).plus(speedAt(b->second, touch.at), -1).dot(touch.normal),
            pull = (a->second.before.falls - b->second.before.falls) * g.dot(touch.normal),
            least = static_cast<double>(system_.GetPhysicsSettings().mMinVelocityForRestitution);
        if (touch.gap > std::max(0.0, speed + pull * seconds_) * seconds_ + 1e-6) return;
        const double squared = speed * speed + 2 * pull * std::max(0.0, touch.gap),
                     meets = speed > 0 && squared > 0 ? std::sqrt(squared) : speed,
                     gap = touch.gap + std::min(0.0, lostAt(b->second, touch) - lostAt(a->second, touch));
        physvib_contact contact;
        physvib_contact_init(&contact, sizeof contact);
        contact.a = a->second.number, contact.b = b->second.number;
        contact.x_m = touch.at.x, contact.y_m = touch.at.y, contact.z_m = touch.at.z;
        contact.normal_x = touch.normal.x, contact.normal_y = touch.normal.y,
        contact.normal_z = touch.normal.z;
        contact.approach_m_per_s = meets;
        contact.restitution = meets < least ? 0.0 : std::clamp(touch.restitution, 0.0, 1.0);
        contact.is_soft = PHYSVIB_SOFT;
        contact.point_id = PHYSVIB_POINT_BY_PLACE;
        if (gap < 0 ? speed > 0 : touch.gap > 0 && speed + meets > 0)
            contact.fraction = fraction(gap, speed, pull);
        else
            contact.gap_m = touch.gap, contact.gap_fraction = 0;
        check(physvib_world_touch(name_, &contact));
    }
    // In steps after the start of this one; below 0: in the one before. Velocities change before bodies move.
    double fraction(double gap, double speed, double pull) const {
        const double start = std::max(0.5 * speed, speed + 0.5 * pull * seconds_),
                     root = std::sqrt(std::max(0.0, start * start + 2 * pull * gap)),
                     length = gap < 0 ? last_ : seconds_;
        return length > 0 ? std::clamp(2 * gap / (start + root) / length, -1.0, 2.0) : 0.0;
    }

    // Continuous collision stops a body where it first touches, with the velocity of the step's end; it
    // collides in the next step. What the step would have moved it on is lost, unless contacts may have
    // taken it; less than 5 mm is not stopped.
    void stop(Held& held, const JPH::Body& body) {
        constexpr double slop = 0.005;
        const Vector at(body.GetCenterOfMassPosition()), v(body.GetLinearVelocity());
        const Vector way = Vector().plus(v, seconds_);
        const double path = way.length(), pushed = 0.5 * seconds_ * v.plus(held.before.free, -1).length(),
                     rounding = 1e-6 * (std::abs(at.x) + std::abs(at.y) + std::abs(at.z)),
                     lost = path > 0 ? path - at.plus(held.before.at, -1).dot(way) / path : 0;
        const bool isLost = path >= slop && lost <= path && lost >= slop * path + pushed + rounding;
        const double share = isLost ? lost / path : 0;
        held.lost = Vector().plus(way, share);
        held.lostTurn = Vector().plus(Vector(body.GetAngularVelocity()), share * seconds_);
        held.before.at = at, held.before.velocity = v;
    }

    void check(int code) {
        if (code < 0 && error_.empty()) error_ = physvib_error();
    }

    JPH::PhysicsSystem& system_;
    physvib_world name_;
    JPH::ContactListener* own_;
    std::unordered_map<std::uint32_t, Held> bodies_;
    std::mutex touching_;
    std::vector<Touch> touches_;
    double seconds_ = 0, last_ = 0;
    std::string error_;
};
