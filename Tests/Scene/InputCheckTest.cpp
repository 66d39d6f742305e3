// SPDX-License-Identifier: MIT
// What counts towards the limit of live inputs, and what is kept of the earlier ones: bodies that come,
// change and go never make a later input invalid.
#include "Scene/World/InputCheck.h"
#include "DropScene.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

BodyDescription stone(const std::string& name) {
    return {name, BodyType::dynamicBody, {{CircleShape{0.1}, {}, 0.0, 1, true}}, {1.0, 1.0}};
}

/// Takes them one after the other, until an error, which is that of all at once.
std::string takeAll(InputCheck& check, const std::vector<Action>& actions) {
    std::string error, atOnce = InputCheck{check}.take(actions);
    for (std::size_t i = 0; i < actions.size() && error.empty(); ++i) error = check.take(actions[i]);
    EXPECT_EQ(error, atOnce);
    return error;
}

TEST(InputCheck, InputsOfTheSceneCountTowardsTheLimit) {
    Scene scene = dropScene(1.0);
    scene.inputs = {{0.0, TiltAction{0.1}}, {0.5, TiltAction{0.2}}};
    InputCheck check(scene, 3);
    EXPECT_EQ(check.take(TiltAction{0.3}), "");
    EXPECT_EQ(check.take(TiltAction{0.4}), "expected at most 3 inputs");
}

TEST(InputCheck, RefusedInputsDoNotCount) {
    InputCheck check(dropScene(1.0), 2);
    for (int i = 0; i < 5; ++i) EXPECT_NE(check.take(RemoveAction{"nobody"}), "");
    EXPECT_NE(check.take(std::vector<Action>{TiltAction{0.1}, RemoveAction{"nobody"}}), "");
    EXPECT_EQ(takeAll(check, {TiltAction{0.1}, TiltAction{0.2}}), "");
    EXPECT_EQ(check.take(TiltAction{0.3}), "expected at most 2 inputs");
}

TEST(InputCheck, AJointGoesWithABodyThatIsForgotten) {
    InputCheck check(dropScene(1.0), InputCheck::endless);
    for (std::size_t i = 0; i < InputCheck::remembered + 20; ++i) {
        const std::string name = "stone " + std::to_string(i);
        const JointDescription pin{"pin " + std::to_string(i), "plate", name, RevoluteJoint{}, false};
        ASSERT_EQ(takeAll(check, {SpawnAction{stone(name), {}}, JoinAction{pin}, RemoveAction{name}}), "")
            << i;
    }
    EXPECT_EQ(check.take(TiltAction{0.1}), "");
}

TEST(InputCheck, ABodyThatWasSpawnedCanBeSwitchedAndChanged) {
    InputCheck check(dropScene(1.0));
    EXPECT_EQ(takeAll(check, {SpawnAction{stone("stone"), {}}, CameraAction{"stone", everyFixture, false},
                              ChangeAction{stone("stone"), true}, TiltAction{0.1}}),
              "");
}

} // namespace
} // namespace physvib
