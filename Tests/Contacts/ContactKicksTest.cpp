// SPDX-License-Identifier: MIT
// Kicks through contacts that last: what rests on a flipper, a platform, a lever or a plunger, or touches in
// a row, is struck without having parted. What rests, rides or is carried is silent.
#include "FedWorld.h"
#include <array>
#include <functional>

namespace physvib::contact_kicks_test {

/// How an engine tells what touches.
enum class Telling { impulses, impulseOfPair, speeds, springs, motions };

/// Bodies on a line, each touching the next one; without bounce. Number 0 is driven.
class Row {
public:
    Row(Telling telling, int rate, double gravity, std::vector<double> masses, int sweeps = 200)
        : telling_(telling)
        , rate_(rate)
        , sweeps_(sweeps)
        , g_(gravity)
        , masses_(std::move(masses))
        , speeds_(masses_.size())
        , places_(masses_.size()) {
        for (std::size_t i = 0; i < masses_.size(); ++i) {
            places_[i] = static_cast<double>(i) * apart;
            EXPECT_EQ(feed_.set(static_cast<int>(i), {masses_[i], 0.0, 1.0},
                                {.frequencyHz = 200.0, .decayPerSecond = 30.0, .isCamera = masses_[i] > 0.0}),
                      "");
        }
    }
    double dt() const { return 1.0 / rate_; }
    double speed(std::size_t i) const { return speeds_[i]; }
    void setSpeed(std::size_t i, double v) { speeds_[i] = v; }
    void setPlace(std::size_t i, double y) { places_[i] = y; }
    /// The lowest contact comes first, once: what strikes the top reaches the ground a step later.
    void solveOnceFromBelow() { sweeps_ = 1, isFromBelow_ = true; }

    void run(double seconds, const std::function<double(double)>& driven) {
        for (int k = 0; k < static_cast<int>(std::lround(seconds * rate_)); ++k) {
            if (masses_[0] == 0.0) speeds_[0] = driven((k + 1) * dt());
            step();
        }
    }
    std::vector<CollisionEvent> felt() {
        std::vector<CollisionEvent> all;
        feed_.flush(all);
        return all;
    }

private:
    static constexpr double apart = 0.2;
    bool isTouching(std::size_t i) const { return places_[i + 1] - places_[i] < apart + 1e-3; }

    void step() {
        now_ += 1'000'000'000 / rate_;
        EXPECT_EQ(feed_.beginStep(now_, g_), "");
        for (std::size_t i = 0; i < speeds_.size(); ++i) {
            if (masses_[i] > 0.0) speeds_[i] -= g_ * dt();
            move(i, false);
        }
        std::vector<double> before = speeds_, impulses(speeds_.size());
        for (int sweep = 0; sweep < sweeps_; ++sweep)
            for (std::size_t i = speeds_.size() - 1; i-- > 0;) { // a contact further in each
                const std::size_t at = isFromBelow_ ? speeds_.size() - 2 - i : i;
                solve(at, impulses[at]);
            }
        for (std::size_t i = 0; i < speeds_.size(); ++i) move(i, true);
        for (std::size_t i = 0; i + 1 < speeds_.size(); ++i)
            if (isTouching(i)) touch(i, before[i] - before[i + 1], impulses[i]);
        EXPECT_EQ(feed_.endStep(), "");
        for (std::size_t i = 0; i < speeds_.size(); ++i) places_[i] += speeds_[i] * dt();
        for (std::size_t i = 0; i + 1 < speeds_.size(); ++i) // overlaps are moved apart
            places_[i + 1] = std::max(places_[i + 1], places_[i] + apart);
    }
    void solve(std::size_t i, double& impulse) {
        if (!isTouching(i)) return;
        const double a = masses_[i] > 0.0 ? 1.0 / masses_[i] : 0.0, b = 1.0 / masses_[i + 1];
        const double more = std::max(-impulse, (speeds_[i] - speeds_[i + 1]) / (a + b));
        impulse += more;
        speeds_[i] -= more * a;
        speeds_[i + 1] += more * b;
    }
    void move(std::size_t i, bool isAfter) {
        const BodyMotion motion{{0.0F, static_cast<float>(speeds_[i])}, 0.0F};
        const auto id = static_cast<int>(i);
        if (!isAfter) EXPECT_EQ(feed_.move(id, {0.0F, static_cast<float>(places_[i])}, motion), "");
        if (isAfter && telling_ == Telling::motions) EXPECT_EQ(feed_.moved(id, motion), "");
    }
    void touch(std::size_t i, double approach, double impulse) {
        FedContact contact;
        contact.a = static_cast<int>(i);
        contact.b = static_cast<int>(i + 1);
        contact.point = {0.0F, static_cast<float>(places_[i] + apart / 2)};
        contact.pointId = telling_ == Telling::springs ? FedContact::byPlace : 0;
        contact.isSoft = telling_ == Telling::springs;
        contact.isPushWhole = contact.isSoft;
        contact.isImpulseOfPair = telling_ == Telling::impulseOfPair;
        if (telling_ != Telling::speeds && telling_ != Telling::motions)
            contact.impulseNewtonSeconds = impulse;
        if (telling_ == Telling::speeds) contact.approachMetresPerSecond = approach;
        EXPECT_EQ(feed_.touch(contact), "");
    }

    Telling telling_;
    int rate_, sweeps_;
    bool isFromBelow_ = false;
    double g_;
    std::vector<double> masses_, speeds_, places_;
    std::int64_t now_ = 0;
    ContactFeed feed_{unity()};
};

class Kicks : public testing::TestWithParam<std::tuple<Telling, int>> {
protected:
    const Telling telling = std::get<0>(GetParam());
    const int rate = std::get<1>(GetParam());
    Row row(std::vector<double> masses, double gravity = g) const { return {telling, rate, gravity, masses}; }
    /// It has come to rest: what the beginning struck is of no interest.
    static void rest(Row& row) {
        row.run(0.5, [](double) { return 0.0; });
        row.felt();
    }
    static double strongest(const std::vector<CollisionEvent>& felt) {
        double most = 0.0;
        for (const auto& event : felt) most = std::max(most, event.source.impulseNewtonSeconds);
        return most;
    }
};

INSTANTIATE_TEST_SUITE_P(Engines, Kicks,
                         testing::Combine(testing::Values(Telling::impulses, Telling::impulseOfPair,
                                                          Telling::speeds, Telling::springs,
                                                          Telling::motions),
                                          testing::Values(30, 60, 240)));

TEST_P(Kicks, AFlipperUnderARestingBallStrikesItOnce) {
    Row row = this->row({0.0, 0.08});
    rest(row);
    row.run(0.1, [](double t) { return 12.0 + 30.0 * t; }); // and goes on, ever faster
    const auto felt = row.felt();
    ASSERT_EQ(felt.size(), 1U);
    const double kick = 0.08 * (12.0 + 30.0 * row.dt());
    EXPECT_NEAR(strongest(felt), kick, 0.08 * g * row.dt() + 0.01 * kick);
    EXPECT_NEAR(felt[0].y, 0.1, 1e-3);
    EXPECT_NEAR(static_cast<double>(felt[0].timeNs), 0.5e9, 1.01e9 * row.dt());
}

TEST_P(Kicks, APlatformThatJerksStrikesAllThatItCarries) {
    Row row = this->row({0.0, 1.0, 1.0, 1.0});
    rest(row);
    row.run(0.02, [](double) { return 3.0; });
    const auto felt = row.felt();
    // Speeds alone do not say what the box carries; the impulse of a pair does.
    const bool isOfOne = telling == Telling::speeds;
    const double kick = isOfOne ? 3.0 : 9.0; // N s, and what gravity adds in a step
    EXPECT_NEAR(strongest(felt), kick, kick / 3.0 * g * row.dt() + 0.1);
    EXPECT_LE(felt.size(), 3U);
}

TEST_P(Kicks, APlungerOrALeverThatIsLetGoStrikes) {
    Row row = this->row({0.0, 0.08});
    rest(row);
    row.run(1.0, [](double t) { return -0.1 * std::min(1.0, 4.0 * t); }); // drawn back
    EXPECT_TRUE(row.felt().empty());
    row.run(0.05, [](double) { return 5.0; });
    EXPECT_EQ(row.felt().size(), 1U);
    Row lever = this->row({0.0, 0.5, 0.2}); // a plank with a rider
    rest(lever);
    lever.setSpeed(1, 4.7);
    lever.run(0.05, [](double) { return 0.0; });
    const auto felt = lever.felt();
    ASSERT_GE(felt.size(), 1U);
    EXPECT_NEAR(strongest(felt), 4.7 / (1 / 0.5 + 1 / 0.2), 0.2 * g * lever.dt() + 0.02);
}

TEST_P(Kicks, ASecondKickIsFeltAsWell) {
    Row row = this->row({0.0, 0.08});
    rest(row);
    for (int k = 0; k < 3; ++k) {
        row.run(2 * row.dt(), [](double) { return 1.0; });
        EXPECT_EQ(row.felt().size(), 1U) << k;
        row.run(1.0, [](double) { return 0.0; });
        row.felt(); // it has come down again
    }
}

// An engine that sweeps three times passes a break on over several steps.
TEST_P(Kicks, EveryBallOfABreakIsFelt) {
    constexpr std::size_t count = 8;
    Row row(telling, rate, 0.0, std::vector<double>(count, 0.17), 3);
    row.setPlace(0, -0.3), row.setSpeed(0, 6.0);
    row.run(0.6, [](double) { return 0.0; });
    std::array<bool, count> isFelt{};
    for (const auto& event : row.felt()) isFelt[static_cast<std::size_t>(event.source.fixture)] = true;
    int missed = 0;
    for (std::size_t i = 0; i < count; ++i) missed += std::abs(row.speed(i)) > 0.5 && !isFelt[i] ? 1 : 0;
    // Speeds alone do not say what goes through a row within a step.
    EXPECT_LE(missed, telling == Telling::speeds ? 2 : 0);
}

// An engine that solves each contact once passes a blow on to the ground in the step after it.
TEST_P(Kicks, WhatTheGroundGivesBackToABlowIsNoSecondOne) {
    Row row = this->row({0.0, 1.0, 1.0});
    rest(row);
    row.setPlace(2, 0.9), row.solveOnceFromBelow();
    row.run(0.8, [](double) { return 0.0; });
    EXPECT_EQ(row.felt().size(), 2U) << "the falling one and what it falls on";
}

TEST_P(Kicks, WhatRestsRidesOrIsCarriedIsSilent) {
    Row stack = this->row({0.0, 1.0, 2.0, 0.5, 1.0});
    rest(stack);
    stack.run(2.0, [](double) { return 0.0; });
    EXPECT_TRUE(stack.felt().empty()) << "a stack";
    const auto lift = [](double t) { return 2.0 * std::min(1.0, t) - 2.0 * std::max(0.0, t - 2.0); }; // m/s
    stack.run(3.0, lift);
    EXPECT_TRUE(stack.felt().empty()) << "an elevator of 2 m/s^2";
    stack.run(2.0, [](double t) { return 0.5 * std::sin(6.0 * t); });
    EXPECT_TRUE(stack.felt().empty()) << "a platform that rocks by 3 m/s^2";
}

} // namespace physvib::contact_kicks_test
