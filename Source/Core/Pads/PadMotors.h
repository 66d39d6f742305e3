// SPDX-License-Identifier: MIT
// From events to commands of a game controller's two motors.
//
// What all modes would do is summed as energy, so that a weak hit never ends a strong one. The sum is shared
// between the motors by frequency and place. A model of each motor says how strong it is by now: at an onset
// it is overdriven until it is as strong as the hit asks for, and while anything is to be felt no command is
// below its threshold. The same events give the same commands, live and offline, as all times are those of
// the events.
#pragma once
#include "Core/CollisionEvent.h"
#include "Core/Pads/PadLaw.h"
#include "Core/PhantomPanner.h"
#include <array>
#include <cstdint>

namespace physvib {

/// What both motors are to do from then on; steps of 1/100, as no motor follows finer ones.
struct PadCommand {
    std::int64_t timeNs = 0;
    double low = 0.0, high = 0.0;
    bool isSame(const PadCommand& other) const noexcept { return low == other.low && high == other.high; }
};

/// No memory is allocated, nothing waits. One thread at a time.
class PadMotors {
public:
    static constexpr std::int64_t never = INT64_MAX;
    static constexpr double leastFelt = 0.2; ///< strength of the weakest hit that is to be felt; assumed
    static constexpr std::int64_t kickNs = 80'000'000; ///< an onset is overdriven for so long at most

    explicit PadMotors(const PadLaw& law) noexcept
        : law_{law} {}

    /// A layout of two, one per grip, over that field. Any thread.
    static PhantomPanner gripsOf(const PhantomPanner& field) noexcept;

    /// An event at the session time at which it is to be felt; late ones begin at once. Clips are left out,
    /// as nothing is known of their level. False if too many wait.
    bool strike(const CollisionEvent& event, const PhantomPanner& grips) noexcept;

    /// What rings then, and what would be felt before, is forgotten; the next command is not before it.
    void stop(std::int64_t atNs) noexcept;

    /// When the next command is due, never before the last one and the law's interval; never: motors are at
    /// rest.
    std::int64_t dueNs() const noexcept;

    /// The command that is due; everything is `level` times as strong, and nothing is felt at 0.
    PadCommand next(double level) noexcept;

    std::uint64_t lost() const noexcept { return lost_; } ///< events for which there was no room

private:
    struct Voice {
        std::int64_t startNs = 0, endNs = 0; // both earlier than felt, by the law's lead; cut at (0: rings
                                             // out)
        double decayPerSecond = 0.0;
        double low = 0.0, high = 0.0;          // energy at the start
        double energy = 0.0, heavyShare = 0.0; // of what moves, whose place is looked at again
        double fromSide = 0.0, toSide = 0.0;   // 0: left, 1: right
        std::int64_t travelNs = 0;
        bool mayMerge() const noexcept { return endNs == 0 && travelNs == 0; }
    };
    struct Energies {
        double low = 0.0, high = 0.0;
    };
    struct State {
        double strength = 0.0, command = 0.0; // as modelled; the last one
        double kick = 0.0;                    // strength that an onset asks for; 0: none
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
    std::int64_t lastNs_ = INT64_MIN / 2; // of the last command
    std::int64_t stopNs_ = INT64_MIN / 2; // nothing is commanded before
    std::uint64_t lost_ = 0;
};

} // namespace physvib
