// SPDX-License-Identifier: MIT
// SceneWorld, the Box2D world of a scene with scripted and live actions; and its parts: step clock, script,
// pace of the script, limit of contacts, grips of hands, poses. Classes are for the message thread.
#pragma once
#include "Scene/Scene.h"
#include "Scene/SceneLimits.h"
#include "Scene/World/SceneBodies.h"
#include <algorithm>
#include <box2d/box2d.h>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// Times of the steps of a world that runs at `stepsPerSecond` (> 0); world time is a step count, so that no
/// rounding accumulates.
struct StepClock {
    int stepsPerSecond = 100;

    double stepSeconds() const noexcept { return 1.0 / stepsPerSecond; }

    /// Nanoseconds at which step `step` (>= 0) begins, rounded down. Any thread.
    std::int64_t timeNs(std::int64_t step) const noexcept {
        constexpr std::int64_t nsPerSecond = 1'000'000'000;
        // Whole seconds separately: step * 10^9 alone would overflow within 107 days at 1,000 steps/s.
        return step / stepsPerSecond * nsPerSecond + step % stepsPerSecond * nsPerSecond / stepsPerSecond;
    }

    /// The first step that begins at or after `seconds` (>= 0). Any thread.
    std::int64_t firstStepAt(double seconds) const noexcept {
        constexpr double rounding = 1.0e-6; // 0.07 s * 100 is 7.000000000000001, but step 7 is meant
        return static_cast<std::int64_t>(std::ceil(seconds * stepsPerSecond - rounding));
    }
};

/// An action that is due; `repetition` counts an input's repetitions from 0.
struct DueAction {
    const Action* action = nullptr; ///< of the scene
    int repetition = 0;
    int times = 1;
};

/// The script of a valid scene at a fixed step rate. An input acts in the first step that begins at or after
/// its time; inputs of one step act in the order of the scene. Allocates in its constructor only.
class SceneScript {
public:
    /// `scene` must outlive the script.
    SceneScript(const Scene& scene, const StepClock& clock)
        : periodSteps_(clock.firstStepAt(scene.scriptPeriodSeconds)) {
        for (const ScriptInput& input : scene.script)
            for (int i = 0; i < input.times; ++i) {
                const double seconds = input.timeSeconds + i * input.everySeconds;
                entries_.push_back({clock.firstStepAt(seconds), {&input.action, i, input.times}});
            }
        const auto isEarlier = [](const Entry& a, const Entry& b) { return a.step < b.step; };
        std::stable_sort(entries_.begin(), entries_.end(), isEarlier);
    }

    /// The next action that is due in step `step` or before and was not returned yet; `action` is nullptr if
    /// there is none. Call with ascending steps.
    DueAction next(std::int64_t step) noexcept {
        if (next_ == entries_.size() && periodSteps_ > 0 && !entries_.empty()) {
            periodStart_ += periodSteps_;
            next_ = 0;
        }
        const bool isDue = next_ < entries_.size() && periodStart_ + entries_[next_].step <= step;
        return isDue ? entries_[next_++].due : DueAction{};
    }

private:
    struct Entry {
        std::int64_t step;
        DueAction due;
    };
    std::int64_t periodSteps_;   // 0: the script does not repeat
    std::vector<Entry> entries_; // sorted by step
    std::int64_t periodStart_ = 0;
    std::size_t next_ = 0;
};

/// From world time `fromSeconds` on, the script continues at script time `scriptSeconds`, `rate` times as
/// fast as the scene says; motors of joints are `rate` times as fast, too.
struct ScriptPace {
    double fromSeconds = 0.0, scriptSeconds = 0.0, rate = 1.0;

    /// The step of the script that world step `step` executes. Any thread.
    std::int64_t scriptStep(std::int64_t step, const StepClock& clock) const noexcept {
        constexpr double rounding = 1.0e-6;
        return static_cast<std::int64_t>(
            std::floor((scriptSeconds - fromSeconds * rate) * clock.stepsPerSecond +
                       static_cast<double>(step) * rate + rounding));
    }
};

/// Limits the number of simultaneous contacts, to bound time and memory per step: two thousand bodies in one
/// place have two million pairs, a gigabyte. Beyond maxContacts, pairs pass through each other and are
/// counted.
class ContactLimit final : public b2ContactFilter {
public:
    explicit ContactLimit(const b2World& world)
        : world_{world} {}

    bool ShouldCollide(b2Fixture* a, b2Fixture* b) override {
        if (!b2ContactFilter::ShouldCollide(a, b)) return false;
        if (world_.GetContactCount() < sceneLimits::maxContacts) return true;
        ++refused_;
        return false;
    }

    std::uint64_t refused() const noexcept { return refused_; }

private:
    const b2World& world_;
    std::uint64_t refused_ = 0;
};

/// Grips of hands on bodies, at most one per body: each is a spring of limited force from a point of the body
/// to the hand. A hand moves straight at constant speed, so that a dragged body does not jump. Release a body
/// before it is disabled or destroyed.
class SceneGrips {
public:
    static constexpr float springHz = 5.0F; ///< Box2D's value for mouse joints; stable at 100 steps/s
    static constexpr float dampingRatio = 0.7F;

    /// World and clock must outlive the grips.
    SceneGrips(b2World& world, const StepClock& clock) noexcept
        : world_(world)
        , clock_(clock) {
        grips_.reserve(reservedGrips);
    }
    static constexpr std::size_t reservedGrips = 8; ///< number of grips for which memory is reserved

    /// Begins, changes or ends the grip on the body; the hand moves from `step` on.
    void apply(b2Body& body, const GripAction& action, std::int64_t step) {
        if (!action.toMetres) return release(body);
        if (body.GetType() != b2_dynamicBody || !body.IsEnabled()) return;
        Grip& grip = findOrCreate(body, action.pointMetres);
        grip.from = grip.joint->GetTarget();
        grip.to = box2dVector(*action.toMetres);
        grip.startStep = step;
        grip.endStep = step + clock_.firstStepAt(action.overSeconds);
    }
    void release(b2Body& body) {
        const auto grip = std::ranges::find(grips_, &body, &Grip::body);
        if (grip == grips_.end()) return;
        world_.DestroyJoint(grip->joint);
        grips_.erase(grip);
    }

    /// Moves all hands to their places at the beginning of `step`.
    void moveHands(std::int64_t step) {
        for (Grip& grip : grips_) grip.joint->SetTarget(grip.targetAt(step));
    }

private:
    struct Grip {
        b2Body* body;
        b2MouseJoint* joint;
        b2Vec2 from, to;
        std::int64_t startStep, endStep;
        b2Vec2 targetAt(std::int64_t step) const noexcept {
            if (step >= endStep) return to;
            const auto share = static_cast<float>(static_cast<double>(step - startStep) /
                                                  static_cast<double>(endStep - startStep));
            return from + share * (to - from);
        }
    };
    Grip& findOrCreate(b2Body& body, const std::optional<Vector>& point) {
        auto grip = std::ranges::find(grips_, &body, &Grip::body);
        if (grip == grips_.end()) {
            b2MouseJointDef def;
            def.bodyA = &ground();
            def.bodyB = &body;
            def.target = point ? body.GetWorldPoint(box2dVector(*point)) : body.GetWorldCenter();
            grip = grips_.insert(grips_.end(),
                                 {&body, static_cast<b2MouseJoint*>(world_.CreateJoint(&def)), {}, {}, 0, 0});
        }
        float stiffness = 0.0F, damping = 0.0F; // recomputed each time, because the mass may have changed
        b2LinearStiffness(stiffness, damping, springHz, dampingRatio, &ground(), &body);
        grip->joint->SetStiffness(stiffness);
        grip->joint->SetDamping(damping);
        grip->joint->SetMaxForce(static_cast<float>(sceneLimits::maxGripMetresPerSecond2) * body.GetMass());
        return *grip;
    }
    // The static body of all grips, without fixtures and contacts. The first grip creates it, so that worlds
    // without grips are unchanged.
    b2Body& ground() {
        if (ground_ == nullptr) {
            const b2BodyDef def;
            ground_ = world_.CreateBody(&def);
        }
        return *ground_;
    }

    b2World& world_;
    const StepClock& clock_;
    std::vector<Grip> grips_;  // sorted by their beginning
    b2Body* ground_ = nullptr; // the other body of all mouse joints
};

/// Place and angle of a body in the world.
struct BodyPose {
    double xMetres = 0.0;
    double yMetres = 0.0;
    double angleRadians = 0.0;
    bool isPresent = true; ///< false: not spawned yet, or removed
};

/// A joint between two present bodies, and its two points in the world: the ends of a rod, rope or spring,
/// the ends of a slider's travel, or twice the axle of others.
struct JointPose {
    Joint joint; ///< as the scene describes it
    Vector aMetres, bMetres;
};

/// The joint's pose at the start, as the scene describes it. Any thread.
JointPose jointPose(const JointDescription& joint);

struct WorldPoses {
    std::vector<BodyPose> bodies; ///< in the order of allBodies()
    std::vector<JointPose> joints;
};

/// The Box2D world of a scene. All bodies of scriptedBodies() exist from the start; absent ones are disabled,
/// and the script enables them. Bodies that a live input spawns or changes are created when it acts, with the
/// next numbers, and destroyed soon after they are removed or replaced. Numbers are never reused. Seed 0
/// starts bodies exactly as described, any other with jitter (see jitteredStart).
class SceneWorld {
public:
    /// The scene must be valid. Executes its script's actions of step 0.
    SceneWorld(const Scene& scene, std::uint32_t seed, const StepClock& clock);
    SceneWorld(const SceneWorld&) = delete;
    SceneWorld& operator=(const SceneWorld&) = delete;

    /// Adds a valid input (see InputCheck) that acts in `step`, or later if an earlier input does.
    void addInput(std::int64_t step, Action action);

    /// Applies `pace` from the first step that begins at or after its time; call in the order of their times.
    void addPace(const ScriptPace& pace) { pendingPaces_.push_back(pace); }

    /// Executes the live inputs and then the script's actions that are due in `step`. True if a fixture may
    /// be new or have a new sound, texture or source flag. Allocates only for new bodies and for more grips
    /// than SceneGrips::reservedGrips.
    bool executeActions(std::int64_t step);

    /// Removes executed live inputs from scene(), for endless worlds whose inputs are logged elsewhere.
    void dropExecutedInputs();

    b2World& world() noexcept { return world_; }

    /// Number of pairs that passed through each other because of the limit of contacts.
    std::uint64_t refusedContacts() const noexcept { return contactLimit_.refused(); }

    const Scene& scene() const noexcept { return scene_; } ///< includes the live inputs that were not dropped

    /// Number of bodies so far, removed ones included; numbered as in allBodies().
    std::size_t bodyCount() const noexcept { return nextBody_; }
    std::size_t bodiesInBox2d() const noexcept { return bodies_.size(); }
    BodyPose pose(std::size_t body) const noexcept; ///< a removed body is not present
    std::vector<JointPose> jointPoses() const;      ///< in the order of their names
    /// Calls `use` with number and pose of every body in Box2D's world, in the order of their numbers.
    template <class Use>
    void forEachBody(Use use) const {
        for (const auto& [number, body] : bodies_) use(number, poseOf(*body.body));
    }

    /// One fixture, its material and its body as they are now.
    struct CurrentFixture {
        std::size_t number;
        const b2Fixture& fixture; // owned by the world, as bodies and joints
        const FixtureDescription& description;
        const Material& material;
        const BodyDescription& body;
    };
    /// Calls `use` with every CurrentFixture of the world, in the order of their numbers.
    template <class Use>
    void forEachFixture(Use use) const {
        for (const auto& [number, body] : bodies_)
            for (std::size_t i = 0; i < body.fixtures.size(); ++i) use(currentFixture(body, i));
    }

private:
    struct Body {
        b2Body* body;
        std::size_t firstFixture; // number of its first fixture
        std::vector<b2Fixture*> fixtures;
        BodyDescription original;
        BodyDescription current; // with the present materials and source flags
    };
    struct PendingRemoval {
        std::int64_t step;
        std::size_t body;
    };
    static BodyPose poseOf(const b2Body& body) noexcept;
    CurrentFixture currentFixture(const Body& body, std::size_t index) const noexcept;
    void build();
    Body& add(const BodyDescription& body, const BodyStart& start);
    void destroyRemoved(std::int64_t step);
    bool executeInputs(std::int64_t step);
    bool executeScript(std::int64_t step);
    void applyPace(const ScriptPace& pace);
    struct ActionExecutor;
    bool apply(const Action& action); // true if fixtures changed, as executeActions()
    void restart(const SpawnAction& action, int repetition);
    BodyStart makeStart(const BodyDescription& body);
    void delayHalfAStep(b2Body& body) const;
    void applyGravity();
    Body* find(std::string_view name) noexcept; // nullptr if none has it
    b2Body* findInWorld(std::string_view name) noexcept;
    void setMaterial(Body& body, std::size_t fixture, int material);
    static void driveBelt(const Body& belt);
    void removeFromWorld(std::size_t number);
    void moveJoints(b2Body& from, b2Body& to);
    void destroyJoints(b2Body& body);

    static constexpr std::size_t reservedInputs = 24; // between two steps

    Scene scene_; // only its inputs grow
    StepClock clock_;
    bool hasJitter_;
    std::mt19937 random_;
    SceneScript script_;
    ScriptPace pace_;
    std::vector<ScriptPace> pendingPaces_; // paces that begin later
    Vector gravity_;                       // before hold_ rotates and scales it
    HoldAction hold_;
    b2World world_;
    ContactLimit contactLimit_{world_};
    SceneGrips grips_{world_, clock_};
    std::vector<Material> materials_;    // with their present sounds and textures
    std::map<std::size_t, Body> bodies_; // by number
    std::vector<const Body*> belts_;     // bodies with moving surfaces
    // next numbers to be given; those below scriptedBodyCount_ belong to scriptedBodies()
    std::size_t nextBody_ = 0, nextFixture_ = 0, scriptedBodyCount_ = 0;
    std::map<std::string, std::size_t, std::less<>> bodyNames_;
    std::deque<PendingRemoval> pendingRemovals_;                    // in the order of their steps
    std::map<std::string, std::size_t, std::less<>> scriptedNames_; // of scriptedBodies()
    struct WorldJoint {
        b2Joint* joint;
        Joint description;
    };
    std::map<std::string, WorldJoint, std::less<>> joints_;
    std::map<const SpawnAction*, std::size_t> spawned_; // number of the first repetition's body
    std::size_t nextInput_ = 0;
    double lastInputSeconds_ = 0.0;
    std::int64_t step_ = 0; // the step that begins
};

} // namespace physvib
