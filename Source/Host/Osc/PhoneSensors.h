// SPDX-License-Identifier: GPL-3.0-or-later
// From what sensor programs of phones send to the gravity of a world that is held in a hand. Their formats
// and where they are told: Docs/osc.md.
#pragma once
#include "Core/StandardGravity.h"
#include "Host/Osc/OscPacket.h"
#include "Scene/Scene.h"
#include <array>
#include <optional>
#include <string_view>

namespace physvib {

/// A message of a program: three numbers, or one of an axis.
struct SensorFormat {
    enum class Part { pull, gravity, motion, x, y, unused };
    std::string_view address; ///< `*` at the beginning stands for the phone's own name
    Part part;
    double toPull; ///< what it says, times this, is the pull on a thing in the phone, in m/s^2: + x to the
                   ///< right of its screen, + y up
};

// An accelerometer at rest says what holds it up; iPhones turn that round.
inline constexpr double androids = -1.0, iPhones = standardGravity;
inline constexpr std::array sensorFormats{
    SensorFormat{"/accelerometer", SensorFormat::Part::pull, androids},
    SensorFormat{"/accelerometer/X", SensorFormat::Part::x, androids},
    SensorFormat{"/accelerometer/Y", SensorFormat::Part::y, androids},
    SensorFormat{"/accelerometer/Z", SensorFormat::Part::unused, androids},
    SensorFormat{"/accxyz", SensorFormat::Part::pull, iPhones},
    SensorFormat{"/gyrosc/grav", SensorFormat::Part::gravity, iPhones},
    SensorFormat{"/gyrosc/accel", SensorFormat::Part::motion, iPhones},
    SensorFormat{"*/gravity", SensorFormat::Part::gravity, iPhones},
    SensorFormat{"*/accel", SensorFormat::Part::motion, iPhones}};

/// The format of that address; null: none. Any thread.
const SensorFormat* sensorFormat(std::string_view address) noexcept;

/// One thread at a time.
class PhoneSensors {
public:
    /// A hand that rests shakes by less: a reading that is nearer to the last one that was used says nothing
    /// new.
    static constexpr double leastChange = 0.05; // m/s^2; 0.3 degrees

    /// The phone is held so much counter-clockwise of upright.
    explicit PhoneSensors(double turnRadians = 0.0) noexcept
        : turnRadians_{turnRadians} {}

    /// Gravity as it is from now on, if that is news; none is. Or what is wrong.
    Result<std::optional<GravityAction>> take(const SensorFormat& format, const OscMessage& message);

private:
    struct Pull {
        double x = 0.0, y = 0.0;
    };
    double turnRadians_;
    Pull gravity_, motion_, told_;
    bool hasTold_ = false;
};

} // namespace physvib
