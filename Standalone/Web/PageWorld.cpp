// SPDX-License-Identifier: MIT
// Steps the world, applies pulls, and renders with the output latency.
#include "PageWorld.h"
#include "Formats/ClipFile.h"
#include "Formats/StrikeClip.h"
#include "Measure/HitExcerpt.h"
#include "Scene/EventsCsv.h"
#include "Scene/World/SceneCast.h"
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace physvib {
namespace {

constexpr double pullPerSecond = 12.0, fastestPull = 12.0; // share of the remaining distance; m/s

} // namespace

PageWorld::PageWorld(PageFile file, std::uint32_t seed, int sampleRateHz, int outputs)
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

PhantomPanner PageWorld::panner() const noexcept {
    return {layout_, panningLaw_, 1.0, fieldMetres_.x, fieldMetres_.y};
}

std::int64_t PageWorld::nsOf(std::int64_t frame) const noexcept {
    return static_cast<std::int64_t>(static_cast<double>(frame) * 1e9 / law_.sampleRateHz);
}

void PageWorld::act(const Action& action) {
    if (fault_ = check_.take(action); fault_.empty())
        simulation_.addInput(static_cast<double>(simulation_.timeNs()) * 1e-9, action);
}

void PageWorld::steer(int way) {
    for (const Action& action : player_.steer(way)) act(action);
}

void PageWorld::grip(int finger, std::size_t body, Vector toMetres) {
    if (finger < 0 || finger >= fingers || body >= cast_.size()) return;
    hands_[static_cast<std::size_t>(finger)] = Hand{body, toMetres};
}

// A kinematic body would keep its velocity.
void PageWorld::letGo(int finger) {
    if (finger < 0 || finger >= fingers) return;
    const auto held = std::exchange(hands_[static_cast<std::size_t>(finger)], {});
    if (held && cast_[held->body].type == BodyType::kinematicBody)
        act(VelocityAction{cast_[held->body].name, {}});
}

void PageWorld::pull(const Hand& hand) {
    const BodyPose at = simulation_.pose(hand.body);
    if (!at.isPresent) return;
    const Vector way{pullPerSecond * (hand.to.x - at.xMetres), pullPerSecond * (hand.to.y - at.yMetres)};
    const double share = std::min(1.0, fastestPull / std::max(1e-9, std::hypot(way.x, way.y)));
    act(VelocityAction{cast_[hand.body].name, {share * way.x, share * way.y}});
}

void PageWorld::placed(int law) {
    const auto index = static_cast<std::size_t>(law); // -1 becomes larger than any index
    panningLaw_ = index < panningLaws.size() ? panningLaws[index].law : PanningLaw::automatic;
    const std::int64_t timeNs = nsOf(std::max<std::int64_t>(0, done_ - firstFrame()));
    const PhantomPanner now = panner();
    controls_.push({.timeNs = timeNs, .kind = RenderControl::Kind::panner, .panner = &now});
}

void PageWorld::stepTo(std::int64_t frame) {
    while (simulation_.timeNs() < nsOf(frame)) {
        for (const auto& hand : hands_)
            if (hand) pull(*hand);
        simulation_.step(made_);
        simulation_.forgetDone();
    }
    events_.insert(events_.end(), made_.begin(), made_.end());
    made_.clear();
    for (; struck_ < file_.strikes.size() && file_.strikes[struck_].timeNs < simulation_.timeNs(); ++struck_)
        events_.push_back(file_.strikes[struck_]);
}

const float* PageWorld::render(int frames) {
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

const std::vector<float>& PageWorld::poses() {
    poses_.clear();
    for (std::size_t i = 0; i < cast_.size(); ++i) {
        const BodyPose at = simulation_.pose(i);
        for (const double value : {at.xMetres, at.yMetres, at.angleRadians, at.isPresent ? 1.0 : 0.0})
            poses_.push_back(static_cast<float>(value));
    }
    return poses_;
}

bool PageWorld::takeHit(CollisionEvent& hit, double& atSeconds) {
    PlayedEvent played;
    if (!renderer_->played().pop(played) || !file_.samples.empty()) return false;
    hit = played.event;
    atSeconds = static_cast<double>(played.frame + law_.outputLatencyFrames()) / law_.sampleRateHz;
    return true;
}

// Reads files by the extension of their name. MPEG formats are rejected with a hint, to keep the page small.

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
