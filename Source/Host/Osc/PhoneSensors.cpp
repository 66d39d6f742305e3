// SPDX-License-Identifier: GPL-3.0-or-later
// Adds up gravity and motion readings of a phone, and rotates them by the angle at which it is held.
#include "Host/Osc/PhoneSensors.h"
#include "Io/Text/NumberText.h"
#include "Scene/SceneLimits.h"
#include <algorithm>
#include <cmath>

namespace physvib {
namespace {

bool isOf(std::string_view address, std::string_view format) {
    if (!format.starts_with('*')) return address == format;
    const auto rest = address.substr(std::min<std::size_t>(1, address.size())).find('/'); // skips the name
    return rest != std::string_view::npos && address.substr(rest + 1) == format.substr(1);
}

bool isReading(const OscValue& value) {
    return std::holds_alternative<double>(value) && std::isfinite(std::get<double>(value));
}

double bounded(double pull) {
    return std::clamp(pull, -sceneLimits::maxAccelerationMetresPerSecond2,
                      sceneLimits::maxAccelerationMetresPerSecond2);
}

} // namespace

const SensorFormat* sensorFormat(std::string_view address) noexcept {
    const auto found = std::ranges::find_if(
        sensorFormats, [&](const SensorFormat& format) { return isOf(address, format.address); });
    return found == sensorFormats.end() ? nullptr : &*found;
}

Result<std::optional<GravityAction>> PhoneSensors::take(const SensorFormat& format,
                                                        const OscMessage& message) {
    using Part = SensorFormat::Part;
    const bool isAxis = format.part == Part::x || format.part == Part::y || format.part == Part::unused;
    const std::size_t wanted = isAxis ? 1 : 3;
    if (message.values.size() != wanted || !std::ranges::all_of(message.values, isReading))
        return Failure{printable(message.address) + ": expected " + std::to_string(wanted) +
                       (isAxis ? " number" : " numbers")};
    const auto reading = [&](std::size_t i) { return format.toPull * std::get<double>(message.values[i]); };
    switch (format.part) {
    case Part::x: gravity_.x = reading(0); break;
    case Part::y: gravity_.y = reading(0); break;
    case Part::unused: return std::optional<GravityAction>{};
    case Part::motion: motion_ = {reading(0), reading(1)}; break;
    case Part::pull: motion_ = {}; [[fallthrough]];
    case Part::gravity: gravity_ = {reading(0), reading(1)};
    }
    const Pull pull{gravity_.x + motion_.x, gravity_.y + motion_.y};
    if (hasTold_ && std::hypot(pull.x - told_.x, pull.y - told_.y) < leastChange)
        return std::optional<GravityAction>{};
    told_ = pull;
    hasTold_ = true;
    const double c = std::cos(turnRadians_), s = std::sin(turnRadians_);
    return std::optional{GravityAction{{bounded(c * pull.x - s * pull.y), bounded(s * pull.x + c * pull.y)}}};
}

} // namespace physvib
