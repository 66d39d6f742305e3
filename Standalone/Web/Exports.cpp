// SPDX-License-Identifier: MIT
// What the page calls. Text is read from the buffer that text() gives; what fails does not return (see fail), and the page throws the
// instance away.
#include "Scene/SceneCatalogue.h"
#include "PageWorld.h"
#include "Scene/SceneEdits.h"
#include <array>
#include <cstdlib>
#include <exception>
#include <typeinfo>

#define PHYSVIB_PAGE(name) __attribute__((export_name(#name))) page_##name // the C library has an open of its own

extern "C" {
/// The page's: throws, so that nothing after it runs.
[[noreturn]] void fail(const char* line) __attribute__((import_module("page"), import_name("fail")));

// Exceptions end here, as natively they end in one line: this C++ library has no way back to a handler. All of ours are std::exceptions.
void* __cxa_allocate_exception(std::size_t bytes) noexcept { return std::malloc(bytes); }
[[noreturn]] void __cxa_throw(void* thrown, std::type_info*, void (*)(void*)) { fail(static_cast<std::exception*>(thrown)->what()); }
}

using namespace physvib;

namespace {

std::string textBuffer;
std::unique_ptr<PageWorld> world;

const char* tell(std::string text) {
    textBuffer = std::move(text);
    return textBuffer.c_str();
}

} // namespace

extern "C" {

/// Room for so many bytes of text.
char* PHYSVIB_PAGE(text)(int bytes) {
    textBuffer.assign(static_cast<std::size_t>(bytes), ' ');
    return textBuffer.data();
}

/// The scenes that come with PhysVib, a name and a sentence in turn, a line each.
const char* PHYSVIB_PAGE(sceneList)() {
    std::string lines;
    for (const Scene& scene : builtInScenes()) lines += scene.name + '\n' + scene.description + '\n';
    return tell(std::move(lines));
}

/// Begins with what is in the buffer: the name of a scene, or a scene. `byHand`: without what its script does of what hands do.
void PHYSVIB_PAGE(open)(bool isName, bool byHand, unsigned seed, int sampleRateHz, int outputs) {
    const Scene* const builtIn = isName ? findBuiltInScene(textBuffer) : nullptr;
    if (isName && builtIn == nullptr) fail("expected the name of a scene that comes with PhysVib");
    Result<Scene> scene = builtIn != nullptr ? *builtIn : readScene(textBuffer, "scene");
    world = std::make_unique<PageWorld>(byHand ? sceneForHands(std::move(scene.value)) : std::move(scene.value), seed, sampleRateHz, outputs);
}

/// All that is to be drawn, as a scene: bodies under the numbers of poses(), scripted ones among them; no script.
const char* PHYSVIB_PAGE(scene)() {
    Scene shown = world->scene();
    shown.bodies = world->cast();
    shown.script.clear();
    shown.inputs.clear();
    return tell(sceneJson(shown));
}

const char* PHYSVIB_PAGE(fault)() { return world->fault().c_str(); }
const float* PHYSVIB_PAGE(render)(int frames) { return world->render(frames); }
int PHYSVIB_PAGE(playOutFrames)() { return static_cast<int>(world->playOutFrames()); }
const float* PHYSVIB_PAGE(poses)() { return world->poses().data(); }
int PHYSVIB_PAGE(bodyCount)() { return static_cast<int>(world->cast().size()); }

/// The next hit that has been played since: x, y, frequency, decay, amplitude; null: none.
const float* PHYSVIB_PAGE(hit)() {
    static std::array<float, 5> told;
    CollisionEvent e;
    if (!world->takeHit(e)) return nullptr;
    told = {static_cast<float>(e.x), static_cast<float>(e.y), static_cast<float>(e.frequencyHz), static_cast<float>(e.decayPerSecond), static_cast<float>(e.amplitude)};
    return told.data();
}

void PHYSVIB_PAGE(grip)(int body, double xMetres, double yMetres) { world->grip(static_cast<std::size_t>(body), {xMetres, yMetres}); }
void PHYSVIB_PAGE(letGo)() { world->letGo(); }
void PHYSVIB_PAGE(hold)(double angleRadians, double factor) { world->act(HoldAction{factor, angleRadians}); }
void PHYSVIB_PAGE(steer)(int way) { world->steer(way); }
bool PHYSVIB_PAGE(isPlayed)() { return world->isPlayed(); }
void PHYSVIB_PAGE(sound)(int material, double frequencyHz, double decayPerSecond) { world->act(SoundAction{material, frequencyHz, decayPerSecond}); }

/// Enchanters: first how many, then each one's place in shares of the layout's extent, then placed().
void PHYSVIB_PAGE(enchanters)(int count) { world->layout().count = count; }
void PHYSVIB_PAGE(place)(int enchanter, double x, double y) {
    EnchanterLayout& layout = world->layout();
    layout.places[static_cast<std::size_t>(enchanter)] = {x * layout.extentWidthMetres, y * layout.extentHeightMetres};
}
void PHYSVIB_PAGE(placed)() { world->placed(); }
}
