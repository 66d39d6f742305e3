// SPDX-License-Identifier: MIT
// Measures motor strength as the standard deviation of the acceleration in short windows, minus that at rest.
#include "Live/Pads/PadTrial.h"
#include "Io/Text/NumberText.h"
#include <algorithm>
#include <cmath>
#include <tuple>

namespace physvib {
namespace {

constexpr double onSeconds = 0.75, restSeconds = 0.75, repeatSeconds = 0.1;
constexpr double steadySeconds = 0.4;  // s after a step's begin; motors need 0.2 s
constexpr double windowSeconds = 0.04; // a few revolutions of the heavy motor
constexpr double minShare = 0.08;      // of the largest strength; below it the motor does not turn
constexpr double minPeakRatio = 4.0;   // largest strength to that at rest; below it nothing moved

/// Variance summed over the axes, within [start, end); 0 for fewer than three samples.
double variance(const PadStep& step, double start, double end) {
    double sum = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        double n = 0.0, mean = 0.0, squares = 0.0;
        for (const PadStep::Sample& sample : step.samples) {
            if (sample.seconds < start || sample.seconds >= end) continue;
            const double value = static_cast<double>(sample.metresPerSecond2[axis]), deviation = value - mean;
            mean += deviation / ++n;
            squares += deviation * (value - mean);
        }
        if (n >= 3.0) sum += squares / n;
    }
    return sum;
}

/// The command at which a rising series of strengths crosses `level`, interpolated.
double commandAt(double level, const std::vector<PadStep>& steps, const std::vector<double>& strengths) {
    for (std::size_t i = 0; i < steps.size(); ++i) {
        if (strengths[i] < level) continue;
        if (i == 0) return steps[0].command * level / strengths[0];
        return steps[i - 1].command + (steps[i].command - steps[i - 1].command) * (level - strengths[i - 1]) /
                                          (strengths[i] - strengths[i - 1]);
    }
    return steps.back().command;
}

/// Plays ten impacts of 20 ms with increasing level, as `play` sends them; false: ended early.
bool playHits(GamePad& pad, const PadModel& law, const PadTrialClock& clock) {
    ActuatorLayout phone;
    layoutPreset("phone2", phone);
    const PhantomPanner grips = PadMotors::makeGripPanner({phone, PanningLaw::linear, 1.0, 1.0, 1.0});
    PadMotors motors{law};
    constexpr std::int64_t intervalNs = 600'000'000;
    for (int i = 1; i <= 10; ++i) {
        CollisionEvent hit;
        hit.timeNs = i * intervalNs;
        hit.durationNs = 20'000'000;
        hit.frequencyHz = 60.0;
        hit.amplitude = i / 10.0;
        hit.x = hit.y = 0.5;
        motors.strike(hit, grips);
    }
    const double beginSeconds = clock.seconds();
    PadCommand lastCommand;
    for (; clock.keepGoing() && pad.isAttached(); clock.tick()) {
        if (motors.dueNs() == PadMotors::never) return pad.rumble(0.0, 0.0), true;
        if (static_cast<double>(motors.dueNs()) * 1e-9 > clock.seconds() - beginSeconds) continue;
        const PadCommand command = motors.next(1.0);
        if (!command.isSame(lastCommand)) pad.rumble(command.low, command.high);
        lastCommand = command;
    }
    pad.rumble(0.0, 0.0);
    return false;
}

double rounded(double value) { return std::round(1000.0 * value) / 1000.0; }

} // namespace

bool holdMotors(GamePad& pad, double low, double high, double seconds, const PadTrialClock& clock) {
    const double end = clock.seconds() + seconds;
    for (double next = 0.0; clock.keepGoing() && pad.isAttached(); clock.tick()) {
        if (clock.seconds() >= end) return true;
        if (clock.seconds() < next) continue;
        pad.rumble(low, high);
        next = clock.seconds() + repeatSeconds;
    }
    pad.rumble(0.0, 0.0);
    return false;
}

Result<std::vector<PadStep>> recordMotor(GamePad& pad, bool isHeavy, const PadTrialClock& clock) {
    std::vector<PadStep> steps;
    std::array<float, 3> reading{}, lastReading{};
    if (!pad.acceleration(reading))
        return Failure{
            pad.info().name +
            ": it does not tell its acceleration; DualSense, DualShock 4 and Switch controllers do"};
    for (int tenth = 1; tenth <= 10; ++tenth) {
        PadStep& step = steps.emplace_back();
        step.command = tenth / 10.0;
        step.onSeconds = onSeconds;
        const double begin = clock.seconds();
        PadTrialClock sampling = clock;
        sampling.tick = [&] {
            clock.tick();
            // each sensor report counts once
            if (pad.acceleration(reading) && reading != lastReading)
                step.samples.push_back({clock.seconds() - begin, reading});
            lastReading = reading;
        };
        const bool isWhole = holdMotors(pad, isHeavy ? step.command : 0.0, isHeavy ? 0.0 : step.command,
                                        onSeconds, sampling) &&
                             holdMotors(pad, 0.0, 0.0, restSeconds, sampling);
        if (!isWhole)
            return Failure{pad.isAttached() ? "ended before it was measured" : pad.info().name + " is gone"};
    }
    return steps;
}

Result<PadMotor> fitMotor(const std::vector<PadStep>& steps) {
    if (steps.size() < 3) return Failure{"expected at least three steps"};
    double noise = INFINITY;
    for (const PadStep& step : steps)
        noise =
            std::min(noise, variance(step, step.onSeconds + 0.6 * restSeconds, step.onSeconds + restSeconds));
    const auto strength = [noise](const PadStep& step, double start, double end) {
        return std::sqrt(std::max(0.0, variance(step, start, end) - noise));
    };
    std::vector<double> strengths;
    for (const PadStep& step : steps)
        strengths.push_back(std::max(strengths.empty() ? 0.0 : strengths.back(),
                                     strength(step, steadySeconds, step.onSeconds)));
    const double peak = strengths.back();
    if (!(peak * peak > minPeakRatio * minPeakRatio * noise) || !(peak > 0.0))
        return Failure{"nothing moved: is the controller lying on something soft?"};
    PadMotor motor;
    const auto firstTurning = std::ranges::find_if(strengths, [&](double s) { return s >= minShare * peak; });
    const auto first = static_cast<std::size_t>(firstTurning - strengths.begin());
    motor.threshold = first == 0 ? 0.0 : rounded(0.5 * (steps[first - 1].command + steps[first].command));
    motor.half = std::clamp(rounded(commandAt(0.5 * peak, steps, strengths)), motor.threshold + 0.01, 0.98);
    motor.full = std::clamp(rounded(commandAt(0.98 * peak, steps, strengths)), motor.half + 0.01, 1.0);
    const PadStep& fullStep = steps.back();
    const auto secondsTo = [&](double start, auto isReached) {
        for (double t = start; t < fullStep.onSeconds + restSeconds - windowSeconds; t += 0.002)
            if (isReached(strength(fullStep, t - 0.5 * windowSeconds, t + 0.5 * windowSeconds)))
                return t - start;
        return restSeconds;
    };
    motor.riseSeconds = std::max(0.005, rounded(secondsTo(0.0, [&](double s) { return s >= 0.9 * peak; })));
    motor.fallSeconds =
        std::max(0.005, rounded(secondsTo(fullStep.onSeconds, [&](double s) { return s <= 0.1 * peak; })));
    return motor;
}

std::string tryMotors(GamePad& pad, const PadModel& law, const PadTrialClock& clock,
                      const std::function<void(const std::string&)>& say) {
    const auto reason = [&pad] {
        return pad.isAttached() ? "ended before its time" : pad.info().name + " is gone";
    };
    for (const auto& [motorName, low, high] :
         {std::tuple{"heavy motor, left grip", 1.0, 0.0}, {"light motor, right grip", 0.0, 1.0}})
        for (const double command : {0.2, 0.4, 0.7, 1.0}) {
            say(std::string{motorName} + ": command " + numberText(command));
            if (!holdMotors(pad, low * command, high * command, 0.7, clock) ||
                !holdMotors(pad, 0.0, 0.0, 0.5, clock))
                return reason();
        }
    say("ten hits of 20 ms, from 0.1 to 1 of full scale: all of them should be felt");
    return playHits(pad, law, clock) ? "" : reason();
}

} // namespace physvib
