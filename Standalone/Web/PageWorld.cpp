// SPDX-License-Identifier: MIT
// The files that the page opens; PageWorld, a running scene with its haptic output, on the
// thread that renders the audio; and the functions of the
// WebAssembly module that the page calls, besides the motor controllers in Source/Api/JavaScript. On an error
// they do not return (js::refuse), and the page discards the instance.
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
#include "Scene/World/InputCheck.h"
#include "Scene/World/SceneCast.h"
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

/// A file that a page opens: a scene and the events played in it. A scene file has none, an event list has
/// its own, and a clip has one, which plays its samples. MPEG formats are refused, to keep the page small.
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

/// `name` ends in .csv, .haptic or .ahap; otherwise it is a scene. A list without a field gets one of the
/// given size, m. A clip plays in the centre of all actuators, as in `physvib render`.
Result<PageFile> readPageFile(std::string_view name, std::string_view text, const SceneSettings& settings,
                              Vector fieldMetres, int sampleRateHz) {
    if (const auto format = clipFormatOf(name)) return readClipFile(name, text, *format, sampleRateHz);
    if (name.ends_with(".csv")) return readList(name, text, fieldMetres);
    auto read = readScene(text, "scene", settings);
    if (!read) return Failure{std::move(read.error)};
    return PageFile{std::move(read.value), {}, {}};
}

/// A running scene. Its output equals the rendered file, delayed by outputLatencyFrames(). One thread has all
/// roles of Live/Session/Session.h, and steps the world in the block that needs it.
class PageWorld {
public:
    static constexpr int stepsPerSecond = 100;
    static constexpr int fingers = 10; ///< maximum number of bodies held at once

    /// Throws the exceptions of Simulation, or std::invalid_argument for a sample rate or number of outputs
    /// that cannot be rendered.
    PageWorld(PageFile file, std::uint32_t seed, int sampleRateHz, int outputs)
        : file_{std::move(file)}
        , clip_{clipFrequencyHz, file_.samples, soundOfClip(0)}
        , simulation_{file_.scene, seed, stepsPerSecond}
        , check_{file_.scene, InputCheck::endless}
        , player_{file_.scene}
        , cast_{sceneCast(file_.scene)}
        , fieldMetres_{file_.scene.fieldWidthMetres, file_.scene.fieldHeightMetres}
        , law_{.sampleRateHz = sampleRateHz, .blockFrames = 0, .stepsPerSecond = stepsPerSecond}
        , outputs_{static_cast<std::size_t>(outputs)} {
        layoutPreset("phone4", layout_);
        if (!renderer_->prepare({.sampleRateHz = sampleRateHz,
                                 .channels = outputs,
                                 .panner = panner(),
                                 .instructions = InstructionSet::scalar}))
            throw std::invalid_argument("sound: expected 5000 to 192000 Hz and 4 to 64 outputs");
        law_.limiterFrames = renderer_->latencyFrames();
        if (file_.samples.empty()) return;
        controls_.push({.kind = RenderControl::Kind::recordings, .recordings = {{&clip_, 1}, false}});
    }

    /// Renders the next frames; the result has them channel by channel and is valid until the next call.
    const float* render(int frames) {
        stepTo(done_ + frames);
        samples_.resize(outputs_ * static_cast<std::size_t>(frames));
        const int silent = static_cast<int>(std::clamp<std::int64_t>(firstFrame() - done_, 0, frames));
        std::array<float*, limits::maxEnchanters> out{};
        for (std::size_t j = 0; j < outputs_; ++j)
            out[j] = std::fill_n(samples_.data() + j * static_cast<std::size_t>(frames), silent, 0.0f);
        if (silent < frames) renderer_->render(*this, out.data(), frames - silent);
        done_ += frames;
        return samples_.data();
    }
    std::int64_t outputLatencyFrames() const noexcept { return law_.outputLatencyFrames(); }

    /// Per body of cast() x and y in m, angle in rad, and presence (1 or 0), consecutively.
    const std::vector<float>& poses() {
        poses_.clear();
        for (std::size_t i = 0; i < cast_.size(); ++i) {
            const BodyPose at = simulation_.pose(i);
            for (const double value : {at.xMetres, at.yMetres, at.angleRadians, at.isPresent ? 1.0 : 0.0})
                poses_.push_back(static_cast<float>(value));
        }
        return poses_;
    }
    const std::vector<BodyDescription>& cast() const noexcept { return cast_; }
    const Scene& scene() const noexcept { return simulation_.scene(); }

    /// The next impact played since the last call, and its time in seconds of the output; false if there is
    /// none. Clips are not reported.
    bool takeHit(CollisionEvent& hit, double& atSeconds) {
        PlayedEvent played;
        if (!renderer_->played().pop(played) || !file_.samples.empty()) return false;
        hit = played.event;
        atSeconds = static_cast<double>(played.frame + law_.outputLatencyFrames()) / law_.sampleRateHz;
        return true;
    }

    /// Applies an input now; if it is refused, fault() says why.
    void act(const Action& action) {
        if (fault_ = check_.take(action); fault_.empty())
            simulation_.addInput(static_cast<double>(simulation_.timeNs()) * 1e-9, action);
    }
    void steer(int way) {
        for (const Action& action : player_.steer(way)) act(action);
    }
    bool isPlayed() const noexcept { return player_.isThere(); }
    const std::string& fault() const noexcept { return fault_; } ///< of the last input; empty: none

    /// Pulls the body towards a place until letGo().
    void grip(int finger, std::size_t body, Vector toMetres) {
        if (finger < 0 || finger >= fingers || body >= cast_.size()) return;
        hands_[static_cast<std::size_t>(finger)] = Hand{body, toMetres};
    }
    // Stops a kinematic body, which would keep its velocity.
    void letGo(int finger) {
        if (finger < 0 || finger >= fingers) return;
        const auto held = std::exchange(hands_[static_cast<std::size_t>(finger)], {});
        if (held && cast_[held->body].type == BodyType::kinematicBody)
            act(VelocityAction{cast_[held->body].name, {}});
    }

    /// At most as many actuators as outputs; placed() applies changes.
    EnchanterLayout& layout() noexcept { return layout_; }
    /// Index in panningLaws; any other value: PanningLaw::automatic.
    void placed(int law) {
        const auto index = static_cast<std::size_t>(law); // -1 becomes larger than any index
        panningLaw_ = index < panningLaws.size() ? panningLaws[index].law : PanningLaw::automatic;
        const std::int64_t timeNs = nsOf(std::max<std::int64_t>(0, done_ - firstFrame()));
        const PhantomPanner now = panner();
        controls_.push({.timeNs = timeNs, .kind = RenderControl::Kind::panner, .panner = &now});
    }

    bool pop(CollisionEvent& event) noexcept { // called by the renderer, like the two below
        if (events_.empty()) return false;
        event = events_.front();
        events_.pop_front();
        return true;
    }
    bool pop(RenderControl& change) noexcept { return controls_.pop(change); }
    void done(const RenderControl& change) noexcept { controls_.done(change); }

private:
    static constexpr double pullPerSecond = 12.0, fastestPull = 12.0; // share of the remaining distance; m/s

    struct Hand {
        std::size_t body;
        Vector to;
    };
    PhantomPanner panner() const noexcept {
        return {layout_, panningLaw_, 1.0, fieldMetres_.x, fieldMetres_.y};
    }
    // Frame of the output at which the renderer starts.
    std::int64_t firstFrame() const noexcept { return law_.outputLatencyFrames() - law_.limiterFrames; }
    std::int64_t nsOf(std::int64_t frame) const noexcept {
        return static_cast<std::int64_t>(static_cast<double>(frame) * 1e9 / law_.sampleRateHz);
    }
    void pull(const Hand& hand) {
        const BodyPose at = simulation_.pose(hand.body);
        if (!at.isPresent) return;
        const Vector way{pullPerSecond * (hand.to.x - at.xMetres), pullPerSecond * (hand.to.y - at.yMetres)};
        const double share = std::min(1.0, fastestPull / std::max(1e-9, std::hypot(way.x, way.y)));
        act(VelocityAction{cast_[hand.body].name, {share * way.x, share * way.y}});
    }
    void stepTo(std::int64_t frame) {
        while (simulation_.timeNs() < nsOf(frame)) {
            for (const auto& hand : hands_)
                if (hand) pull(*hand);
            simulation_.step(made_);
            simulation_.forgetDone();
        }
        events_.insert(events_.end(), made_.begin(), made_.end());
        made_.clear();
        for (; struck_ < file_.strikes.size() && file_.strikes[struck_].timeNs < simulation_.timeNs();
             ++struck_)
            events_.push_back(file_.strikes[struck_]);
    }

    const PageFile file_;
    RecordedContact clip_;   // samples of the file
    std::size_t struck_ = 0; // events of the file that were queued
    Simulation simulation_;
    InputCheck check_;
    ScenePlayer player_;
    std::vector<BodyDescription> cast_;
    Vector fieldMetres_;
    ClockLaw law_;
    EnchanterLayout layout_;
    std::unique_ptr<HapticRenderer> renderer_ = std::make_unique<HapticRenderer>();
    std::vector<CollisionEvent> made_;
    std::deque<CollisionEvent> events_;
    ControlQueue<256> controls_;
    std::vector<float> samples_, poses_;
    std::array<std::optional<Hand>, fingers> hands_;
    PanningLaw panningLaw_ = PanningLaw::automatic;
    std::string fault_;
    std::size_t outputs_;
    std::int64_t done_ = 0; // in frames
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
