// SPDX-License-Identifier: MIT
// Reads files by the extension of their name. MPEG formats are rejected with a hint, to keep the page small.
#include "PageFile.h"
#include "Formats/ClipFile.h"
#include "Formats/ClipSound.h"
#include "Formats/HjifFile.h"
#include "Measure/SlowPart.h"
#include "Scene/EventsCsv.h"

namespace physvib {
namespace {

Failure noRoom() { return {"expected a file .haptic or .ahap; physvib export makes one of MPEG's"}; }

Scene emptyScene(std::string_view name, Vector fieldMetres) {
    Scene scene;
    scene.name = name;
    scene.fieldWidthMetres = fieldMetres.x;
    scene.fieldHeightMetres = fieldMetres.y;
    return scene;
}

Result<PageFile> readList(std::string_view name, std::string_view text, Vector fieldMetres) {
    auto read = readEventsCsv(text, name);
    if (!read) return Failure{std::move(read.error)};
    const FieldSize said = read.value.field;
    const Vector field = said.isKnown() ? Vector{said.widthMetres, said.heightMetres} : fieldMetres;
    return PageFile{emptyScene(name, field), std::move(read.value.events), {}};
}

Result<PageFile> readClipFile(std::string_view name, std::string_view text, ClipFormat format,
                              int sampleRateHz) {
    const auto read = readClip(text, name, format);
    if (!read) return Failure{read.error};
    if (const std::string fault = clipFault(read.value); !fault.empty()) return Failure{fault};
    SampledSound sound = clipSound(read.value, sampleRateHz);
    takeSlowPart(sound.channels.front(), sampleRateHz);
    const Vector field{1.6, 0.9};
    CollisionEvent strike{0, clipFrequencyHz, 1.0, 1.0, field.x / 2, field.y / 2, 0, {}};
    strike.sound = soundOfClip(0);
    return PageFile{emptyScene(name, field), {strike}, std::move(sound.channels.front())};
}

} // namespace

// Stubs that replace the readers and writers of MPEG formats.
Result<Clip> readHjif(std::string_view, std::string_view) { return noRoom(); }
std::string hjifText(const Clip&) { return {}; }
std::vector<std::string> hjifLosses(const Clip&, const std::set<double>&) { return {}; }

Result<PageFile> readPageFile(std::string_view name, std::string_view text, const SceneSettings& settings,
                              Vector fieldMetres, int sampleRateHz) {
    if (const auto format = clipFormatOf(name)) return readClipFile(name, text, *format, sampleRateHz);
    if (name.ends_with(".csv")) return readList(name, text, fieldMetres);
    auto read = readScene(text, "scene", settings);
    if (!read) return Failure{std::move(read.error)};
    return PageFile{std::move(read.value), {}, {}};
}

} // namespace physvib
