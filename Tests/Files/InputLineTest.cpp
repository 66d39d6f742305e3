// SPDX-License-Identifier: MIT
// Lines of what hands do: the fields of a scene's script, without a time.
#include "Files/Text/InputLine.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

const std::vector<Material> materials{{"wood", 850.0, 0.4, 0.6, 349.0, 107.0}};

Action read(const std::string& line) {
    const auto input = readInputLine(line, "line 1", materials, 4);
    EXPECT_TRUE(input) << input.error;
    return input && std::holds_alternative<Action>(input.value) ? std::get<Action>(input.value) : Action{};
}
std::string faultOf(const std::string& line) { return readInputLine(line, "line 1", materials, 4).error; }

TEST(InputLine, AHandHoldsABodyAndLetsItGo) {
    EXPECT_EQ(read(R"({"input": "grip", "body": "pen", "to_m": [2, 1.5], "point_m": [0, 0.1], "over_s": 0.02})"), (Action{GripAction{"pen", Vector{2.0, 1.5}, Vector{0.0, 0.1}, 0.02}}));
    EXPECT_EQ(read(R"({"input": "grip", "body": "pen"})"), (Action{GripAction{"pen", {}, {}}}));
    EXPECT_EQ(faultOf(R"({"input": "grip", "to_m": [2, 1]})"), "line 1: field \"body\" is missing");
    EXPECT_EQ(faultOf(R"({"input": "grip", "body": "pen", "to_m": [2]})"), "line 1: to_m: expected 2 numbers, found 1 items");
}

TEST(InputLine, ASurfaceBecomesRough) {
    EXPECT_EQ(read(R"({"input": "texture", "material": "wood", "grain_m": 0.008, "grain_pattern": "regular"})"), (Action{TextureAction{0, 0.008, 1.0, GrainPattern::regular}}));
    EXPECT_EQ(read(R"({"input": "texture", "material": "wood"})"), (Action{TextureAction{0}})) << "smooth";
    EXPECT_NE(faultOf(R"({"input": "texture", "material": "glass"})"), "");
}

} // namespace
} // namespace physvib
