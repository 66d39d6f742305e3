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
#include "Core/Pads/PadLaw.h"
#include "Core/PhantomPanner.h"
#include <array>
#include <cstdint>

namespace physvib {

/// Commands of both motors from `timeNs` on, in steps of 1/100: motors do not resolve finer ones.
struct PadCommand {
    std::int64_t timeNs = 0;
    double low = 0.0, high = 0.0;
    bool isSame(const PadCommand& other) const noexcept { return low == other.low && high == other.high; }
};

/// Neither allocates nor blocks. One thread at a time.
class PadMotors {
public:
    static constexpr std::int64_t never = INT64_MAX;
    static constexpr double leastFelt = 0.2; ///< strength of the weakest perceptible impact; assumed
    static constexpr std::int64_t kickNs = 80'000'000; ///< maximum time for which an onset is overdriven

    explicit PadMotors(const PadLaw& law) noexcept
        : law_{law} {}

    /// A layout of two places, one per grip, over that field. Any thread.
    static PhantomPanner gripsOf(const PhantomPanner& field) noexcept;

    /// Adds an event at the session time at which it is to be felt; late events begin at once. Clips are
    /// skipped, because their level is not known. False if too many are pending.
    bool strike(const CollisionEvent& event, const PhantomPanner& grips) noexcept;

    /// Ends all voices and discards events before `atNs`; the next command is not earlier.
    void stop(std::int64_t atNs) noexcept;

    /// When the next command is due, not before the law's interval has passed since the last; `never`: the
    /// motors are at rest.
    std::int64_t dueNs() const noexcept;

    /// The command that is due, with all strengths multiplied by `level`; 0 stops the motors.
    PadCommand next(double level) noexcept;

    std::uint64_t lost() const noexcept { return lost_; } ///< events for which there was no room

private:
    struct Voice {
        std::int64_t startNs = 0, endNs = 0; // both earlier than felt, by the law's lead; endNs 0: decays
                                             // fully
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
    struct State {
        double strength = 0.0, command = 0.0; // as modelled; last command
        double kick = 0.0;                    // strength requested by an onset; 0: none
        std::int64_t kickEndNs = 0;
    };

    std::int64_t intervalNs() const noexcept {
        return static_cast<std::int64_t>(1e9 / law_.commandsPerSecond);
    }
    std::int64_t leadNs() const noexcept { return static_cast<std::int64_t>(1e9 * law_.leadSeconds); }
    Energies shared(double energy, double heavyShare, double side) const noexcept;
    Energies energiesAt(const Voice& voice, std::int64_t timeNs) const noexcept;
    double wanted(double amplitude) const noexcept;
    void beginUntil(std::int64_t nowNs, double level) noexcept;
    void begin(const Voice& voice, double level) noexcept;
    Energies ringingAt(std::int64_t nowNs) noexcept;
    void add(const Voice& voice) noexcept;
    double drive(State& state, const PadMotor& motor, double amplitude, double seconds) const noexcept;
    bool isAtRest() const noexcept { return ringing_ == 0 && low_.command == 0.0 && high_.command == 0.0; }

    PadLaw law_;
    std::array<Voice, 256> waiting_{}; // by startNs
    std::array<Voice, 64> voices_{};
    std::size_t waits_ = 0, ringing_ = 0;
    State low_, high_;
    std::int64_t lastNs_ = INT64_MIN / 2; // time of the last command
    std::int64_t stopNs_ = INT64_MIN / 2; // no command is sent before it
    std::uint64_t lost_ = 0;
};

} // namespace physvib
