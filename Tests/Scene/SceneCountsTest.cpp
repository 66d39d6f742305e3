// SPDX-License-Identifier: MIT
// What becomes of a scene's contacts is counted while it runs.
#include "Scene/SceneFile.h"
#include "Scene/World/Simulation.h"
#include <gtest/gtest.h>

namespace physvib {
namespace {

TEST(SceneCounts, AreThoseOfItsEventsAndItsContacts) {
    const SceneEvents made = runScene(builtInScenes().front(), {}, 5'000'000'000);
    EXPECT_GE(made.counts.events, made.events.size()); // those of the last step are still to come
    EXPECT_LE(made.counts.events, made.events.size() + 20);
    EXPECT_GT(made.events.size(), 20U);
    EXPECT_GT(made.counts.contacts, made.counts.withoutSource);
    EXPECT_EQ(made.counts.dropped, 0U);
    EXPECT_EQ(made.counts.muted, 0U);
    // or 1.5 steps of the gravity that there is while the box is shaken
    EXPECT_GE(made.counts.thresholdMetresPerSecond, 0.15);
    EXPECT_LE(made.counts.thresholdMetresPerSecond, 1.5 * 0.01 * 25.0);
}

} // namespace
} // namespace physvib
