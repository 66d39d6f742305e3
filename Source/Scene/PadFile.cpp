// SPDX-License-Identifier: MIT
// Reads controller profiles with checks of every field, and writes them in a fixed order.
#include "Scene/PadFile.h"
#include "Io/Disk/Embedded.h"
#include "Io/Disk/ReadFile.h"
#include "Io/Json/JsonField.h"
#include "Io/Json/JsonText.h"
#include "Io/Text/NumberText.h"
#include "Scene/JsonWriter.h"
#include "Scene/SceneCatalogue.h"
#include "Scene/SceneFileLimits.h"

namespace physvib {

const std::vector<EmbeddedFile>& embeddedPads(); // Source/Scene/Pads/*.json, in the order of their listing

namespace {

constexpr const char* padVersionField = "physvib_pad";

/// A number of the law: its field, its member, and its valid range.
struct LawFigure {
    const char* field;
    double PadLaw::*member;
    double least, most;
};
constexpr LawFigure lawFigures[]{{"commands_per_s", &PadLaw::commandsPerSecond, 5.0, 500.0},
                                 {"lead_s", &PadLaw::leadSeconds, 0.0, 0.2},
                                 {"split_hz", &PadLaw::splitHz, 1.0, 10'000.0},
                                 {"side", &PadLaw::side, 0.0, 1.0},
                                 {"floor", &PadLaw::floor, 1e-4, 1.0},
                                 {"exponent", &PadLaw::exponent, 0.1, 4.0}};
struct MotorFigure {
    const char* field;
    double PadMotor::*member;
    double least, most;
};
constexpr MotorFigure motorFigures[]{{"threshold", &PadMotor::threshold, 0.0, 0.9},
                                     {"half", &PadMotor::half, 0.01, 0.99},
                                     {"full", &PadMotor::full, 0.02, 1.0},
                                     {"rise_s", &PadMotor::riseSeconds, 0.001, 2.0},
                                     {"fall_s", &PadMotor::fallSeconds, 0.001, 2.0}};

PadMotor readMotor(const JsonField& json) {
    json.expectObject({"threshold", "half", "full", "rise_s", "fall_s"});
    PadMotor motor;
    for (const MotorFigure& figure : motorFigures)
        motor.*figure.member = json[figure.field].numberWithin(figure.least, figure.most);
    if (!(motor.threshold < motor.half))
        json["half"].fail("expected more than threshold, " + numberText(motor.threshold));
    if (!(motor.half < motor.full)) json["full"].fail("expected more than half, " + numberText(motor.half));
    return motor;
}

PadProfile readPadRoot(const JsonField& root) {
    checkVersion(root, padVersionField, padFormatVersion);
    root.expectObject({padVersionField, "name", "description", "source", "commands_per_s", "lead_s",
                       "split_hz", "side", "floor", "exponent", "low", "high"});
    PadProfile profile;
    profile.name = root["name"].text();
    if (profile.name.empty()) root["name"].fail("expected a name, found an empty string");
    profile.description = root["description"].text();
    profile.source = root["source"].text();
    for (const LawFigure& figure : lawFigures)
        profile.law.*figure.member = root[figure.field].numberWithin(figure.least, figure.most);
    profile.law.low = readMotor(root["low"]);
    profile.law.high = readMotor(root["high"]);
    return profile;
}

OrderedJson motorJson(const PadMotor& motor) {
    OrderedJson json;
    for (const MotorFigure& figure : motorFigures) json[figure.field] = motor.*figure.member;
    return json;
}

} // namespace

Result<PadProfile> readPad(std::string_view text, std::string_view name) {
    return readJson(text, name, limits::maxPadFileBytes,
                    [](const Json& root) { return readPadRoot(JsonField(root, {})); });
}

std::string padJson(const PadProfile& profile) {
    OrderedJson root{{padVersionField, padFormatVersion},
                     {"name", profile.name},
                     {"description", profile.description},
                     {"source", profile.source}};
    for (const LawFigure& figure : lawFigures) root[figure.field] = profile.law.*figure.member;
    root["low"] = motorJson(profile.law.low);
    root["high"] = motorJson(profile.law.high);
    return jsonLines(root);
}

const std::vector<PadProfile>& builtInPads() {
    static const std::vector<PadProfile> profiles = readEmbedded(embeddedPads(), readPad);
    return profiles;
}

Result<PadProfile> findPad(const std::string& nameOrPath) {
    if (isJsonPath(nameOrPath)) return loadText(nameOrPath, limits::maxPadFileBytes, readPad);
    std::string names;
    for (const PadProfile& profile : builtInPads()) {
        if (profile.name == nameOrPath) return profile;
        names += (names.empty() ? "" : ", ") + profile.name;
    }
    return Failure{"no controller profile " + inQuotes(nameOrPath) + ": expected " + names +
                   " or a file NAME.json"};
}

} // namespace physvib
