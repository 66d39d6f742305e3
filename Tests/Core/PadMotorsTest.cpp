// SPDX-License-Identifier: MIT
// Commands for a game controller's motors: paced, above the threshold, and no weak hit ends a strong one.
#include "Core/Pads/PadMotors.h"
#include <algorithm>
#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace physvib::pad_motors_test {

constexpr std::int64_t ms = 1'000'000;

PhantomPanner grips() {
    ActuatorLayout phone;
    layoutPreset("phone4", phone);
    return PadMotors::makeGripPanner({phone, PanningLaw::linear, 1.0, 1.0, 1.0});
}

CollisionEvent hit(double seconds, double frequencyHz, double amplitude, double x = 0.5,
                   double decayPerSecond = 30.0) {
    return {static_cast<std::int64_t>(seconds * 1e9), frequencyHz, decayPerSecond, amplitude, x, 0.5, 0, {}};
}

/// Half a tone of full scale for `seconds`, which does not decay.
CollisionEvent pulse(double at, double seconds, double amplitude, double frequencyHz) {
    CollisionEvent event = hit(at, frequencyHz, amplitude, 0.5, 0.0);
    event.durationNs = static_cast<std::int64_t>(seconds * 1e9);
    return event;
}

/// From 100 ms to there.
CollisionEvent ringing(double amplitude, std::int64_t endMs, double decayPerSecond = 0.0) {
    CollisionEvent event = hit(0.1, 60.0, amplitude, 0.5, decayPerSecond);
    event.durationNs = (endMs - 100) * ms;
    return event;
}

std::vector<PadCommand> commandsOf(const PadModel& law, const std::vector<CollisionEvent>& events,
                                   double level = 1.0) {
    PadMotors motors{law};
    std::vector<PadCommand> commands;
    const auto runUntil = [&](std::int64_t ns) {
        while (motors.dueNs() < ns) commands.push_back(motors.next(level));
    };
    for (const CollisionEvent& event : events) {
        runUntil(event.timeNs - static_cast<std::int64_t>(1e9 * law.leadSeconds));
        motors.strike(event, grips());
    }
    runUntil(PadMotors::never);
    return commands;
}

PadCommand at(const std::vector<PadCommand>& commands, std::int64_t ns) {
    PadCommand now;
    for (const PadCommand& command : commands)
        if (command.timeNs <= ns) now = command;
    return now;
}

/// The strongest that motors like those of the law become.
struct Felt {
    double low = 0.0, high = 0.0;
};
Felt feltOf(const PadModel& law, const std::vector<PadCommand>& commands) {
    Felt now, most;
    for (std::int64_t ns = 0; ns < commands.back().timeNs + 500 * ms; ns += ms) {
        const PadCommand command = at(commands, ns);
        now = {law.low.strengthAfter(now.low, command.low, 0.001),
               law.high.strengthAfter(now.high, command.high, 0.001)};
        most = {std::max(most.low, now.low), std::max(most.high, now.high)};
    }
    return most;
}

std::vector<CollisionEvent> rain(unsigned seed, int count, double seconds) {
    std::mt19937 random{seed};
    const auto unit = [&] { return static_cast<double>(random()) / 4294967296.0; };
    std::vector<CollisionEvent> events;
    for (int i = 0; i < count; ++i) {
        events.push_back(hit(seconds * unit(), 40.0 + 400.0 * unit(), unit() * unit(), unit(),
                             10.0 + 40.0 * std::floor(3.0 * unit())));
        if (i % 5 == 0) events.back().durationNs = static_cast<std::int64_t>(50e6 * unit()) + 1;
    }
    std::ranges::sort(events, {}, &CollisionEvent::timeNs);
    return events;
}

TEST(PadMotor, CommandsAndStrengthsAreInverseAndNothingTurnsBelowTheThreshold) {
    const PadMotor motor;
    EXPECT_EQ(motor.strengthOf(0.29), 0.0);
    EXPECT_DOUBLE_EQ(motor.strengthOf(0.5), 0.5);
    EXPECT_DOUBLE_EQ(motor.strengthOf(0.86), 1.0);
    for (double strength = 0.05; strength < 1.0; strength += 0.05)
        EXPECT_NEAR(motor.strengthOf(motor.commandOf(strength)), strength, 1e-12);
    EXPECT_NEAR(motor.strengthAfter(0.0, 1.0, motor.riseSeconds), 0.9, 1e-12);
    EXPECT_NEAR(motor.strengthAfter(1.0, 0.0, motor.fallSeconds), 0.1, 1e-12);
}

TEST(PadMotors, CommandsAreZeroOrAtLeastTheThresholdNeverCloserThanThePaceAndEndWithZero) {
    for (const double perSecond : {30.0, 125.0}) {
        PadModel law;
        law.commandsPerSecond = perSecond;
        law.low.threshold = 0.333; // between two hundredths
        for (unsigned seed = 1; seed <= 20; ++seed) {
            const auto commands = commandsOf(law, rain(seed, 100, 3.0));
            ASSERT_FALSE(commands.empty());
            for (std::size_t i = 0; i < commands.size(); ++i) {
                for (const auto& [command, least] :
                     {std::pair{commands[i].low, law.low.threshold}, {commands[i].high, law.high.threshold}})
                    EXPECT_TRUE(command == 0.0 || (command >= least && command <= 1.0)) << command;
                const std::int64_t sinceNs = i > 0 ? commands[i].timeNs - commands[i - 1].timeNs : INT64_MAX;
                EXPECT_GE(static_cast<double>(sinceNs), 1e9 / perSecond - 1.0);
            }
            EXPECT_TRUE(commands.back().isSame({}));
        }
    }
}

TEST(PadMotors, AWeakHitNeverEndsAStrongOne) {
    PadModel law;
    law.commandsPerSecond = 125.0;
    const auto strong = hit(0.1, 60.0, 1.0, 0.2, 8.0), weak = hit(0.112, 60.0, 0.02, 0.2, 60.0);
    const auto alone = commandsOf(law, {strong}), both = commandsOf(law, {strong, weak});
    for (std::int64_t ns = 0; ns < 700 * ms; ns += 8 * ms) {
        EXPECT_GE(at(both, ns).low + 0.011, at(alone, ns).low) << ns / ms << " ms";
        EXPECT_GE(at(both, ns).high + 0.011, at(alone, ns).high) << ns / ms << " ms";
    }
}

TEST(PadMotors, WhatIsToBeFeltIsFeltHoweverShortAndWeak) {
    for (const double perSecond : {30.0, 125.0})
        for (const double frequencyHz : {50.0, 100.0, 250.0})
            for (const double amplitude : {0.0101, 0.1, 0.3, 1.0}) {
                PadModel law;
                law.commandsPerSecond = perSecond;
                const Felt felt = feltOf(law, commandsOf(law, {pulse(0.1, 0.02, amplitude, frequencyHz)}));
                EXPECT_GE(std::max(felt.low, felt.high), 0.9 * PadMotors::minPerceptibleStrength)
                    << perSecond << ' ' << frequencyHz << ' ' << amplitude;
            }
    EXPECT_TRUE(commandsOf({}, {pulse(0.1, 0.02, 0.0099, 50.0)}).back().isSame({}))
        << "weaker than the floor";
    EXPECT_EQ(feltOf({}, commandsOf({}, {pulse(0.1, 0.02, 0.0099, 50.0)})).low, 0.0);
}

TEST(PadMotors, StrongerHitsAreFeltStronger) {
    double before = 0.0;
    for (const double amplitude : {0.02, 0.1, 0.3, 1.0}) {
        const double felt = feltOf({}, commandsOf({}, {hit(0.1, 50.0, amplitude)})).low;
        EXPECT_GT(felt, before + 0.02) << amplitude;
        before = felt;
    }
}

TEST(PadMotors, AHitRumblesUntilItDecaysToTheFloor) {
    for (const double decayPerSecond : {4.0, 8.0}) {
        std::int64_t lastNs = 0;
        for (const PadCommand& command : commandsOf({}, {hit(0.1, 60.0, 0.8, 0.5, decayPerSecond)}))
            if (!command.isSame({})) lastNs = command.timeNs;
        const double end = 0.1 + std::log(0.8 / PadModel{}.floor) / decayPerSecond;
        EXPECT_NEAR(1e-9 * static_cast<double>(lastNs), end, 0.2) << decayPerSecond;
    }
}

TEST(PadMotors, FrequencyAndPlaceShareAHitBetweenTheMotors) {
    const auto felt = [](double frequencyHz, double x) {
        return feltOf({}, commandsOf({}, {hit(0.1, frequencyHz, 0.5, x)}));
    };
    EXPECT_GT(felt(40.0, 0.5).low, 1.5 * felt(40.0, 0.5).high);
    EXPECT_GT(felt(250.0, 0.5).high, 1.5 * felt(250.0, 0.5).low);
    EXPECT_GT(felt(100.0, 0.0).low, felt(100.0, 0.0).high);
    EXPECT_GT(felt(100.0, 1.0).high, felt(100.0, 1.0).low);
    EXPECT_GE(felt(250.0, 0.0).high, PadMotors::minPerceptibleStrength * 0.9)
        << "a high hit at the left is felt all the same";
}

TEST(PadMotors, WhatMovesGoesFromOneGripToTheOther) {
    CollisionEvent event = pulse(0.1, 1.0, 0.8, 100.0);
    event.x = 0.0;
    event.course.toX = 1.0;
    event.course.toY = 0.5;
    event.course.travelNs = 1000 * ms;
    const auto commands = commandsOf({}, {event});
    EXPECT_GT(at(commands, 300 * ms).low, at(commands, 300 * ms).high);
    EXPECT_LT(at(commands, 950 * ms).low, at(commands, 950 * ms).high);
}

TEST(PadMotors, AToneThatGoesOnIsAsWeakAsItIsByThen) {
    CollisionEvent later = hit(0.1, 60.0, 0.9, 0.5, 10.0);
    later.course.toneAgeNs = 150 * ms;
    const auto felt = commandsOf({}, {later}),
               weak = commandsOf({}, {hit(0.1, 60.0, 0.9 * std::exp(-1.5), 0.5, 10.0)});
    for (std::int64_t ns = 0; ns < 1000 * ms; ns += 10 * ms)
        EXPECT_NEAR(at(felt, ns).low, at(weak, ns).low, 0.011);
}

TEST(PadMotors, AThousandHitsOfOneMaterialAreAsMuchAsTheirEnergy) {
    std::vector<CollisionEvent> many(200, hit(0.1, 50.0, 0.8 / std::sqrt(200.0)));
    const auto summed = commandsOf({}, many), one = commandsOf({}, {hit(0.1, 50.0, 0.8)});
    for (std::int64_t ns = 200 * ms; ns < 400 * ms; ns += 10 * ms)
        EXPECT_NEAR(at(summed, ns).low, at(one, ns).low, 0.1) << ns / ms;
    PadMotors full{PadModel{}};
    for (int i = 0; i < 300; ++i) full.strike(many.front(), grips());
    EXPECT_EQ(full.lost(), 44u);
}

TEST(PadMotors, AStopIsZeroAtTheNextCommandAndLaterHitsArePlayed) {
    PadMotors motors{PadModel{}};
    motors.strike(pulse(0.1, 2.0, 1.0, 50.0), grips());
    while (motors.dueNs() < 500 * ms) motors.next(1.0);
    motors.strike(hit(0.52, 50.0, 1.0), grips());
    motors.strike(hit(0.9, 50.0, 1.0), grips());
    motors.stop(550 * ms);
    const PadCommand stopped = motors.next(1.0);
    EXPECT_TRUE(stopped.isSame({}));
    EXPECT_GE(stopped.timeNs, 550 * ms);
    EXPECT_EQ(motors.dueNs(), 870 * ms);
    EXPECT_GT(motors.next(1.0).low, 0.3);
}

TEST(PadMotors, AtLevelZeroNothingIsFelt) {
    for (const PadCommand& command : commandsOf({}, rain(3, 50, 1.0), 0.0)) EXPECT_TRUE(command.isSame({}));
}

double strongestUntil(PadMotors& motors, std::int64_t ns) {
    double strongest = 0.0;
    while (motors.dueNs() <= ns) {
        const PadCommand command = motors.next(1.0);
        strongest = std::max({strongest, command.low, command.high});
    }
    return strongest;
}

TEST(PadMotors, AHitOutlastsWhatEndsOrMovesBesideIt) {
    for (const bool moves : {false, true}) {
        CollisionEvent weak = hit(0.1, 60.0, 0.02, 0.5, 8.0);
        (moves ? weak.course.travelNs : weak.durationNs) = 50 * ms;
        PadMotors motors{PadModel{}};
        motors.strike(weak, grips());
        motors.strike(hit(0.1, 60.0, 1.0, 0.5, 8.0), grips()); // of the same decay
        strongestUntil(motors, 300 * ms);
        EXPECT_GT(strongestUntil(motors, 500 * ms), 0.3) << moves;
    }
}

/// A stop is at the moment at which it is felt; so is an event, although its command leaves earlier.
TEST(StopsOfMotors, EndWhatIsBeforeThemAndNothingLater) {
    for (const double lead : {0.0, 0.03, 0.1})
        for (const int offsetMs : {-150, -100, -99, -31, -30, -29, -1, 0, 1, 29, 30, 100}) {
            PadModel law;
            law.leadSeconds = lead;
            PadMotors motors{law};
            const std::int64_t stopNs = 500 * ms;
            motors.strike(hit(1e-3 * (500 + offsetMs), 60.0, 1.0), grips());
            motors.stop(stopNs);
            EXPECT_EQ(strongestUntil(motors, 2000 * ms) > 0.0, offsetMs >= 0)
                << offsetMs << " ms after the stop, lead " << lead;
            EXPECT_EQ(motors.dueNs(), PadMotors::never);
        }
}

TEST(StopsOfMotors, EndWhatRingsWithTheNextCommand) {
    for (const double decay : {0.0, 1.0, 30.0})
        for (const std::int64_t afterMs : {1, 10, 79, 81, 150}) {
            PadMotors motors{PadModel{}};
            motors.strike(ringing(1.0, 5100, decay), grips());
            EXPECT_GT(strongestUntil(motors, (100 + afterMs) * ms), 0.0);
            motors.stop((100 + afterMs) * ms);
            EXPECT_EQ(strongestUntil(motors, 6000 * ms), 0.0) << afterMs << " ms, decay " << decay;
        }
}

/// A store of 64 that do not merge; who is left is heard by how long it goes on.
TEST(FullMotors, LoseTheWeakestWhicheverThatIs) {
    for (const double amplitude : {0.1, 0.3, 0.9}) { // of one more: weaker, stronger than the weakest
        PadMotors motors{PadModel{}};
        const auto strike = [&](double a, std::int64_t endMs) { motors.strike(ringing(a, endMs), grips()); };
        for (int i = 0; i < 63; ++i) strike(0.5, 200);
        strike(0.2, 1000);
        strike(amplitude, 2000);
        EXPECT_GT(strongestUntil(motors, 150 * ms), 0.0);
        EXPECT_EQ(motors.lost(), 1U);
        strongestUntil(motors, 500 * ms);
        EXPECT_GT(strongestUntil(motors, 900 * ms), 0.0) << amplitude;
        strongestUntil(motors, 1300 * ms);
        EXPECT_EQ(strongestUntil(motors, 1900 * ms) > 0.0, amplitude > 0.2) << amplitude;
    }
}

} // namespace physvib::pad_motors_test
