// SPDX-License-Identifier: MIT
// The checks behind validate(), one small function for each part of a scene.
#include "Physics/SceneValidation.h"
#include "Core/Limits.h"
#include <initializer_list>
#include <locale>
#include <sstream>
#include <string_view>

namespace physvib {

namespace {

using namespace sceneLimits;

/// "field: expected low to high", or empty. Also refuses what is not a number.
std::string range(std::string_view field, double value, double low, double high) {
    if (value >= low && value <= high) return {};
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text << field << ": expected " << low << " to " << high << ", found " << value;
    return text.str();
}

std::string firstOf(std::initializer_list<std::string> faults) {
    for (const std::string& fault : faults)
        if (!fault.empty()) return fault;
    return {};
}

std::string check(const Material& m) {
    return firstOf(
        {range("density", m.densityKgPerSquareMetre, minDensityKgPerSquareMetre, maxDensityKgPerSquareMetre),
         range("friction", m.friction, 0.0, maxFriction), range("restitution", m.restitution, 0.0, 1.0),
         range("frequency", m.frequencyHz, 0.0, limits::maxFrequencyHz),
         range("decay", m.decayPerSecond, 0.0, limits::maxDecayPerSecond)});
}

std::string check(const CircleShape& c) {
    return range("radius", c.radiusMetres, minSizeMetres, maxSizeMetres);
}
std::string check(const BoxShape& b) {
    return firstOf({range("width", b.widthMetres, minSizeMetres, maxSizeMetres),
                    range("height", b.heightMetres, minSizeMetres, maxSizeMetres)});
}

std::string checkCamera(const BodyDescription& body, const Material& material) {
    if (!body.isCamera) return {};
    if (body.isStatic && body.staticMassKg <= 0.0)
        return "mass: a static camera body has none in Box2D, expected one above 0 kg";
    if (material.frequencyHz <= 0.0 || material.decayPerSecond <= 0.0)
        return "material: a camera body vibrates, expected a frequency and a decay above 0";
    return {};
}

std::string check(const BodyDescription& body, const Scene& scene) {
    if (body.material < 0 || static_cast<std::size_t>(body.material) >= scene.materials.size())
        return "material: expected one of the " + std::to_string(scene.materials.size()) + " of the scene";
    const double reach = maxPositionMetres;
    return firstOf({std::visit([](const auto& shape) { return check(shape); }, body.shape),
                    range("x", body.position.xMetres, -reach, reach),
                    range("y", body.position.yMetres, -reach, reach),
                    range("angle", body.angleRadians, -reach, reach),
                    range("mass", body.staticMassKg, 0.0, maxStaticMassKg),
                    checkCamera(body, scene.materials[static_cast<std::size_t>(body.material)])});
}

std::string check(const GravityInput& input, double earliestSeconds, double latestSeconds) {
    const double most = maxAccelerationMetresPerSecond2;
    return firstOf({range("time", input.timeSeconds, earliestSeconds, latestSeconds),
                    range("x", input.xMetresPerSecond2, -most, most),
                    range("y", input.yMetresPerSecond2, -most, most)});
}

std::string place(std::string_view list, std::size_t index, std::string_view name, const std::string& fault) {
    if (fault.empty()) return {};
    std::string text = std::string(list) + " " + std::to_string(index);
    if (!name.empty()) text += " (" + std::string(name) + ")";
    return text + ", " + fault;
}

std::string checkScript(const Scene& scene) {
    const double period = scene.scriptPeriodSeconds;
    if (auto fault = range("script period", period, 0.0, maxScriptSeconds); !fault.empty()) return fault;
    double earliest = 0.0; // inputs are in time order
    for (std::size_t i = 0; i < scene.script.size(); ++i) {
        const std::string fault = check(scene.script[i], earliest, period > 0.0 ? period : maxScriptSeconds);
        if (!fault.empty()) return place("script input", i, {}, fault);
        earliest = scene.script[i].timeSeconds;
    }
    return {};
}

} // namespace

std::string validate(const Scene& scene) {
    const std::string whole =
        firstOf({range("field width", scene.fieldWidthMetres, minSizeMetres, maxPositionMetres),
                 range("field height", scene.fieldHeightMetres, minSizeMetres, maxPositionMetres),
                 range("drive gain", scene.driveGain, 0.0, maxDriveGain)});
    if (!whole.empty()) return whole;
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
        if (auto fault = place("material", i, scene.materials[i].name, check(scene.materials[i]));
            !fault.empty())
            return fault;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
        if (auto fault = place("body", i, scene.bodies[i].name, check(scene.bodies[i], scene));
            !fault.empty())
            return fault;
    return checkScript(scene);
}

} // namespace physvib
