// SPDX-License-Identifier: MIT
// The Box2D world of a scene, and the effects of scripted and live actions on it.
#pragma once
#include "Scene/Scene.h"
#include "Scene/SceneScript.h"
#include "Scene/World/BodyStart.h"
#include "Scene/World/ContactBound.h"
#include "Scene/World/SceneGrips.h"
#include "Scene/World/StepClock.h"
#include <box2d/box2d.h>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <random>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace physvib {

/// Where a body is, in metres of the field.
struct BodyPose {
    double xMetres = 0.0;
    double yMetres = 0.0;
    double angleRadians = 0.0;
    bool isPresent = true; ///< false: not spawned yet, or removed
};

/// A joint between two bodies that are present, and its points: both ends of a rod, rope or spring, or both
/// ends of a slider's way, or the axle twice.
struct JointPose {
    Joint joint; ///< as described
    Vector aMetres, bMetres;
};

/// As the scene describes it. Any thread.
JointPose describedPose(const JointDescription& joint);

struct WorldPoses {
    std::vector<BodyPose> bodies; ///< of the scene's cast
    std::vector<JointPose> joints;
};

/// All bodies of scriptedCast() exist from the start. Absent ones are disabled, without contacts in Box2D,
/// because the script may spawn them. Bodies that a live input spawns or changes are created when it acts,
/// under the following numbers, and destroyed soon after they are removed or replaced. Numbers are never
/// reused. Seed 0 starts bodies exactly as described, any other with jitter (see jitteredStart). Message
/// thread (M) only.
class SceneWorld {
public:
    /// The scene must be valid. Executes its script's actions of step 0.
    SceneWorld(const Scene& scene, std::uint32_t seed, const StepClock& clock);
    SceneWorld(const SceneWorld&) = delete;
    SceneWorld& operator=(const SceneWorld&) = delete;

    /// Adds a valid input (see InputCheck) that acts in `step`, or once earlier ones have acted.
    void addInput(std::int64_t step, Action action);

    /// Executes the live inputs, then the script's actions, that are due in `step`. True if a fixture may be
    /// new or have a new sound, texture or source flag. Allocates for new bodies and grips only.
    bool act(std::int64_t step);

    /// Removes executed live inputs from scene(), for endless worlds whose inputs are logged elsewhere.
    void forgetDone();

    b2World& world() noexcept { return world_; }

    /// How often bodies passed through each other because of the limit of contacts.
    std::uint64_t contactsRefused() const noexcept { return bound_.refused(); }

    const Scene& scene() const noexcept { return scene_; } ///< with all inputs so far, but those forgotten

    /// Bodies so far; numbers as in sceneCast().
    std::size_t bodyCount() const noexcept { return nextBody_; }
    std::size_t bodiesInBox2d() const noexcept { return bodies_.size(); }
    BodyPose pose(std::size_t body) const noexcept; ///< of a removed body: not present
    std::vector<JointPose> jointPoses() const;      ///< in the order of their names
    /// Calls `use` with number and pose of those that Box2D has, in the order of their numbers.
    template <class Use>
    void forAllBodies(Use use) const {
        for (const auto& [number, body] : bodies_) use(number, poseOf(*body.body));
    }

    /// One fixture, its material and its body as they are now.
    struct FixtureNow {
        std::size_t number;
        const b2Fixture& fixture; // owned by the world, as bodies and joints
        const FixtureDescription& description;
        const Material& material;
        const BodyDescription& body;
    };
    /// Calls `use` with every FixtureNow of the world, in the order of their numbers.
    template <class Use>
    void forAllFixtures(Use use) const {
        for (const auto& [number, body] : bodies_)
            for (std::size_t i = 0; i < body.fixtures.size(); ++i) use(fixtureNow(body, i));
    }

private:
    struct Body {
        b2Body* body;
        std::size_t firstFixture; // its number
        std::vector<b2Fixture*> fixtures;
        BodyDescription described;
        BodyDescription now; // with the present materials and source flags
    };
    struct Leaving {
        std::int64_t step;
        std::size_t body;
    };
    static BodyPose poseOf(const b2Body& body) noexcept;
    FixtureNow fixtureNow(const Body& body, std::size_t index) const noexcept;
    void build();
    Body& add(const BodyDescription& body, const BodyStart& start);
    void destroyRemoved(std::int64_t step);
    bool actOnInputs(std::int64_t step);
    bool actOnScript(std::int64_t step);
    bool apply(const Action& action);
    bool spawn(const BodyDescription& body);
    BodyStart startOf(const BodyDescription& body);
    void startHalfAStepBehind(b2Body& body) const;
    void setGravity(const Vector& beforeHold);
    void holdDevice();
    Body* find(std::string_view name) noexcept; // nullptr if none has it
    b2Body* findInWorld(std::string_view name) noexcept;
    /// Calls `change` with a body and the indices of one of its fixtures, or of all.
    template <class Change>
    void forFixtures(const std::string& body, int fixture, Change change);
    void setMaterial(Body& body, std::size_t fixture, int material);

    bool act(const DueAction& due);
    bool act(const SpawnAction& action, int repetition);
    /// Executes any other action, each by a specialisation in SceneWorld.cpp. True as of act(step).
    template <class One>
    requires std::is_class_v<One>
    bool act(const One& action);
    void retire(std::size_t number);
    void moveJoints(b2Body& from, b2Body& to);
    void dropJoints(b2Body& body);

    Scene scene_; // only its inputs grow
    StepClock clock_;
    bool jitters_;
    std::mt19937 random_;
    SceneScript script_;
    Vector gravity_; // before hold_
    HoldAction hold_;
    b2World world_;
    ContactBound bound_{world_};
    SceneGrips grips_{world_, clock_};
    std::vector<Material> materials_;    // with the sounds and textures of now
    std::map<std::size_t, Body> bodies_; // by number
    // numbers; below scripted_ stands scriptedCast()
    std::size_t nextBody_ = 0, nextFixture_ = 0, scripted_ = 0;
    std::map<std::string, std::size_t, std::less<>> bodyNames_;
    std::deque<Leaving> leaving_;                                   // in the order of their steps
    std::map<std::string, std::size_t, std::less<>> scriptedNames_; // of scriptedCast()
    struct HeldJoint {
        b2Joint* made;
        Joint described;
    };
    std::map<std::string, HeldJoint, std::less<>> joints_;
    std::map<const SpawnAction*, std::size_t> spawned_; // the body of the script's first repetition
    std::size_t nextInput_ = 0;
    double lastInputSeconds_ = 0.0;
    std::int64_t step_ = 0; // that begins
};

} // namespace physvib
