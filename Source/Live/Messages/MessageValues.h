// SPDX-License-Identifier: MIT
// Typed access to the values of one message by argument name, with all error texts, and the conversion of
// messages to the events that they play.
#pragma once
#include "Core/EventShaping.h"
#include "Core/PhantomPanner.h"
#include "Live/Documents/InputLine.h"
#include "Live/Messages/MessageRouter.h"
#include "Scene/Scene.h"
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {
/// A one-line error about a message. Not thrown out of this module.
struct MessageError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The checked values of one message. All methods throw MessageError. Any thread but the render thread (R).
class MessageValues {
public:
    /// `message` is one of the table; all must outlive this object. Throws if a value is unknown to the
    /// message or occurs twice.
    MessageValues(const PlainMessage& message, const MessageDescription& description,
                  const PhantomPanner& panner);

    bool has(std::string_view name) const { return find(name) != nullptr; }
    double number(std::string_view name) const; ///< a number in range, or the default
    int wholeNumber(std::string_view name) const;
    std::string text(std::string_view name) const; ///< without a value the default
    bool isText(std::string_view name) const;
    std::vector<double> numbers(std::string_view name) const;
    Spread spread() const;       ///< of the argument `law`
    ActuatorPlace place() const; ///< in metres of the field
    std::vector<ActuatorPlace> places() const;

    /// The actuator's place, in metres of the field.
    ActuatorPlace actuatorPlace(std::string_view name, char letter) const;

    /// Throws if more than one of these was given.
    void expectOneOf(std::initializer_list<std::string_view> names) const;
    [[noreturn]] void fail(std::string_view name, const std::string& what) const;

private:
    const PlainValue* find(std::string_view name) const;
    const MessageArgument& argument(std::string_view name) const;
    double inRange(const MessageArgument& argument, double found) const;

    const PlainMessage& message_;
    const MessageDescription& description_;
    const PhantomPanner& panner_;
};

// Converts a message to the events that it plays.

/// Tactile Brush (Israr and Poupyrev 2011): delay of stroke onsets, as a share of the stroke plus seconds.
constexpr double strokeOnsetShare = 0.32, strokeOnsetSeconds = 0.0473;

/// Onset delay at which strokes of `strokeSeconds` are felt as one motion. Any thread.
constexpr double strokeOnsetDelaySeconds(double strokeSeconds) noexcept {
    return strokeOnsetShare * strokeSeconds + strokeOnsetSeconds;
}

/// Length of each of `strokes` (2 or more) so that all together take `seconds`; 0 or less: there is not
/// enough time. Any thread.
constexpr double strokeSeconds(int strokes, double seconds) noexcept {
    return (seconds - strokeOnsetSeconds * (strokes - 1)) / (strokeOnsetShare * (strokes - 1) + 1.0);
}

/// Events of a `clip`: one per channel, from time 0 on, at its place, without the frequency under which the
/// session keeps it. `panner` supplies the actuators' places. Throws MessageError. Any thread but R.
std::vector<CollisionEvent> clipStrikes(const MessageValues& values, const LoadedClip& clip,
                                        const PhantomPanner& panner);

} // namespace physvib
