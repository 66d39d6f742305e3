// SPDX-License-Identifier: MIT
// The WebAssembly module of the web page: reads the files that the page opens, runs a scene with its haptic
// output on the audio thread (PageWorld), and exports the functions that the page calls. Exports do not
// return on an error (js::throwError), and the page discards the instance.
#include "Api/JavaScript/Exports.h"
#include "Core/ClockLaw.h"
#include "Core/CollisionEvent.h"
#include "Core/ControlQueue.h"
#include "Core/HapticRenderer.h"
#include "Core/PanningLaws.h"
#include "Formats/ClipFile.h"
#include "Formats/StrikeClip.h"
#include "Io/Result.h"
#include "Io/Text/QrCode.h"
#include "Measure/HitExcerpt.h"
#include "Scene/EventsCsv.h"
#include "Scene/SceneEdits.h"
#include "Scene/SceneFile.h"
#include "Scene/World/BodyLists.h"
#include "Scene/World/InputCheck.h"
#include "Scene/World/ScenePlayer.h"
#include "Scene/World/Simulation.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace physvib {
namespace {

/// A file that a page opens: a scene and the events played in it. A scene file has no events, an event list
/// its own, and a clip one event, which plays `samples`. MPEG formats are refused, to keep the page small.
struct PageFile {
    Scene scene;
    std::vector<CollisionEvent> strikes; ///< sorted by time
    std::vector<float> samples;          ///< at the renderer's rate
};

Scene emptyScene(std::string_view name, Vector fieldMetres) {
    Scene scene;
    scene.name = name;
    scene.fieldWidthMetres = fieldMetres.x;
    scene.fieldHeightMetres = fieldMetres.y;
    return scene;
}

Result<PageFile> readEventList(std::string_view name, std::string_view text, Vector fieldMetres) {
    auto list = readEventsCsv(text, name);
    if (!list) return Failure{std::move(list.error)};
    const FieldSize listField = list.value.field;
    const Vector field =
        listField.isKnown() ? Vector{listField.widthMetres, listField.heightMetres} : fieldMetres;
    return PageFile{emptyScene(name, field), std::move(list.value.events), {}};
}

Result<PageFile> readClipFile(std::string_view name, std::string_view text, ClipFormat format,
                              int sampleRateHz) {
    const auto clip = readClip(text, name, format);
    if (!clip) return Failure{clip.error};
    if (const std::string error = clipError(clip.value); !error.empty()) return Failure{error};
    SampledSound sound = clipSound(clip.value, sampleRateHz);
    removeSlowPart(sound.channels.front(), sampleRateHz);
    const Vector field{1.6, 0.9};
    CollisionEvent strike{0, clipFrequencyHz, 1.0, 1.0, field.x / 2, field.y / 2, 0, {}};
    strike.sound = soundOfClip(0);
    return PageFile{emptyScene(name, field), {strike}, std::move(sound.channels.front())};
}

/// `name` ends in .csv, .haptic or .ahap; otherwise it is a scene. A list without a field gets one of the
/// given size, m. A clip plays in the centre of all actuators, as in `physvib render`.
Result<PageFile> readPageFile(std::string_view name, std::string_view text, const SceneSettings& settings,
                              Vector fieldMetres, int sampleRateHz) {
    if (const auto format = findClipFormat(name)) return readClipFile(name, text, *format, sampleRateHz);
    if (name.ends_with(".csv")) return readEventList(name, text, fieldMetres);
    auto read = readScene(text, "scene", settings);
    if (!read) return Failure{std::move(read.error)};
    return PageFile{std::move(read.value), {}, {}};
}

/// A running scene. Its output equals the rendered file, delayed by outputLatencyFrames(). One thread does
/// all that Live/Session/Session.h divides among threads, and steps the world in the block that needs it.
class PageWorld {
public:
    static constexpr int stepsPerSecond = 100;
    static constexpr int maxFingers = 10; ///< bodies held at once

    /// Throws the exceptions of Simulation, or std::invalid_argument for a sample rate or number of outputs
    /// that cannot be rendered.
    PageWorld(PageFile file, std::uint32_t seed, int sampleRateHz, int outputs)
        : file_{std::move(file)}
        , clipContact_{clipFrequencyHz, file_.samples, soundOfClip(0)}
        , simulation_{file_.scene, seed, stepsPerSecond}
        , inputCheck_{file_.scene, InputCheck::unlimited}
        , scenePlayer_{file_.scene}
        , bodies_{allBodies(file_.scene)}
        , fieldMetres_{file_.scene.fieldWidthMetres, file_.scene.fieldHeightMetres}
        , clockLaw_{.sampleRateHz = sampleRateHz, .blockFrames = 0, .stepsPerSecond = stepsPerSecond}
        , outputCount_{static_cast<std::size_t>(outputs)} {
        layoutPreset("phone4", layout_);
        if (!renderer_->prepare({.sampleRateHz = sampleRateHz,
                                 .channels = outputs,
                                 .panner = panner(),
                                 .instructions = InstructionSet::scalar}))
            throw std::invalid_argument("sound: expected 5000 to 192000 Hz and 4 to 64 outputs");
        clockLaw_.limiterFrames = renderer_->latencyFrames();
        if (file_.samples.empty()) return;
        controls_.push({.kind = RenderControl::Kind::recordings, .recordings = {{&clipContact_, 1}, false}});
    }

    /// Renders the next frames; the result has them channel by channel and is valid until the next call.
    const float* render(int frames) {
        stepTo(renderedFrames_ + frames);
        samples_.resize(outputCount_ * static_cast<std::size_t>(frames));
        const int silentFrames =
            static_cast<int>(std::clamp<std::int64_t>(firstFrame() - renderedFrames_, 0, frames));
        std::array<float*, limits::maxActuators> out{};
        for (std::size_t j = 0; j < outputCount_; ++j)
            out[j] = std::fill_n(samples_.data() + j * static_cast<std::size_t>(frames), silentFrames, 0.0f);
        if (silentFrames < frames) renderer_->render(*this, out.data(), frames - silentFrames);
        renderedFrames_ += frames;
        return samples_.data();
    }
    std::int64_t outputLatencyFrames() const noexcept { return clockLaw_.outputLatencyFrames(); }

    /// Four numbers per body of bodies(): x and y in m, angle in rad, and presence (1 or 0).
    const std::vector<float>& poses() {
        poses_.clear();
        for (std::size_t i = 0; i < bodies_.size(); ++i) {
            const BodyPose pose = simulation_.pose(i);
            for (const double value :
                 {pose.xMetres, pose.yMetres, pose.angleRadians, pose.isPresent ? 1.0 : 0.0})
                poses_.push_back(static_cast<float>(value));
        }
        return poses_;
    }
    const std::vector<BodyDescription>& bodies() const noexcept { return bodies_; }
    const Scene& scene() const noexcept { return simulation_.scene(); }

    /// The next impact played since the last call, and its time in seconds of the output; false if there is
    /// none. Clips are not reported.
    bool nextHit(CollisionEvent& hit, double& outputSeconds) {
        PlayedEvent played;
        if (!renderer_->played().pop(played) || !file_.samples.empty()) return false;
        hit = played.event;
        outputSeconds =
            static_cast<double>(played.frame + clockLaw_.outputLatencyFrames()) / clockLaw_.sampleRateHz;
        return true;
    }

    /// Applies an input now; if it is refused, inputError() says why.
    void applyInput(const Action& action) {
        if (inputError_ = inputCheck_.accept(action); inputError_.empty())
            simulation_.addInput(static_cast<double>(simulation_.timeNs()) * 1e-9, action);
    }
    void steer(int direction) {
        for (const Action& action : scenePlayer_.steer(direction)) applyInput(action);
    }
    bool isPlayed() const noexcept { return scenePlayer_.isPresent(); }
    const std::string& inputError() const noexcept { return inputError_; } ///< of the last input; empty: none

    /// Pulls the body towards a place until release(). An invalid finger or body is ignored.
    void grab(int finger, std::size_t body, Vector toMetres) {
        if (finger < 0 || finger >= maxFingers || body >= bodies_.size()) return;
        grips_[static_cast<std::size_t>(finger)] = Grip{body, toMetres};
    }
    /// Ends the pull of a finger and stops a kinematic body, which would keep its velocity.
    void release(int finger) {
        if (finger < 0 || finger >= maxFingers) return;
        const auto grip = std::exchange(grips_[static_cast<std::size_t>(finger)], {});
        if (grip && bodies_[grip->body].type == BodyType::kinematicBody)
            applyInput(VelocityAction{bodies_[grip->body].name, {}});
    }

    /// The actuators, at most as many as outputs. Changes count after applyLayout().
    ActuatorLayout& layout() noexcept { return layout_; }
    /// Index in panningLaws; any other value: PanningLaw::automatic.
    void applyLayout(int law) {
        const auto index = static_cast<std::size_t>(law); // -1 becomes larger than any index
        panningLaw_ = index < panningLaws.size() ? panningLaws[index].law : PanningLaw::automatic;
        const std::int64_t timeNs = toNs(std::max<std::int64_t>(0, renderedFrames_ - firstFrame()));
        const PhantomPanner currentPanner = panner();
        controls_.push({.timeNs = timeNs, .kind = RenderControl::Kind::panner, .panner = &currentPanner});
    }

    bool pop(CollisionEvent& event) noexcept { // called by the renderer, as are the next two
        if (events_.empty()) return false;
        event = events_.front();
        events_.pop_front();
        return true;
    }
    bool pop(RenderControl& change) noexcept { return controls_.pop(change); }
    void done(const RenderControl& change) noexcept { controls_.done(change); }

private:
    static constexpr double pullRate = 12.0, maxPullSpeed = 12.0; // 1/s: speed by distance; m/s

    struct Grip {
        std::size_t body;
        Vector targetMetres;
    };
    PhantomPanner panner() const noexcept {
        return {layout_, panningLaw_, 1.0, fieldMetres_.x, fieldMetres_.y};
    }
    // Frame of the output at which the renderer starts.
    std::int64_t firstFrame() const noexcept {
        return clockLaw_.outputLatencyFrames() - clockLaw_.limiterFrames;
    }
    std::int64_t toNs(std::int64_t frame) const noexcept {
        return static_cast<std::int64_t>(static_cast<double>(frame) * 1e9 / clockLaw_.sampleRateHz);
    }
    void pullBody(const Grip& grip) {
        const BodyPose pose = simulation_.pose(grip.body);
        if (!pose.isPresent) return;
        const Vector velocity{pullRate * (grip.targetMetres.x - pose.xMetres),
                              pullRate * (grip.targetMetres.y - pose.yMetres)};
        const double scale = std::min(1.0, maxPullSpeed / std::max(1e-9, std::hypot(velocity.x, velocity.y)));
        applyInput(VelocityAction{bodies_[grip.body].name, {scale * velocity.x, scale * velocity.y}});
    }
    void stepTo(std::int64_t frame) {
        while (simulation_.timeNs() < toNs(frame)) {
            for (const auto& grip : grips_)
                if (grip) pullBody(*grip);
            simulation_.step(stepEvents_);
            simulation_.dropExecutedInputs();
        }
        events_.insert(events_.end(), stepEvents_.begin(), stepEvents_.end());
        stepEvents_.clear();
        for (; nextStrike_ < file_.strikes.size() && file_.strikes[nextStrike_].timeNs < simulation_.timeNs();
             ++nextStrike_)
            events_.push_back(file_.strikes[nextStrike_]);
    }

    const PageFile file_;
    RecordedContact clipContact_; // samples of the file
    std::size_t nextStrike_ = 0;  // events of the file that were queued
    Simulation simulation_;
    InputCheck inputCheck_;
    ScenePlayer scenePlayer_;
    std::vector<BodyDescription> bodies_;
    Vector fieldMetres_;
    ClockLaw clockLaw_;
    ActuatorLayout layout_;
    std::unique_ptr<HapticRenderer> renderer_ = std::make_unique<HapticRenderer>();
    std::vector<CollisionEvent> stepEvents_;
    std::deque<CollisionEvent> events_;
    ControlQueue<256> controls_;
    std::vector<float> samples_, poses_;
    std::array<std::optional<Grip>, maxFingers> grips_;
    PanningLaw panningLaw_ = PanningLaw::automatic;
    std::string inputError_;
    std::size_t outputCount_;
    std::int64_t renderedFrames_ = 0;
};

} // namespace

// Stubs that replace the readers and writers of MPEG formats.
Result<Clip> readHjif(std::string_view, std::string_view) {
    return Failure{"expected a file .haptic or .ahap; physvib export makes one of MPEG's"};
}
std::string hjifText(const Clip&) { return {}; }
std::vector<std::string> hjifLosses(const Clip&, const std::set<double>&) { return {}; }

} // namespace physvib

#define PHYSVIB_PAGE(name)                                                                                   \
    __attribute__((export_name(#name))) page_##name // the prefix avoids functions of C such as open

using namespace physvib;

namespace {

std::unique_ptr<PageWorld> world;
SceneSettings sceneSettings;
std::optional<QrCode> qrCode;

const char* returnText(std::string text) {
    js::textBuffer() = std::move(text);
    return js::textBuffer().c_str();
}

std::string_view builtInSceneText(std::string_view name) {
    for (const EmbeddedFile& file : embeddedScenes())
        if (file.name == std::string{name} + ".json") return file.text;
    js::throwError("expected the name of a scene that comes with PhysVib");
}

} // namespace

extern "C" {

/// Built-in scenes: name and description on alternating lines.
const char* PHYSVIB_PAGE(sceneList)() {
    std::string lines;
    for (const Scene& scene : builtInScenes()) lines += scene.name + '\n' + scene.description + '\n';
    return returnText(std::move(lines));
}

/// Names of the panning laws, one per line.
const char* PHYSVIB_PAGE(lawList)() {
    std::string lines;
    for (const std::string_view name : panningLawNames) (lines += name) += '\n';
    return returnText(std::move(lines));
}

/// Sets a variable of the scenes that are opened from now on.
void PHYSVIB_PAGE(choose)(const char* name, const char* value) { sceneSettings.emplace_back(name, value); }

/// Opens a file or, if `bytes` < 0, the built-in scene `name`. `isUserInput` disables scripted user
/// input. An event list without a field gets a field of the given size, m.
void PHYSVIB_PAGE(open)(const char* name, const char* text, int bytes, bool isUserInput, unsigned seed,
                        int sampleRateHz, int outputs, double fieldWidth, double fieldHeight) {
    const std::string_view content =
        bytes < 0 ? builtInSceneText(name) : std::string_view{text, static_cast<std::size_t>(bytes)};
    const Vector field{fieldWidth, fieldHeight};
    auto file = readPageFile(bytes < 0 ? "scene" : name, content, sceneSettings, field, sampleRateHz);
    if (!file) js::throwError(file.error);
    if (isUserInput) file.value.scene = sceneForUserInput(std::move(file.value.scene));
    world = std::make_unique<PageWorld>(std::move(file.value), seed, sampleRateHz, outputs);
}

/// The scene to draw, without script: bodies have the indices of poses(), and scripted ones are included.
const char* PHYSVIB_PAGE(scene)() {
    Scene drawnScene = world->scene();
    drawnScene.bodies = world->bodies();
    drawnScene.script.clear();
    drawnScene.inputs.clear();
    return returnText(sceneJson(drawnScene));
}

/// For each variable of the scene: its name, its value and all choices, one per line, then an empty line.
const char* PHYSVIB_PAGE(variables)() {
    std::string lines;
    for (const SceneVariable& variable : world->scene().variables) {
        lines += variable.name + '\n' + variable.value + '\n';
        for (const std::string& choice : variable.choices) lines += choice + '\n';
        lines += '\n';
    }
    return returnText(std::move(lines));
}

const char* PHYSVIB_PAGE(fault)() { return world->inputError().c_str(); }
const float* PHYSVIB_PAGE(render)(int frames) { return world->render(frames); }
int PHYSVIB_PAGE(outputLatencyFrames)() { return static_cast<int>(world->outputLatencyFrames()); }
const float* PHYSVIB_PAGE(poses)() { return world->poses().data(); }
int PHYSVIB_PAGE(bodyCount)() { return static_cast<int>(world->bodies().size()); }

/// The next impact played since the last call: x, y, frequency, decay, amplitude, duration (s; 0: not
/// limited), time of its first sample (s), and kind as in physvib.h; null if there is none.
const double* PHYSVIB_PAGE(hit)() {
    static std::array<double, 8> result;
    CollisionEvent e;
    double outputSeconds = 0.0;
    if (!world->nextHit(e, outputSeconds)) return nullptr;
    const double duration = static_cast<double>(e.durationNs) * 1e-9, kind = static_cast<int>(e.source.kind);
    result = {e.x, e.y, e.frequencyHz, e.decayPerSecond, e.amplitude, duration, outputSeconds, kind};
    return result.data();
}

/// `finger` is in 0 to PageWorld::maxFingers - 1.
void PHYSVIB_PAGE(grip)(int finger, int body, double xMetres, double yMetres) {
    world->grab(finger, static_cast<std::size_t>(body), {xMetres, yMetres});
}
void PHYSVIB_PAGE(letGo)(int finger) { world->release(finger); }
void PHYSVIB_PAGE(hold)(double angleRadians, double factor) {
    world->applyInput(HoldAction{factor, angleRadians});
}
void PHYSVIB_PAGE(steer)(int direction) { world->steer(direction); }
bool PHYSVIB_PAGE(isPlayed)() { return world->isPlayed(); }
void PHYSVIB_PAGE(sound)(int material, double frequencyHz, double decayPerSecond) {
    world->applyInput(SoundAction{material, frequencyHz, decayPerSecond});
}

/// Sets the actuators: first their number, then each place as shares of the layout's extent, then placed().
void PHYSVIB_PAGE(enchanters)(int count) { world->layout().count = count; }
void PHYSVIB_PAGE(place)(int actuator, double x, double y) {
    ActuatorLayout& layout = world->layout();
    layout.places[static_cast<std::size_t>(actuator)] = {x * layout.extentWidthMetres,
                                                         y * layout.extentHeightMetres};
}
/// Applies the places with a law of lawList(); -1: default of `physvib render`.
void PHYSVIB_PAGE(placed)(int law) { world->applyLayout(law); }

/// Creates a QR code of `text` and returns the modules per side, for qrModule(); 0: the text is too long.
int PHYSVIB_PAGE(qrSide)(const char* text) { return qrCode.emplace(text).side(); }
bool PHYSVIB_PAGE(qrModule)(int x, int y) { return qrCode->isDark(x, y); }
}
