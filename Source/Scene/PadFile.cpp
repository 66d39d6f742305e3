// SPDX-License-Identifier: MIT
// The tables of a controller profile's fields, the built-in profiles, and the motor commands of a render.
#include "Scene/PadFile.h"
#include "Io/Disk/Embedded.h"
#include "Io/Disk/ReadFile.h"
#include "Io/Json/FieldJson.h"
#include "Io/Text/NumberText.h"
#include "Scene/SceneLimits.h"

namespace physvib {
const std::vector<EmbeddedFile>& embeddedPads(); // Source/Scene/Pads/*.json, in the order of their listing

void visitFields(auto& v, FieldsOf<PadMotor>) {
    using M = PadMotor;
    v.field("threshold", &M::threshold, kinds::range(0.0, 0.9));
    v.field("half", &M::half, kinds::range(0.01, 0.99));
    v.field("full", &M::full, kinds::range(0.02, 1.0));
    v.field("rise_s", &M::riseSeconds, kinds::range(0.001, 2.0));
    v.field("fall_s", &M::fallSeconds, kinds::range(0.001, 2.0));
}

void visitFields(auto& v, FieldsOf<PadProfile>) {
    using P = PadProfile;
    const auto law = [&v](std::string_view name, auto member, const auto& kind) {
        v.field(name, nest(&P::law, member), kind);
    };
    v.version("physvib_pad", padFormatVersion);
    v.field("name", &P::name, kinds::name);
    v.field("description", &P::description, kinds::text);
    v.field("source", &P::source, kinds::text);
    law("commands_per_s", &PadModel::commandsPerSecond, kinds::range(5.0, 500.0));
    law("lead_s", &PadModel::leadSeconds, kinds::range(0.0, 0.2));
    law("split_hz", &PadModel::splitHz, kinds::range(1.0, 10'000.0));
    law("side", &PadModel::placeWeight, kinds::range(0.0, 1.0));
    law("floor", &PadModel::floor, kinds::range(1e-4, 1.0));
    law("exponent", &PadModel::exponent, kinds::range(0.1, 4.0));
    law("low", &PadModel::low, kinds::Object<PadMotor>{});
    law("high", &PadModel::high, kinds::Object<PadMotor>{});
}

namespace {

void checkMotor(const JsonField& json, const PadMotor& motor) {
    if (!(motor.threshold < motor.half))
        json["half"].fail("expected more than threshold, " + numberText(motor.threshold));
    if (!(motor.half < motor.full)) json["full"].fail("expected more than half, " + numberText(motor.half));
}

PadProfile readPadRoot(const JsonField& root) {
    const auto profile = kinds::Object<PadProfile>{}(root);
    checkMotor(root["low"], profile.law.low);
    checkMotor(root["high"], profile.law.high);
    return profile;
}

} // namespace

Result<PadProfile> readPad(std::string_view text, std::string_view name) {
    return readJson(text, name, limits::maxPadFileBytes,
                    [](const Json& root) { return readPadRoot(JsonField(root, {})); });
}

std::string padJson(const PadProfile& profile) { return prettyJson(writeTable(profile)); }

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

namespace {

/// Computes the commands of a controller's motors without real time; input in time order.
class OfflinePad {
public:
    OfflinePad(const PadModel& law, const PhantomPanner& panner)
        : motors_{law}
        , gripPanner_{PadMotors::makeGripPanner(panner)}
        , leadNs_{static_cast<std::int64_t>(1e9 * law.leadSeconds)} {}

    void process(const CollisionEvent& event) {
        runUntil(event.timeNs - leadNs_);
        motors_.strike(event, gripPanner_);
    }
    void process(const RenderControl& control) {
        if (control.panner != nullptr) gripPanner_ = PadMotors::makeGripPanner(*control.panner);
        if (control.kind != RenderControl::Kind::stopAll) return;
        runUntil(control.timeNs);
        motors_.stop(control.timeNs);
    }
    std::vector<PadCommand> finish(std::int64_t endNs) {
        runUntil(endNs);
        addIfChanged({endNs, 0.0, 0.0});
        return std::move(commands_);
    }
    std::uint64_t drops() const { return motors_.lost(); }

private:
    void runUntil(std::int64_t ns) {
        while (motors_.dueNs() < ns) addIfChanged(motors_.next(1.0));
    }
    void addIfChanged(const PadCommand& command) {
        if (!commands_.back().isSame(command)) commands_.push_back(command);
    }

    PadMotors motors_;
    PhantomPanner gripPanner_;
    std::int64_t leadNs_;
    std::vector<PadCommand> commands_{PadCommand{}};
};

} // namespace

std::vector<PadCommand> padCommands(const PadModel& law, std::span<const CollisionEvent> events,
                                    std::span<const RenderControl> controls, const PhantomPanner& panner,
                                    std::int64_t endNs, std::uint64_t* drops) {
    OfflinePad pad{law, panner};
    auto control = controls.begin();
    for (const CollisionEvent& event : events) {
        if (event.timeNs >= endNs) break;
        for (; control != controls.end() && control->timeNs <= event.timeNs; ++control) pad.process(*control);
        pad.process(event);
    }
    for (; control != controls.end() && control->timeNs <= endNs; ++control) pad.process(*control);
    auto commands = pad.finish(endNs);
    if (drops) *drops = pad.drops();
    return commands;
}

std::string motorsCsv(const std::vector<PadCommand>& commands, const Provenance& provenance) {
    std::string text = provenanceComment(provenance) + "time_s,low,high\n";
    for (const PadCommand& command : commands)
        text += fixedNumber(static_cast<double>(command.timeNs) * 1e-9, 9) + ',' +
                fixedNumber(command.low, 2) + ',' + fixedNumber(command.high, 2) + '\n';
    return text;
}

} // namespace physvib
