// SPDX-License-Identifier: MIT
// The Box2D world of a scene, and what the actions of its script and of live inputs do to it.
#pragma once
#include "Physics/BodyStart.h"
#include "Physics/ContactBound.h"
#include "Physics/Scene.h"
#include "Physics/SceneScript.h"
#include "Physics/StepClock.h"
#include <box2d/box2d.h>
#include <cstddef>
#include <cstdint>
#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// Where a body is, in metres of the field.
struct BodyPose {
    double xMetres = 0.0;
    double yMetres = 0.0;
    double angleRadians = 0.0;
    bool isPresent = true; ///< false: not spawned yet, or removed
};

/// All bodies of scriptedCast() exist from the start, so fixtures keep their numbers; those that are not there
/// (yet) are disabled, which for Box2D means no contacts. What a live input spawns is created when it acts.
/// Seed 0 starts bodies exactly as described, any other a little beside (see jitteredStart). M only.
class SceneWorld {
public:
    /// The scene must be valid. Does what its script wants done in step 0.
    SceneWorld(const Scene& scene, std::uint32_t seed, const StepClock& clock);
    SceneWorld(const SceneWorld&) = delete;
    SceneWorld& operator=(const SceneWorld&) = delete;

    /// Adds an input that is valid (see InputCheck) and acts in `step`, or as soon as those before it have.
    void addInput(std::int64_t step, Action action);

    /// Does what live inputs, then the script, want done in `step` or before; true if a fixture may be new or
    /// have another sound or camera since. Allocates for new bodies only.
    bool act(std::int64_t step);

    b2World& world() noexcept { return world_; }

    /// How often two bodies passed through each other because there were too many contacts.
    std::uint64_t contactsRefused() const noexcept { return bound_.refused(); }

    const Scene& scene() const noexcept { return scene_; } ///< with all inputs so far

    /// Bodies so far; numbers as in sceneCast().
    std::size_t bodyCount() const noexcept { return bodies_.size(); }
    BodyPose pose(std::size_t body) const noexcept;

    std::size_t fixtureCount() const noexcept { return fixtures_.size(); }
    const b2Fixture& fixture(std::size_t index) const noexcept { return *fixtures_[index].fixture; }

    /// The fixture, its material and its body as they are now.
    const FixtureDescription& fixtureNow(std::size_t index) const noexcept;
    const Material& materialOf(std::size_t fixture) const noexcept;
    const BodyDescription& bodyOf(std::size_t fixture) const noexcept;

private:
    struct Part {
        b2Fixture* fixture; // owned by the world, as bodies and joints
        std::size_t body;
        std::size_t index; // in the body
    };
    void build();
    b2Body& add(const BodyDescription& body, const BodyStart& start);
    bool actOnInputs(std::int64_t step);
    bool actOnScript(std::int64_t step);
    bool apply(const Action& action);
    bool spawn(const BodyDescription& body);
    BodyStart startOf(const BodyDescription& body);
    void startHalfAStepBehind(b2Body& body) const;
    void setGravity(const Vector& beforeHold);
    void holdDevice();
    b2Body* find(std::string_view name) const noexcept; // nullptr if none has it
    /// Calls `change` with the numbers of one fixture of a body, or of all.
    template <class Change>
    void forFixtures(const std::string& body, int fixture, Change change);
    void setMaterial(std::size_t fixture, int material);

    bool act(const DueAction& due);
    bool act(const GravityAction& action);
    bool act(const TiltAction& action);
    bool act(const HoldAction& action);
    bool act(const ImpulseAction& action) const;
    bool act(const VelocityAction& action) const;
    bool act(const SpawnAction& action, int repetition);
    bool act(const RemoveAction& action) const;
    bool act(const MotorAction& action) const;
    bool act(const CameraAction& action);
    bool act(const MaterialAction& action);
    bool act(const SoundAction& action);

    Scene scene_; // only its inputs grow
    StepClock clock_;
    bool jitters_;
    std::mt19937 random_;
    SceneScript script_;
    Vector gravity_;  // before hold_
    HoldAction hold_;
    b2World world_;
    ContactBound bound_{world_};
    std::vector<BodyDescription> cast_; // as described
    std::vector<BodyDescription> now_;  // with the materials and cameras of now
    std::vector<Material> materials_;   // with the sounds of now
    std::vector<b2Body*> bodies_;
    std::vector<std::size_t> firstFixtures_; // per body
    std::vector<Part> fixtures_;
    std::map<std::string, std::size_t, std::less<>> bodyNames_;
    std::map<std::string_view, b2Joint*> joints_;
    std::map<const SpawnAction*, std::size_t> spawned_; // the body of the script's first repetition
    std::size_t nextInput_ = 0;
};

} // namespace physvib
