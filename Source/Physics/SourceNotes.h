// SPDX-License-Identifier: MIT
// A look at a world's haptic sources, to explain why they touch nothing.
#pragma once

class b2World;

namespace physvib {

class FixtureTable;
struct ContactCounts;

/// Notes the sources that are sensors, filtered from every other fixture, disabled or asleep. World thread
/// (M), not inside a step.
void noteSources(const b2World& world, const FixtureTable& fixtures, ContactCounts& counts);

} // namespace physvib
