// SPDX-License-Identifier: MIT
// Converts events to commands of a game controller's two rumble motors.
//
// The levels of all modes are summed as energy, so that a weak impact never ends a strong one. The sum is
// shared between the motors by frequency and place. A model of each motor estimates its current strength. At
// an onset the motor is overdriven until it reaches the impact's strength; while anything is perceptible no
// command is below its threshold. All times are those of the events, so the same events give the same
// commands, live and offline.
#pragma once
#include "Core/CollisionEvent.h"
#include "Core/PhantomPanner.h"
#include "Core/PortableMath.h"
#include <algorithm>
#include <array>
#include <cstdint>

namespace physvib {

/// A motor of a game controller (Docs/pads.md names the sources of the figures): a command from 0 to 1 leads,
/// with delay, to a strength from 0 to 1.
struct PadMotor {
    double threshold = 0.3;    ///< command below which the motor does not turn
    double half = 0.5;         ///< command that gives half of the strength
    double full = 0.86;        ///< command above which it gets no stronger
    double riseSeconds = 0.15; ///< from rest to 90 % of the commanded strength
    double fallSeconds = 0.15; ///< from there to 10 %
    bool operator==(const PadMotor&) const = default;

    /// Steady-state strength of a command: straight lines through (threshold, 0), (half, 1/2) and (full, 1).
    /// Any thread, as all functions here.
    double strengthOf(double command) const noexcept {
        if (command <= threshold) return 0.0;
        if (command <= half) return 0.5 * (command - threshold) / (half - threshold);
        return std::min(1.0, 0.5 + 0.5 * (command - half) / (full - half));
    }
    /// The command that gives this strength; for 1 and more, a command of 1.
    double commandOf(double strength) const noexcept {
        if (strength >= 1.0) return 1.0;
        if (strength <= 0.5) return threshold + 2.0 * std::max(0.0, strength) * (half - threshold);
        return half + (2.0 * strength - 1.0) * (full - half);
    }
    /// The share of a change of strength that is reached after `seconds`: a first-order lag.
    double shareOfChange(double seconds, bool rises) const noexcept {
        constexpr double logOfTen = 2.302585092994046;
        return 1.0 - portable::exp(-logOfTen * seconds / (rises ? riseSeconds : fallSeconds));
    }
    double strengthAfter(double strength, double command, double seconds) const noexcept {
        const double target = strengthOf(command);
        return strength + (target - strength) * shareOfChange(seconds, target > strength);
    }
};

/// Parameters of the conversion of events to commands for two motors.
struct PadModel {
    PadMotor low{}, high{};          ///< the heavy motor, in the left grip; the light one, in the right grip
    double commandsPerSecond = 30.0; ///< at most; more of them queue up on the link
    double leadSeconds = 0.03; ///< an impact's command is sent this much earlier, because motors are slow
    double splitHz = 100.0;    ///< below it the heavy motor has the larger share
    double placeWeight = 0.5;  ///< weight of the impact's place beside its frequency, 0 to 1
    double floor = 0.01;       ///< weakest perceptible amplitude, of full scale
    double exponent = 0.7;     ///< strength grows with this power of the amplitude
    bool operator==(const PadModel&) const = default;
};

/// Commands of both motors from `timeNs` on, in steps of 1/100: motors do not resolve finer ones.
struct PadCommand {
    std::int64_t timeNs = 0;
    double low = 0.0, high = 0.0;
    bool isSame(const PadCommand& other) const noexcept { return low == other.low && high == other.high; }
};

/// Converts events to the commands of one controller. Neither allocates nor blocks. One thread at a time.
class PadMotors {
public:
    static constexpr std::int64_t never = INT64_MAX;
    static constexpr double minPerceptibleStrength = 0.2; ///< strength of the weakest perceptible impact;
                                                          ///< assumed
    static constexpr std::int64_t kickNs = 80'000'000;    ///< maximum time for which an onset is overdriven

    explicit PadMotors(const PadModel& pad) noexcept
        : pad_{pad} {}

    /// A layout of two places, one per grip, over that field. Any thread.
    static PhantomPanner makeGripPanner(const PhantomPanner& field) noexcept;

    /// Adds an event at the session time at which it is to be felt; late events begin at once. Clips are
    /// skipped, because their level is not known. If too many are pending, the weakest is lost; false if it
    /// is this one.
    bool strike(const CollisionEvent& event, const PhantomPanner& gripPanner) noexcept;

    /// Ends all voices and discards events before `atNs`; the next command is not earlier.
    void stop(std::int64_t atNs) noexcept;

    /// When the next command is due, not before the law's interval has passed since the last; `never`: the
    /// motors are at rest.
    std::int64_t dueNs() const noexcept;

    /// The command that is due, with all strengths multiplied by `level`; 0 stops the motors.
    PadCommand next(double level) noexcept;

    /// The commands that were due until a time: the strongest per motor, so that no impact is lost when the
    /// caller is late, and the last one, to be sent after it.
    struct DueCommands {
        PadCommand strongest, last;
        int count = 0;
    };
    /// Computes the commands that are due until `untilNs`, at most a thousand; the next call continues.
    DueCommands nextUntil(std::int64_t untilNs, double level) noexcept;

    std::int64_t intervalNs() const noexcept { ///< between two commands
        return static_cast<std::int64_t>(1e9 / pad_.commandsPerSecond);
    }
    std::uint64_t lost() const noexcept { return lost_; } ///< events for which there was no room

private:
    struct Voice {
        std::int64_t startNs = 0, endNs = 0; // earlier than the event by the law's lead; endNs 0: it decays
        double decayPerSecond = 0.0;
        double low = 0.0, high = 0.0;          // energy at the start
        double energy = 0.0, heavyShare = 0.0; // of a moving event, whose place is recomputed
        double fromSide = 0.0, toSide = 0.0;   // 0: left, 1: right
        std::int64_t travelNs = 0;
        bool mayMerge() const noexcept { return endNs == 0 && travelNs == 0; }
    };
    struct Energies {
        double low = 0.0, high = 0.0;
    };
    struct MotorState {
        double strength = 0.0, command = 0.0; // as modelled; last command
        double kick = 0.0;                    // strength requested by an onset; 0: none
        std::int64_t kickEndNs = 0;
    };

    std::int64_t leadNs() const noexcept { return static_cast<std::int64_t>(1e9 * pad_.leadSeconds); }
    Energies shareEnergy(double energy, double heavyShare, double side) const noexcept;
    Energies energiesAt(const Voice& voice, std::int64_t timeNs) const noexcept;
    double strengthFor(double amplitude) const noexcept;
    void beginUntil(std::int64_t nowNs, double level) noexcept;
    void begin(const Voice& voice, double level) noexcept;
    Energies soundingEnergiesAt(std::int64_t nowNs) noexcept;
    void add(const Voice& voice) noexcept;
    double drive(MotorState& state, const PadMotor& motor, double amplitude, double seconds) const noexcept;
    bool isAtRest() const noexcept {
        return soundingCount_ == 0 && low_.command == 0.0 && high_.command == 0.0;
    }

    PadModel pad_;
    std::array<Voice, 256> pending_{}; // by startNs
    std::array<Voice, 64> voices_{};
    std::size_t pendingCount_ = 0, soundingCount_ = 0;
    MotorState low_, high_;
    std::int64_t lastNs_ = INT64_MIN / 2; // time of the last command
    std::int64_t stopNs_ = INT64_MIN / 2; // no command is sent before it
    std::uint64_t lost_ = 0;
};

} // namespace physvib
