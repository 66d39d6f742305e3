// SPDX-License-Identifier: MIT
// A world of numbers: an engine's part is written by the test.
#pragma once
#include "Contacts/ContactFeed.h"
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace physvib {

constexpr double g = 9.81;

/// A source of 200 Hz.
constexpr HapticFixture source{.frequencyHz = 200.0, .decayPerSecond = 30.0, .isCamera = true};

/// A = |J| / m_i.
inline ImpactSettings unity() {
    ImpactSettings settings;
    settings.normalisation = 1.0;
    settings.handMassKg = 0.0;
    return settings;
}

/// Steps of 10 ms, if no other length is given.
class FedWorld : public testing::Test {
protected:
    explicit FedWorld(double gravity = g)
        : gravity_{gravity} {}
    void set(std::int32_t id, const FedBody& body, const HapticFixture& values = {}) {
        EXPECT_EQ(feed.set(id, body, values), "");
    }
    void begin(double seconds = 0.01) {
        EXPECT_EQ(feed.beginStep(feed.timeNs() + std::llround(seconds * 1.0e9), gravity_), "");
    }
    void touch(const FedContact& contact) { EXPECT_EQ(feed.touch(contact), ""); }
    void end() { EXPECT_EQ(feed.endStep(), ""); }
    /// A whole step in which these touch.
    void step(const std::vector<FedContact>& contacts = {}) {
        begin();
        for (const FedContact& contact : contacts) touch(contact);
        end();
    }
    /// Within a step: how a body moves before and after it is solved.
    void move(std::int32_t id, Vector2 centre, BodyMotion before, BodyMotion after) {
        EXPECT_EQ(feed.move(id, centre, before), "");
        EXPECT_EQ(feed.moved(id, after), "");
    }
    std::vector<CollisionEvent> events() {
        std::vector<CollisionEvent> all;
        feed.flush(all);
        return all;
    }
    /// The one event there is.
    CollisionEvent only() {
        const auto all = events();
        EXPECT_EQ(all.size(), 1U);
        return all.size() == 1 ? all.front() : CollisionEvent{};
    }
    /// Its impulse.
    double onlyImpulse() { return only().source.impulseNewtonSeconds; }

    ContactFeed feed{unity()};

private:
    double gravity_;
};

} // namespace physvib
