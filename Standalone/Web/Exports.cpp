// SPDX-License-Identifier: MIT
// What the page calls, beside the controllers' motors of Source/Api/JavaScript. What fails does not return
// (js::refuse), and the page throws the instance away.
#include "Api/JavaScript/Exports.h"
#include "PageWorld.h"
#include "Scene/SceneCatalogue.h"
#include "Scene/SceneEdits.h"
#include <array>
#include <qrcodegen.h>

#define PHYSVIB_PAGE(name)                                                                                   \
    __attribute__((export_name(#name))) page_##name // the C library has an open of its own

using namespace physvib;

namespace {

std::unique_ptr<PageWorld> world;
SceneSettings chosen;

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

/// The scenes that come with PhysVib, a name and a sentence in turn, a line each.
const char* PHYSVIB_PAGE(sceneList)() {
    std::string lines;
    for (const Scene& scene : builtInScenes()) lines += scene.name + '\n' + scene.description + '\n';
    return tell(std::move(lines));
}

/// Names of the panning laws, a line each.
const char* PHYSVIB_PAGE(lawList)() {
    std::string lines;
    for (const std::string_view name : panningLawNames) (lines += name) += '\n';
    return tell(std::move(lines));
}

/// A value of a variable of the scene that is opened next.
void PHYSVIB_PAGE(choose)(const char* name, const char* value) { chosen.emplace_back(name, value); }

/// Begins with a file (PageFile.h), or, if it has less than 0 bytes, with the scene of that name. `byHand`:
/// without what its script does of what hands do. A list is felt on a field of that size, m.
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

/// All that is to be drawn, as a scene: bodies under the numbers of poses(), scripted ones among them; no
/// script.
const char* PHYSVIB_PAGE(scene)() {
    Scene shown = world->scene();
    shown.bodies = world->cast();
    shown.script.clear();
    shown.inputs.clear();
    return tell(sceneJson(shown));
}

/// Of each variable of the scene: its name, the value that was chosen, and all choices, a line each; an empty
/// line ends it.
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
int PHYSVIB_PAGE(playOutFrames)() { return static_cast<int>(world->playOutFrames()); }
const float* PHYSVIB_PAGE(poses)() { return world->poses().data(); }
int PHYSVIB_PAGE(bodyCount)() { return static_cast<int>(world->cast().size()); }

/// The next hit that has been played since: x, y, frequency, decay, amplitude, duration (s; 0: rings out),
/// the time of its first sample (s), and its kind, as physvib.h has it; null: none.
const double* PHYSVIB_PAGE(hit)() {
    static std::array<double, 8> told;
    CollisionEvent e;
    double atSeconds = 0.0;
    if (!world->takeHit(e, atSeconds)) return nullptr;
    const double duration = static_cast<double>(e.durationNs) * 1e-9, kind = static_cast<int>(e.source.kind);
    told = {e.x, e.y, e.frequencyHz, e.decayPerSecond, e.amplitude, duration, atSeconds, kind};
    return told.data();
}

/// Fingers have numbers below PageWorld::fingers.
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

/// Actuators: first how many, then each one's place in shares of the layout's extent, then placed().
void PHYSVIB_PAGE(enchanters)(int count) { world->layout().count = count; }
void PHYSVIB_PAGE(place)(int enchanter, double x, double y) {
    EnchanterLayout& layout = world->layout();
    layout.places[static_cast<std::size_t>(enchanter)] = {x * layout.extentWidthMetres,
                                                          y * layout.extentHeightMetres};
}
/// By that law of lawList(); -1: as `physvib render` does if it is asked for none.
void PHYSVIB_PAGE(placed)(int law) { world->placed(law); }

/// A QR code of `text`: how many modules a side has, and qrModule() of each; 0: it is too long for one.
int PHYSVIB_PAGE(qrSide)(const char* text) {
    js::text().assign(2 * qrcodegen_BUFFER_LEN_MAX, '\0');
    auto* const code = reinterpret_cast<std::uint8_t*>(js::text().data());
    const bool fits =
        qrcodegen_encodeText(text, code + qrcodegen_BUFFER_LEN_MAX, code, qrcodegen_Ecc_LOW,
                             qrcodegen_VERSION_MIN, qrcodegen_VERSION_MAX, qrcodegen_Mask_AUTO, true);
    return fits ? qrcodegen_getSize(code) : 0;
}
bool PHYSVIB_PAGE(qrModule)(int x, int y) {
    return qrcodegen_getModule(reinterpret_cast<const std::uint8_t*>(js::text().data()), x, y);
}
}
