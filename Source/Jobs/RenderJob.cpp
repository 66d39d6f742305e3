// SPDX-License-Identifier: MIT
// What is wrong with a render before any file is read.
#include "Jobs/RenderJob.h"
#include "Io/Text/NameList.h"
#include "Io/Text/NumberText.h"
#include <algorithm>
#include <charconv>
#include <concepts>

namespace physvib {

static_assert(std::equality_comparable<RenderJob>);

namespace {

bool parseMetres(std::string_view text, double& metres) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), metres);
    return error == std::errc{} && end == text.data() + text.size() && metres >= 1e-3 && metres <= 1e6;
}

bool parseField(RenderJob& o) {
    const auto comma = o.field.find(',');
    if (comma == std::string::npos) return false;
    const std::string_view text{o.field};
    return parseMetres(text.substr(0, comma), o.fieldWidthMetres) && parseMetres(text.substr(comma + 1), o.fieldHeightMetres);
}

bool parseSettings(RenderJob& o) {
    for (const std::string& text : o.sets) {
        const auto equals = text.find('=');
        if (equals == 0 || equals == std::string::npos) return false;
        o.settings.emplace_back(text.substr(0, equals), text.substr(equals + 1));
    }
    return true;
}

} // namespace

bool parseSounds(const std::vector<std::string>& sounds, std::vector<std::pair<double, std::string>>& recordings) {
    for (const std::string& text : sounds) {
        const auto equals = text.find('=');
        const auto hz = parseNumber<double>(std::string_view{text}.substr(0, equals));
        if (equals == std::string::npos || !hz || !(*hz > 0.0) || equals + 1 == text.size()) return false;
        recordings.emplace_back(*hz, text.substr(equals + 1));
    }
    return true;
}

std::optional<MarkedOnsets> RenderJob::marks() const {
    if (marker.empty()) return {};
    return markerOf == "hits" ? MarkedOnsets::hits : markerOf == "messages" ? MarkedOnsets::messages : MarkedOnsets::all;
}

std::string sceneFault(RenderJob& o) {
    if (!parseSettings(o)) return "--set: expected NAME=VALUE";
    if (!panningLawNamed(o.law, o.panningLaw)) return "--law: expected " + listed(panningLawNames, " or ") + ", found \"" + o.law + "\"";
    if (!o.field.empty() && !parseField(o)) return "--field: expected W,H in metres (0.001 to 1e6), found \"" + o.field + "\"";
    if (!parseSounds(o.sounds, o.recordings)) return std::string{soundExpectation};
    if (o.playsRecordings() && o.sounds.empty()) return "--method SV: expected a --sound for each material";
    if (!o.playsRecordings() && !o.sounds.empty() && o.contactSound.empty()) return "--sound: expected --method SV, to feel it, or --contact-sound, to hear it";
    if (o.playsRecordings() && o.remap == "on") return std::string{recordingsHaveNoFrequency};
    if (o.playsRecordings() && o.gamma > 0.0) return "--gamma: recordings have no one decay to be cut";
    if (o.playsRecordings() && o.perceivedLevel == "on") return std::string{recordingsHaveNoWeight};
    if (!o.playsRecordings() && !renderingMethodNamed(o.method, o.renderingMethod)) return "--method: expected a name from AV-FV-DRV to AF-FF-DRF, or SV, found \"" + o.method + "\"";
    if (!o.sounds.empty() && (o.remap == "on" || o.renderingMethod.fixesFrequency)) return "--sound: expected hits at their material's own frequency, found " + (o.remap == "on" ? "--remap" : "--method " + o.method);
    if (o.remap == "on" && o.actuator == "none") return "--remap: expected an --actuator, whose band is to be used";
    return {};
}

std::string renderInputFault(RenderJob& o) {
    if (o.scene.empty() == o.fromEvents.empty()) return "render: give either a scene or --from-events EVENTS.csv";
    if (!o.sets.empty() && o.scene.empty()) return "--set: only a scene has variables";
    if (o.interfaceVolts > 0.0 && o.actuator == "none") return "--interface-volts: expected an --actuator, whose drive limit is to be met";
    if (!o.coupling.empty() && o.playsRecordings()) return "--coupling: expected a --method of modes; a recording has no one frequency";
    return sceneFault(o);
}

std::string renderFault(RenderJob& o) {
    const std::string fault = renderInputFault(o);
    if (fault.empty() && o.explain && o.scene.empty()) return "--explain: expected a scene, whose contacts are counted";
    if (!fault.empty() || o.explain || !std::ranges::all_of(o.writtenPaths(), &std::string::empty)) return fault;
    return "render: nothing to write; give --out, --events, --picture, --pattern, --contact-sound or --marker";
}

} // namespace physvib
