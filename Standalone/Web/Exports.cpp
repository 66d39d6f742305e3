// SPDX-License-Identifier: MIT
// Functions of the WebAssembly module that the page calls, besides the motor controllers in
// Source/Api/JavaScript. On an error they do not return (js::refuse), and the page discards the instance.
#include "Api/JavaScript/Exports.h"
#include "Io/Text/QrCode.h"
#include "PageWorld.h"
#include "Scene/SceneEdits.h"
#include "Scene/SceneFile.h"
#include <array>
#include <optional>

#define PHYSVIB_PAGE(name)                                                                                   \
    __attribute__((export_name(#name))) page_##name // prefix, because the C library has a function open

using namespace physvib;

namespace {

std::unique_ptr<PageWorld> world;
SceneSettings chosen;
std::optional<QrCode> code;

const char* tell(std::string text) {
    js::text() = std::move(text);
    return js::text().c_str();
}

std::string_view builtIn(std::string_view name) {
    for (const EmbeddedFile& file : embeddedScenes())
        if (file.name == std::string{name} + ".json") return file.text;
    js::refuse("expected the name of a scene that comes with PhysVib");
}

} // namespace

extern "C" {

/// Built-in scenes: name and description on alternating lines.
const char* PHYSVIB_PAGE(sceneList)() {
    std::string lines;
    for (const Scene& scene : builtInScenes()) lines += scene.name + '\n' + scene.description + '\n';
    return tell(std::move(lines));
}

/// Names of the panning laws, one per line.
const char* PHYSVIB_PAGE(lawList)() {
    std::string lines;
    for (const std::string_view name : panningLawNames) (lines += name) += '\n';
    return tell(std::move(lines));
}

/// Sets a variable of the scene that is opened next.
void PHYSVIB_PAGE(choose)(const char* name, const char* value) { chosen.emplace_back(name, value); }

/// Opens a file or, if `bytes` < 0, the built-in scene `name`. `byHand` disables scripted user
/// input. An event list without a field gets a field of the given size, m.
void PHYSVIB_PAGE(open)(const char* name, const char* text, int bytes, bool byHand, unsigned seed,
                        int sampleRateHz, int outputs, double fieldWidth, double fieldHeight) {
    const std::string_view given =
        bytes < 0 ? builtIn(name) : std::string_view{text, static_cast<std::size_t>(bytes)};
    const Vector field{fieldWidth, fieldHeight};
    auto file = readPageFile(bytes < 0 ? "scene" : name, given, chosen, field, sampleRateHz);
    if (!file) js::refuse(file.error);
    if (byHand) file.value.scene = sceneForHands(std::move(file.value.scene));
    world = std::make_unique<PageWorld>(std::move(file.value), seed, sampleRateHz, outputs);
}

/// The scene to draw, without script: bodies have the indices of poses(), and scripted ones are included.
const char* PHYSVIB_PAGE(scene)() {
    Scene shown = world->scene();
    shown.bodies = world->cast();
    shown.script.clear();
    shown.inputs.clear();
    return tell(sceneJson(shown));
}

/// For each variable of the scene: its name, its value and all choices, one per line, then an empty line.
const char* PHYSVIB_PAGE(variables)() {
    std::string lines;
    for (const SceneVariable& variable : world->scene().variables) {
        lines += variable.name + '\n' + variable.value + '\n';
        for (const std::string& choice : variable.choices) lines += choice + '\n';
        lines += '\n';
    }
    return tell(std::move(lines));
}

const char* PHYSVIB_PAGE(fault)() { return world->fault().c_str(); }
const float* PHYSVIB_PAGE(render)(int frames) { return world->render(frames); }
int PHYSVIB_PAGE(outputLatencyFrames)() { return static_cast<int>(world->outputLatencyFrames()); }
const float* PHYSVIB_PAGE(poses)() { return world->poses().data(); }
int PHYSVIB_PAGE(bodyCount)() { return static_cast<int>(world->cast().size()); }

/// The next impact played since the last call: x, y, frequency, decay, amplitude, duration (s; 0: not
/// limited), time of its first sample (s), and kind as in physvib.h; null if there is none.
const double* PHYSVIB_PAGE(hit)() {
    static std::array<double, 8> told;
    CollisionEvent e;
    double atSeconds = 0.0;
    if (!world->takeHit(e, atSeconds)) return nullptr;
    const double duration = static_cast<double>(e.durationNs) * 1e-9, kind = static_cast<int>(e.source.kind);
    told = {e.x, e.y, e.frequencyHz, e.decayPerSecond, e.amplitude, duration, atSeconds, kind};
    return told.data();
}

/// `finger` is in 0 to PageWorld::fingers - 1.
void PHYSVIB_PAGE(grip)(int finger, int body, double xMetres, double yMetres) {
    world->grip(finger, static_cast<std::size_t>(body), {xMetres, yMetres});
}
void PHYSVIB_PAGE(letGo)(int finger) { world->letGo(finger); }
void PHYSVIB_PAGE(hold)(double angleRadians, double factor) { world->act(HoldAction{factor, angleRadians}); }
void PHYSVIB_PAGE(steer)(int way) { world->steer(way); }
bool PHYSVIB_PAGE(isPlayed)() { return world->isPlayed(); }
void PHYSVIB_PAGE(sound)(int material, double frequencyHz, double decayPerSecond) {
    world->act(SoundAction{material, frequencyHz, decayPerSecond});
}

/// Sets the actuators: first their number, then each place as shares of the layout's extent, then placed().
void PHYSVIB_PAGE(enchanters)(int count) { world->layout().count = count; }
void PHYSVIB_PAGE(place)(int enchanter, double x, double y) {
    EnchanterLayout& layout = world->layout();
    layout.places[static_cast<std::size_t>(enchanter)] = {x * layout.extentWidthMetres,
                                                          y * layout.extentHeightMetres};
}
/// Applies the places with a law of lawList(); -1: default of `physvib render`.
void PHYSVIB_PAGE(placed)(int law) { world->placed(law); }

/// Creates a QR code of `text` and returns the modules per side, for qrModule(); 0: the text is too long.
int PHYSVIB_PAGE(qrSide)(const char* text) { return code.emplace(text).side(); }
bool PHYSVIB_PAGE(qrModule)(int x, int y) { return code->isDark(x, y); }
}
