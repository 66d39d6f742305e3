// SPDX-License-Identifier: MIT
// The table of an actuator profile's fields, reading and writing by it, and the built-in profiles.
#include "Scene/ActuatorFile.h"
#include "Core/Limits.h"
#include "Io/Disk/Embedded.h"
#include "Io/Disk/ReadFile.h"
#include "Io/Json/FieldJson.h"
#include "Io/Text/NameList.h"
#include "Io/Text/NumberText.h"
#include "Scene/SceneLimits.h"
#include <array>

namespace physvib {

// Source/Scene/Actuators/*.json, in the order of their listing
const std::vector<EmbeddedFile>& embeddedActuators();

namespace {

constexpr std::array<std::string_view, 2> kindNames{"linear", "rotating"};
constexpr std::string_view resonanceField = "resonance_hz", qualityField = "q", bandField = "band_hz";

// Kinds of fields that may be null, which means that the value is not known.
struct BandOrNull {};
struct NumberOrNull {
    double min, max;
};

std::optional<double> readCustom(const JsonField& json, const NumberOrNull& kind) {
    return json.isNull() ? std::nullopt : std::optional{json.numberWithin(kind.min, kind.max)};
}
OrderedJson writeCustom(const NumberOrNull&, const std::optional<double>& number) {
    return number ? OrderedJson(*number) : OrderedJson();
}

std::optional<FrequencyBand> readCustom(const JsonField& json, const BandOrNull&) {
    if (json.isNull()) return std::nullopt;
    if (const std::size_t size = json.arraySize(); size != 2)
        json.fail("expected [lowest, highest] or null, found " + std::to_string(size) + " items");
    const FrequencyBand band{json.item(0).numberWithin(limits::minMeasuredHz, limits::maxFrequencyHz),
                             json.item(1).numberWithin(limits::minMeasuredHz, limits::maxFrequencyHz)};
    if (!band.isKnown()) json.fail("expected a highest frequency above the lowest");
    return band;
}

OrderedJson writeCustom(const BandOrNull&, const std::optional<FrequencyBand>& band) {
    return band ? OrderedJson{band->lowHz, band->highHz} : OrderedJson();
}

} // namespace

void visitFields(auto& v, FieldsOf<ActuatorProfile>) {
    using P = ActuatorProfile;
    const auto number = [&v](std::string_view name, auto member, double min, double max) {
        v.field(name, member, NumberOrNull{min, max});
    };
    v.version("physvib_actuator", actuatorFormatVersion);
    v.field("name", &P::name, kinds::name);
    v.field("description", &P::description, kinds::text);
    v.field("source", &P::source, kinds::text);
    v.field("kind", &P::kind, kinds::OneOf{kindNames});
    number(resonanceField, &P::resonanceHz, limits::minMeasuredHz, limits::maxFrequencyHz);
    number(qualityField, &P::q, limits::minQ, limits::maxQ);
    v.field(bandField, &P::band, BandOrNull{});
    number("drive_limit_v", &P::driveLimitVolts, 0.001, 1000.0);
    number("rise_time_s", &P::riseSeconds, 1e-5, 10.0);
    number("full_scale_g", &P::fullScaleG, 1e-4, 1000.0);
    number("delay_s", &P::delaySeconds, 0.0, 10.0);
}

std::string equaliserError(const ActuatorProfile& profile) {
    const auto unknownError = [](std::string_view field) {
        return std::string(field) + " is not known (measure it with physvib calibrate)";
    };
    if (profile.kind == ActuatorKind::rotating)
        return "a rotating mass has the frequency of its speed: nothing can be equalised";
    if (!profile.resonanceHz) return unknownError(resonanceField);
    if (!profile.q) return unknownError(qualityField);
    return profile.band ? std::string{} : unknownError(bandField);
}

Result<ActuatorProfile> readActuator(std::string_view text, std::string_view name) {
    return readJson(text, name, limits::maxActuatorFileBytes,
                    [](const Json& root) { return kinds::Object<ActuatorProfile>{}(JsonField(root, {})); });
}

Result<ActuatorProfile> loadActuator(const std::filesystem::path& path) {
    return loadText(path, limits::maxActuatorFileBytes, readActuator);
}

std::string actuatorJson(const ActuatorProfile& profile) { return prettyJson(writeTable(profile)); }

const std::vector<ActuatorProfile>& builtInActuators() {
    static const std::vector<ActuatorProfile> profiles = readEmbedded(embeddedActuators(), readActuator);
    return profiles;
}

Result<ActuatorProfile> findActuator(const std::string& nameOrPath) {
    if (isJsonPath(nameOrPath)) return loadActuator(nameOrPath);
    if (const auto* profile = findNamed(builtInActuators(), nameOrPath)) return *profile;
    return Failure{"no actuator " + inQuotes(nameOrPath) + " (see physvib actuators)"};
}

} // namespace physvib
