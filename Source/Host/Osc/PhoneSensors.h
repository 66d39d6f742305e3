// SPDX-License-Identifier: GPL-3.0-or-later
// Turns the readings of phone sensor programs into gravity in the world, so that tilting the phone tilts the
// world. Formats: Docs/osc.md.
#pragma once
#include "Core/Units.h"
#include "Host/Osc/OscPacket.h"
#include "Scene/Scene.h"
#include <array>
#include <optional>
#include <string_view>

namespace physvib {

/// A message of a sensor program: three axes, or one axis.
struct SensorFormat {
    enum class Part { pull, gravity, motion, x, y, unused };
    std::string_view address; ///< a leading `*` stands for the phone's name
    Part part;
    double toPull; ///< factor from reading to acceleration on an object in the phone, in m/s^2; x to the
                   ///< right of its screen, y up
};

// An accelerometer at rest reads the supporting force, upwards; iPhones report the opposite sign, in g.
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

/// The format of that address; null: unknown. Any thread.
const SensorFormat* sensorFormat(std::string_view address) noexcept;

/// One thread at a time.
class PhoneSensors {
public:
    /// Changes below this are tremor of a resting hand: a reading closer than that to the last one used is
    /// ignored.
    static constexpr double leastChange = 0.05; // m/s^2; 0.3 degrees

    /// `turnRadians`: angle at which the phone is held, counter-clockwise from upright.
    explicit PhoneSensors(double turnRadians = 0.0) noexcept
        : turnRadians_{turnRadians} {}

    /// The new gravity, if it has changed; otherwise none. Or the error.
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
