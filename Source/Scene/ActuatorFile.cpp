// SPDX-License-Identifier: MIT
// Reads actuator profiles with checks of every field, and writes them in a fixed order.
#include "Scene/ActuatorFile.h"
#include "Core/Limits.h"
#include "Io/Disk/Embedded.h"
#include "Io/Disk/ReadFile.h"
#include "Io/Json/JsonField.h"
#include "Io/Json/JsonText.h"
#include "Io/Text/NumberText.h"
#include "Scene/JsonWriter.h"
#include "Scene/SceneCatalogue.h"
#include "Scene/SceneFileLimits.h"
#include <array>

namespace physvib {

// Source/Scene/Actuators/*.json, in the order of their listing
const std::vector<EmbeddedFile>& embeddedActuators();

namespace {

constexpr const char* actuatorVersionField = "physvib_actuator";
constexpr std::array<std::string_view, 2> kindNames{"linear", "rotating"};

/// One figure of a profile: its field, its member, and its valid range.
struct Figure {
    const char* field;
    std::optional<double> ActuatorProfile::*member;
    double least, most;
};
constexpr Figure resonance{"resonance_hz", &ActuatorProfile::resonanceHz, limits::leastMeasuredHz,
                           limits::maxFrequencyHz};
constexpr Figure quality{"q", &ActuatorProfile::q, limits::leastQ, limits::mostQ};
constexpr std::array<Figure, 4> others{{{"drive_limit_v", &ActuatorProfile::driveLimitVolts, 0.001, 1000.0},
                                        {"rise_time_s", &ActuatorProfile::riseSeconds, 1e-5, 10.0},
                                        {"full_scale_g", &ActuatorProfile::fullScaleG, 1e-4, 1000.0},
                                        {"delay_s", &ActuatorProfile::delaySeconds, 0.0, 10.0}}};

void readFigure(const JsonField& root, const Figure& figure, ActuatorProfile& profile) {
    const JsonField json = root[figure.field];
    if (!json.isNull()) profile.*figure.member = json.numberWithin(figure.least, figure.most);
}

std::optional<FrequencyBand> readOptionalBand(const JsonField& json) {
    if (json.isNull()) return std::nullopt;
    if (const std::size_t size = json.arraySize(); size != 2)
        json.fail("expected [lowest, highest] or null, found " + std::to_string(size) + " items");
    const FrequencyBand band{json.item(0).numberWithin(limits::leastMeasuredHz, limits::maxFrequencyHz),
                             json.item(1).numberWithin(limits::leastMeasuredHz, limits::maxFrequencyHz)};
    if (!band.isKnown()) json.fail("expected a highest frequency above the lowest");
    return band;
}

ActuatorProfile readActuatorRoot(const JsonField& root) {
    checkVersion(root, actuatorVersionField, actuatorFormatVersion);
    root.expectObject({actuatorVersionField, "name", "description", "source", "kind", resonance.field,
                       quality.field, "band_hz", others[0].field, others[1].field, others[2].field,
                       others[3].field});
    ActuatorProfile profile;
    profile.name = root["name"].text();
    if (profile.name.empty()) root["name"].fail("expected a name, found an empty string");
    profile.description = root["description"].text();
    profile.source = root["source"].text();
    profile.kind = static_cast<ActuatorKind>(root["kind"].oneOf(kindNames));
    readFigure(root, resonance, profile);
    readFigure(root, quality, profile);
    profile.band = readOptionalBand(root["band_hz"]);
    for (const Figure& figure : others) readFigure(root, figure, profile);
    return profile;
}

OrderedJson orNull(const std::optional<double>& figure) {
    return figure ? OrderedJson(*figure) : OrderedJson();
}

} // namespace

std::string equaliserFault(const ActuatorProfile& profile) {
    const std::string measure = " is not known (measure it with physvib calibrate)";
    if (profile.kind == ActuatorKind::rotating)
        return "a rotating mass has the frequency of its speed: nothing can be equalised";
    if (!profile.resonanceHz) return resonance.field + measure;
    if (!profile.q) return quality.field + measure;
    return profile.band ? std::string{} : "band_hz" + measure;
}

Result<ActuatorProfile> readActuator(std::string_view text, std::string_view name) {
    return readJson(text, name, limits::maxActuatorFileBytes,
                    [](const Json& root) { return readActuatorRoot(JsonField(root, {})); });
}

Result<ActuatorProfile> loadActuator(const std::filesystem::path& path) {
    return loadText(path, limits::maxActuatorFileBytes, readActuator);
}

std::string actuatorJson(const ActuatorProfile& profile) {
    OrderedJson root{{actuatorVersionField, actuatorFormatVersion},
                     {"name", profile.name},
                     {"description", profile.description},
                     {"source", profile.source},
                     {"kind", kindNames[static_cast<std::size_t>(profile.kind)]}};
    root[resonance.field] = orNull(profile.resonanceHz);
    root[quality.field] = orNull(profile.q);
    root["band_hz"] = profile.band ? OrderedJson{profile.band->lowHz, profile.band->highHz} : OrderedJson();
    for (const Figure& figure : others) root[figure.field] = orNull(profile.*figure.member);
    return jsonLines(root);
}

const std::vector<ActuatorProfile>& builtInActuators() {
    static const std::vector<ActuatorProfile> profiles = readEmbedded(embeddedActuators(), readActuator);
    return profiles;
}

Result<ActuatorProfile> findActuator(const std::string& nameOrPath) {
    if (isJsonPath(nameOrPath)) return loadActuator(nameOrPath);
    for (const ActuatorProfile& profile : builtInActuators())
        if (profile.name == nameOrPath) return profile;
    return Failure{"no actuator " + inQuotes(nameOrPath) + " (see physvib actuators)"};
}

} // namespace physvib
