// SPDX-License-Identifier: MIT
// What a push on a body has to move, held against the world's own answer.
#include "Physics/BodyMass.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

TEST(BodyMass, ThePointThatIsPushedMovesOffAsAThirdOfADiscWouldAtItsRim) {
    Scene scene;
    scene.materials = {Material{}};
    scene.materials[0].densityKgPerSquareMetre = 2.0;
    BodyDescription disc;
    FixtureDescription fixture;
    fixture.shape = CircleShape{0.5};
    fixture.offsetMetres = {1.0, 0.0}; // the centre of mass is not the origin
    disc.fixtures.push_back(fixture);
    const double mass = bodyMoments(disc, scene).massKg;
    EXPECT_GT(mass, 0.0);
    EXPECT_NEAR(pushedMassKg(disc, scene, {1.0, 0.0}), mass, 1e-12);
    EXPECT_NEAR(pushedMassKg(disc, scene, {1.0, 0.5}), mass / 3.0, 1e-12);
    EXPECT_NEAR(pushedMassKg(disc, scene, {0.5, 0.0}), mass / 3.0, 1e-12);
}

} // namespace
} // namespace physvib
