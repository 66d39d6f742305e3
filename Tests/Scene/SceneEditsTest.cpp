// SPDX-License-Identifier: MIT
// Which actions change a scene permanently, and which of a script a user takes over.
#include "Scene/SceneEdits.h"
#include "Scene/SceneFields.h"
#include <array>
#include <gtest/gtest.h>
#include <utility>

namespace physvib {
namespace {

using Names = std::vector<std::string_view>;

/// One action of each kind, in the order of actionNames.
const auto actions = []<std::size_t... kinds>(std::index_sequence<kinds...>) {
    return std::array{Action{std::in_place_index<kinds>}...};
}
(std::make_index_sequence<actionNames.size()>{});

TEST(SceneEdits, LastingIsWhatAddsRemovesOrChangesSomethingOfTheScene) {
    Names lasting;
    for (const Action& action : actions)
        if (isLasting(action)) lasting.push_back(actionNames[action.index()]);
    EXPECT_EQ(lasting, (Names{"spawn", "remove", "camera", "material", "sound", "texture", "change", "join",
                              "unjoin"}));
}

TEST(SceneEdits, AScriptLeavesToHandsWhatTheyDo) {
    Scene scene;
    for (const Action& action : actions) scene.script.push_back({0.0, 1, 0.0, action});
    Names left;
    for (const ScriptInput& input : sceneForHands(scene).script)
        left.push_back(actionNames[input.action.index()]);
    EXPECT_EQ(left, (Names{"spawn", "remove", "motor", "camera", "material", "sound", "texture", "change",
                           "join", "unjoin"}));
}

} // namespace
} // namespace physvib
