// SPDX-License-Identifier: MIT
// A controller in numbers: what it is measured to be is what it is.
#include "Live/Pads/PadTrial.h"
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace physvib::pad_trial_test {

/// Two motors on a sensor of 250 reports a second, in a time of its own.
class NumberPad final : public GamePad {
public:
    explicit NumberPad(const PadMotor& heavy, const PadMotor& light)
        : motors_{heavy, light} {
        info_.name = "numbers";
        info_.hasMotors = info_.hasAccelerometer = true;
    }
    const GamePadInfo& info() const noexcept override { return info_; }
    bool isAttached() override { return isAttached_; }
    bool rumble(double low, double high) override {
        commands_[0] = low, commands_[1] = high;
        return true;
    }
    bool acceleration(std::array<float, 3>& a) override {
        a = told_;
        return info_.hasAccelerometer;
    }
    bool sendEffect(const void*, int) override { return false; }

    void tick() {
        seconds_ += 0.001;
        double along = 0.0;
        for (std::size_t m = 0; m < 2; ++m) {
            strengths_[m] = motors_[m].strengthAfter(strengths_[m], commands_[m], 0.001);
            along += 6.0 * strengths_[m] * std::sin(2.0 * std::numbers::pi * (m ? 173.0 : 61.0) * seconds_);
        }
        if (std::lround(1e3 * seconds_) % 4 != 0) return;
        const auto noise = [&] { return 0.05 * (static_cast<double>(random_()) / 2147483648.0 - 1.0); };
        told_ = {static_cast<float>(along + noise()), static_cast<float>(9.81 + noise()),
                 static_cast<float>(0.5 * along + noise())};
    }
    double strongest() const { return std::max(commands_[0], commands_[1]); }
    PadTrialClock time(double endSeconds = 1e9) {
        return {[this] { return seconds_; }, [this] { tick(); },
                [this, endSeconds] { return seconds_ < endSeconds; }};
    }

    GamePadInfo info_;
    bool isAttached_ = true;

private:
    const PadMotor motors_[2];
    double commands_[2]{}, strengths_[2]{}, seconds_ = 0.0;
    std::array<float, 3> told_{0.0f, 9.81f, 0.0f};
    std::mt19937 random_{1};
};

TEST(PadTrial, FindsTheMotorsThatAreThere) {
    const PadMotor heavy{0.25, 0.5, 0.86, 0.19, 0.24}, light{0.35, 0.6, 0.95, 0.09, 0.12};
    NumberPad pad{heavy, light};
    for (const bool isHeavy : {true, false}) {
        const auto steps = recordMotor(pad, isHeavy, pad.time());
        ASSERT_TRUE(steps) << steps.error;
        const auto fitted = fitMotor(steps.value);
        ASSERT_TRUE(fitted) << fitted.error;
        const PadMotor &is = isHeavy ? heavy : light, &found = fitted.value;
        EXPECT_NEAR(found.threshold, is.threshold, 0.051);
        EXPECT_NEAR(found.half, is.half, 0.03);
        EXPECT_NEAR(found.full, is.full, 0.06);
        EXPECT_NEAR(found.riseSeconds, is.riseSeconds, 0.035);
        EXPECT_NEAR(found.fallSeconds, is.fallSeconds, 0.035);
        EXPECT_EQ(pad.strongest(), 0.0);
    }
}

TEST(PadTrial, ATrialThatCannotBeMeasuredSaysWhyAndLeavesMotorsAtRest) {
    NumberPad pad{{}, {}};
    EXPECT_EQ(recordMotor(pad, true, pad.time(3.0)).error, "ended before it was measured");
    EXPECT_EQ(pad.strongest(), 0.0);
    pad.isAttached_ = false;
    EXPECT_EQ(recordMotor(pad, true, pad.time()).error, "numbers is gone");
    pad.isAttached_ = true;
    pad.info_.hasAccelerometer = false;
    EXPECT_EQ(recordMotor(pad, true, pad.time()).error,
              "numbers: it does not tell its acceleration; DualSense, DualShock 4 and Switch controllers do");

    PadMotor dead;
    dead.threshold = 2.0; // nothing turns it
    NumberPad still{dead, dead};
    const auto steps = recordMotor(still, true, still.time());
    ASSERT_TRUE(steps);
    EXPECT_EQ(fitMotor(steps.value).error, "nothing moved: is the controller lying on something soft?");
}

TEST(PadTrial, AControllerThatLeavesInAnyPartIsNamedAndATrialThatEndsTellsIt) {
    NumberPad whole{{}, {}};
    int lines = 0;
    EXPECT_EQ(tryMotors(whole, {}, whole.time(), [&](const std::string&) { ++lines; }), "");
    EXPECT_EQ(lines, 9);
    EXPECT_GT(whole.time().seconds(), 15.6) << "eight steps of 1.2 s, and ten hits until 6 s";
    for (const double seconds : {0.3, 5.0, 9.7, 12.0, 15.5}) {
        NumberPad ended{{}, {}}, pulled{{}, {}};
        EXPECT_EQ(tryMotors(ended, {}, ended.time(seconds), [](const auto&) {}), "ended before its time");
        auto time = pulled.time();
        time.tick = [&] { pulled.tick(), pulled.isAttached_ = pulled.time().seconds() < seconds; };
        EXPECT_EQ(tryMotors(pulled, {}, time, [](const auto&) {}), "numbers is gone") << seconds;
        EXPECT_EQ(std::max(ended.strongest(), pulled.strongest()), 0.0);
    }
}

} // namespace physvib::pad_trial_test
