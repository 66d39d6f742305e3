// SPDX-License-Identifier: GPL-3.0-or-later
// Playback of stimuli and worlds of a study, markers for other recorders, and the pane of a world.
#include "Core/Units.h"
#include "Io/Disk/FileClash.h"
#include "Io/Text/CleanText.h"
#include "Io/Text/NumberText.h"
#include "Live/Session/ContactSounds.h"
#include "Live/Session/OfflineRender.h"
#include "Mixer/Studies/StudyScreen.h"
#include "Scene/SceneEdits.h"

namespace physvib {
namespace {

using Kind = RenderControl::Kind;
constexpr std::int64_t leadNs = 50'000'000; // of events after gains, which are ramped and may come late

// Only actuators with at least this share of the loudest planned peak, and this peak, are compared.
constexpr double comparedShare = 0.01, minCompared = 1e-4, toleranceDb = 1.0;
constexpr double longestPauseMs = 1e-6 * DevicePulse::goneNs + 500.0; // what was posted before is then lost
constexpr double maxPlannedSeconds = 60.0; // how long receipts are kept; rendering a plan takes time, too

constexpr const char* noControls = "The session took no more controls: expected a device that plays";

constexpr std::int32_t textFormat = 3; // cft_string
constexpr double noRate = 0.0;         // LSL_IRREGULAR_RATE
constexpr std::int32_t keptSeconds = 360;

/// Usual library names per system; PHYSVIB_LSL names another.
juce::StringArray libraryNames() {
    if (const auto own = juce::SystemStats::getEnvironmentVariable("PHYSVIB_LSL", {}); own.isNotEmpty())
        return {own};
    return {"liblsl.so.2", "liblsl.so", "liblsl.2.dylib", "liblsl.dylib", "lsl.dll"};
}

constexpr std::int64_t fadeNs = 100'000'000;  // longer than any fade-out by limits::stealFadePerSecond
constexpr std::int64_t askedNs = 500'000'000; // receipts are read for that long at once

} // namespace

StudySound::StudySound(MixerModel& model)
    : model_{model}
    , slowness_{model.session().world().slowness()} {
    model_.setSlowness(0);
    post(Kind::stopAll, 0, 0.0f);
    for (int j = 0; j < model_.mix().count(); ++j) post(Kind::mute, j, 0.0f);
}

StudySound::~StudySound() {
    const Mix& mix = model_.mix();
    if (isPlaying()) post(Kind::stopAll, 0, 0.0f);
    const PhantomPanner panner = mix.panner();
    post(Kind::panner, 0, 0.0f, &panner);
    model_.exposure().use(mix.layout);
    useRecordings({});
    const auto felt = feltStrips(mix);
    for (int j = 0; j < mix.count(); ++j) {
        post(Kind::gain, j, channelGain(nth(felt, j)));
        post(Kind::mute, j, mix.isSilent(j) ? 1.0f : 0.0f);
    }
    model_.setSlowness(slowness_);
}

void StudySound::post(Kind kind, int channel, float value, const PhantomPanner* panner) {
    const RenderControl control{.kind = kind, .channel = channel, .value = value, .panner = panner};
    if (!model_.session().submit({control})) model_.report(noControls);
}

void StudySound::useRecordings(const std::vector<ContactRecording>& recordings) {
    if (!model_.session().submit({PlayedRecordings{recordings}})) model_.report(noControls);
}

Result<FeltStimulus> StudySound::make(MixerModel& model, const TrialJob& job, const std::string& folder) {
    auto stimulus =
        feltStimulus(job, model.output().sampleRateHz() > 0 ? model.output().sampleRateHz() : 48000, folder);
    if (!stimulus) return stimulus;
    if (auto fault = refusal(model, stimulus.value); !fault.empty()) return Failure{fault};
    return stimulus;
}

std::string tooFew(const std::string& layout, int wanted, int there) {
    if (wanted <= there) return {};
    return layout + " needs " + std::to_string(wanted) + (wanted == 1 ? " actuator" : " actuators") +
           ", the mixer has " + std::to_string(there) + ": choose a preset under Actuators";
}

std::string StudySound::refusal(const MixerModel& model, const FeltStimulus& stimulus) {
    if (const auto mute = model.device().withoutClips(); !stimulus.recordings.empty() && mute.isNotEmpty())
        return "--method SV: expected a mixer without the " + mute.toStdString() +
               ", which plays no recordings";
    return tooFew(stimulus.layout.name, stimulus.layout.geometry.count, model.mix().count());
}

std::string StudySound::play(const FeltStimulus& stimulus) {
    if (auto fault = refusal(model_, stimulus); !fault.empty()) return fault;
    const auto& strips = model_.mix().strips;
    gains_.resize(strips.size());
    model_.exposure().use(stimulus.layout);
    post(Kind::panner, 0, 0.0f, &stimulus.stimulus.panner);
    useRecordings(stimulus.recordings);
    for (std::size_t j = 0; j < stimulus.gains.size(); ++j) {
        const float gain = strips[j].isInverted ? -stimulus.gains[j] : stimulus.gains[j];
        if (gain != std::exchange(gains_[j], gain)) post(Kind::gain, static_cast<int>(j), gain);
    }
    if (std::exchange(isMuted_, false))
        for (std::size_t j = 0; j < strips.size(); ++j) post(Kind::mute, static_cast<int>(j), 0.0f);
    auto strikes = stimulus.stimulus.events;
    for (auto& strike : strikes) strike.timeNs += leadNs;
    const auto taken = model_.session().submit({Strikes{strikes}});
    if (!taken) return taken.error;
    fromNs_ = taken.value + leadNs;
    untilNs_ = fromNs_ + std::llround(1e9 * stimulus.stimulus.seconds);
    session_ = model_.output().playedSession();
    model_.output().expect(fromNs_, untilNs_);
    planned_ = plannedPeaks(stimulus);
    actuators_ = stimulus.layout.enchanters;
    course_ = Course::plays;
    wasSilent_ = false;
    ranAtMs_ = nowMs();
    beganAtMs_ = nowMs() + 1e-6 * static_cast<double>(leadNs) + 1e3 * model_.device().outputLatencySeconds();
    seconds_ = stimulus.stimulus.seconds;
    return {};
}

/// The peak of each actuator behind gains, ceilings, limiter, guard and master level.
std::vector<double> StudySound::plannedPeaks(const FeltStimulus& stimulus) const {
    if (stimulus.stimulus.seconds > maxPlannedSeconds) return {};
    const int rate = model_.output().sampleRateHz();
    const ContactSounds sounds{stimulus.recordings, rate};
    OfflineSettings settings{.renderer = {.sampleRateHz = rate, .panner = stimulus.stimulus.panner},
                             .frames = std::llround(stimulus.stimulus.seconds * rate),
                             .contacts = {sounds.contacts()}};
    std::vector<RenderControl> controls;
    for (std::size_t j = 0; j < stimulus.gains.size(); ++j) {
        settings.renderer.ceilings[j] = ceilingOf(model_.mix().strips[j]);
        controls.push_back({0, Kind::gain, static_cast<int>(j), stimulus.gains[j], {}});
    }
    settings.controls = controls;
    std::vector<double> peaks(stimulus.gains.size());
    renderOffline(stimulus.stimulus.events, settings, [&](const float* const* blocks, int frames) {
        for (std::size_t j = 0; j < peaks.size(); ++j)
            for (int n = 0; n < frames; ++n)
                peaks[j] = std::max(peaks[j], std::abs(static_cast<double>(blocks[j][n])));
        return true;
    });
    for (double& peak : peaks) peak *= static_cast<double>(model_.output().level());
    return peaks;
}

// After a short pause the device continues with what was posted, so the end is awaited even if the playback
// is already incomplete.
void StudySound::update() {
    if (course_ != Course::plays) return;
    wasSilent_ = wasSilent_ || model_.isSilent();
    if (model_.output().isPlaying()) ranAtMs_ = nowMs();
    const bool isOver = model_.output().left(fromNs_, untilNs_, 0, session_).isOver;
    if (isOver)
        course_ = wasSilent_ ? Course::lost : judged();
    else if (nowMs() - ranAtMs_ > longestPauseMs)
        course_ = Course::lost;
    if (course_ != Course::plays)
        heldSeconds_ = isOver ? seconds_ : std::clamp(1e-3 * (nowMs() - beganAtMs_), 0.0, seconds_);
}

/// Compares the receipts with the plan, and stores their level in felt_.
Course StudySound::judged() {
    felt_ = {};
    const double loudest = planned_.empty() ? 0.0 : std::ranges::max(planned_);
    Course course = Course::left;
    for (std::size_t j = 0; j < actuators_.size(); ++j) {
        const Receipt receipt = model_.output().left(fromNs_, untilNs_, static_cast<int>(j), session_);
        felt_.peakG = std::max(felt_.peakG, receipt.peak * actuators_[j].fullScaleG);
        felt_.rmsG = std::max(felt_.rmsG, std::sqrt(receipt.meanSquare) * actuators_[j].fullScaleG);
        if (!receipt.isKept || !receipt.isRunning) return Course::lost;
        const double planned = j < planned_.size() ? planned_[j] : 0.0;
        if (planned < std::max(minCompared, comparedShare * loudest)) continue;
        if (std::abs(toDecibels(std::max(receipt.peak, 1e-9) / planned)) > toleranceDb)
            course = Course::unlike;
    }
    return course;
}

double StudySound::feltSeconds() const {
    return course_ == Course::plays ? std::clamp(1e-3 * (nowMs() - beganAtMs_), 0.0, seconds_) : heldSeconds_;
}

void StudySound::stop() {
    course_ = Course::none;
    isMuted_ = true;
    post(Kind::stopAll, 0, 0.0f);
    for (int j = 0; j < model_.mix().count(); ++j) post(Kind::mute, j, 1.0f);
}

// Loads liblsl at run time: the six functions of its C interface (1.14 and newer) that markers need.

struct StudyMarkers::Outlet {
    juce::DynamicLibrary library;
    void* (*createInfo)(const char* name, const char* type, std::int32_t channels, double rateHz,
                        std::int32_t format, const char* source) = nullptr;
    void* (*createOutlet)(void* info, std::int32_t chunk, std::int32_t mostSeconds) = nullptr;
    std::int32_t (*pushText)(void* outlet, const char** text, double timestamp) = nullptr;
    double (*clock)() = nullptr;
    void (*destroyOutlet)(void* outlet) = nullptr;
    void (*destroyInfo)(void* info) = nullptr;
    void* info = nullptr;
    void* outlet = nullptr;

    template <class Function>
    bool find(Function& function, const char* name) {
        function = reinterpret_cast<Function>(library.getFunction(name));
        return function != nullptr;
    }
    bool load() {
        for (const auto& name : libraryNames())
            if (library.open(name)) break;
        return find(createInfo, "lsl_create_streaminfo") && find(createOutlet, "lsl_create_outlet") &&
               find(pushText, "lsl_push_sample_strt") && find(clock, "lsl_local_clock") &&
               find(destroyOutlet, "lsl_destroy_outlet") && find(destroyInfo, "lsl_destroy_streaminfo");
    }
    ~Outlet() {
        if (outlet != nullptr) destroyOutlet(outlet);
        if (info != nullptr) destroyInfo(info);
    }
};

StudyMarkers::StudyMarkers(const std::string& protocol) {
    auto outlet = std::make_unique<Outlet>();
    if (!outlet->load()) return;
    const std::string name = "physvib-" + protocol;
    outlet->info = outlet->createInfo(name.c_str(), "Markers", 1, noRate, textFormat, name.c_str());
    if (outlet->info != nullptr) outlet->outlet = outlet->createOutlet(outlet->info, 0, keptSeconds);
    if (outlet->outlet != nullptr) outlet_ = std::move(outlet);
}

StudyMarkers::~StudyMarkers() = default;

void StudyMarkers::push(const std::string& words, double secondsFromNow) {
    if (!isOpen()) return;
    const std::string line = cleanLine(words);
    const char* text = line.c_str();
    outlet_->pushText(outlet_->outlet, &text, outlet_->clock() + secondsFromNow);
}

std::string StudyWorld::refusal(const MixerModel& model, const FeltWorld& world) {
    if (const auto beside = model.session().sinks().states(); !beside.empty())
        return "a world: expected a mixer without the " + beside.front().name +
               ", which follows one session only";
    return tooFew(world.layout.name, world.layout.geometry.count, model.mix().count());
}

std::string StudyWorld::begin(FeltWorld world, bool hasHands, const std::filesystem::path& file) {
    finish();
    if (auto fault = refusal(model_, world); !fault.empty()) return fault;
    setup_ = std::move(world.setup);
    if (hasHands) setup_.scene = sceneForHands(std::move(setup_.scene));
    setup_.longestGapSeconds = threadGapSeconds(setup_.stepsPerSecond);
    setup_.log = LogUse::stream;
    setup_.marks = MarkedOnsets::all;
    seconds_ = hasHands ? 0.0 : world.seconds;
    feltNs_ = seenNs_ = checkedNs_ = 0;
    left_.clear();
    for (const auto& actuator : world.layout.enchanters) left_.push_back({actuator.fullScaleG});
    course_ = Course::none;
    stoppedNs_ = -1;
    fault_.clear();
    std::error_code none;
    const auto folder = file.parent_path();
    std::filesystem::create_directories(folder, none);
    if (!isWithin(folder.parent_path(), folder)) return folder.string() + ": " + leadsElsewhere;
    session_ = std::make_unique<Session>(setup_);
    model_.exposure().use(world.layout);
    model_.output().expect(0, std::llround(1e9 * seconds_));
    if (!model_.output().playInstead(session_.get())) return session_.reset(), "expected a device that plays";
    number_ = model_.output().playedSession();
    sendStrips();
    journal_ = std::make_unique<SessionJournal>(
        file, *session_, setup_,
        Provenance{PHYSVIB_VERSION, {{"scene", setup_.scene.name}, {"seed", std::to_string(setup_.seed)}}});
    if (auto fault = journal_->error(); !fault.empty()) return finish(), fault;
    driver_ = std::make_unique<ThreadDriver>(*session_, setup_.stepsPerSecond); // starts its time
    course_ = Course::plays;
    return {};
}

/// The world is lost as soon as one actuator of its layout missed a frame.
void StudyWorld::askReceipts(std::int64_t untilNs) {
    if (!model_.output().isPlaying()) course_ = Course::lost;
    if (course_ != Course::plays || untilNs <= checkedNs_) return;
    const std::int64_t setNs = std::llround(1e9 * seconds_), afterNs = untilNs;
    const bool isMeasured = setNs == 0 || checkedNs_ < setNs;
    if (isMeasured && setNs > 0) untilNs = std::min(untilNs, setNs);
    auto left = left_;
    std::int64_t endNs = untilNs;
    for (std::size_t j = 0; j < left.size(); ++j) {
        const Receipt receipt = model_.output().left(checkedNs_, untilNs, static_cast<int>(j), number_);
        if (!receipt.isOver) return; // the last block has no receipt yet
        if (!receipt.isRunning) course_ = Course::lost;
        endNs = receipt.endNs; // no bin is added twice
        if (!isMeasured) continue;
        left[j].peak = std::max(left[j].peak, receipt.peak);
        left[j].squareSeconds +=
            receipt.meanSquare * static_cast<double>(receipt.frames) / model_.output().sampleRateHz();
    }
    left_ = std::move(left);
    checkedNs_ = std::max(endNs, untilNs); // a lost one may end before
    askReceipts(afterNs);
}

FeltLevel StudyWorld::felt() const {
    const double seconds = std::max(1e-3, seconds_ > 0.0 ? seconds_ : feltSeconds());
    FeltLevel level;
    for (const Left& one : left_) {
        level.peakG = std::max(level.peakG, one.peak * one.fullScaleG);
        level.rmsG = std::max(level.rmsG, std::sqrt(one.squareSeconds / seconds) * one.fullScaleG);
    }
    return level;
}

void StudyWorld::sendStrips() {
    auto strips = model_.mix().strips;
    strips.resize(static_cast<std::size_t>(setup_.channels));
    for (Strip& strip : strips) strip.gainDb = 0.0, strip.isMuted = strip.isSolo = false;
    std::array<SentStrip, limits::maxEnchanters> sent{};
    physvib::sendStrips(sent, strips, [this](const RenderControl& control) {
        return session_->submit({control}).error.empty();
    });
}

void StudyWorld::end() {
    if (!isMoving()) return;
    session_->world().setSlowness(0);
    // queue full: the world continues, and end() is called again by the next look()
    if (const auto stopped = session_->submit({RenderControl{.kind = Kind::stopAll}}))
        stoppedNs_ = stopped.value;
}

std::string StudyWorld::act(const Action& action) {
    return isMoving() ? session_->submit({action}).error : std::string{};
}

WorldMoment StudyWorld::look() {
    WorldMoment moment;
    if (!session_) return moment;
    for (PlayedEvent played; session_->played().pop(played);)
        journal_->played(played, session_->timeline().sampleRateHz());
    moment.sessionNs = session_->world().readPoses(moment.poses);
    moment.aheadNs = session_->timeline().outputLatencyFrames() * 1'000'000'000 /
                     std::max(1, model_.output().sampleRateHz());
    const std::int64_t now = session_->status().sessionNs, felt = session_->timeline().nextFeltNs();
    if (felt >= checkedNs_ + askedNs || !model_.output().isPlaying()) askReceipts(felt);
    if (model_.isSilent() && seconds_ > 0.0 && isMoving()) course_ = Course::lost; // to be repeated
    if (course_ == Course::lost) return finish(), moment; // a stopped device plays no fade-out
    if (isMoving()) {
        session_->world().setSlowness(model_.isSilent() ? 0 : 1); // a world pauses while silent
        if (!model_.isSilent())
            feltNs_ = std::min(feltNs_ + now - seenNs_, std::max<std::int64_t>(0, now - moment.aheadNs));
        if (seconds_ > 0.0 && feltSeconds() >= seconds_) end();
    } else if (felt >= stoppedNs_ + fadeNs) { // the latency may have grown
        askReceipts(stoppedNs_);
        if (course_ == Course::plays) course_ = Course::left;
        finish();
    }
    seenNs_ = now;
    return moment;
}

void StudyWorld::finish() {
    if (!session_) return;
    if (course_ == Course::plays) course_ = Course::none;
    model_.output().playInstead(nullptr);
    driver_.reset();
    session_->advance(); // simulates up to the end of time, from which a later render would continue
    // Impacts of the last step are known one step later, which does not exist here. A render that ended at
    // the pause would include them.
    const std::int64_t endNs = stoppedNs_ < 0 ? session_->status().sessionNs : stoppedNs_ + fadeNs;
    if (journal_ && journal_->error().empty()) {
        for (PlayedEvent played; session_->played().pop(played);)
            journal_->played(played, session_->timeline().sampleRateHz());
        journal_->end(endNs);
        fault_ = journal_->finish(SessionJournal::quickBytes); // limited, because the window waits
    }
    journal_.reset();
    session_.reset();
}

StudyWorldPane::StudyWorldPane(MixerModel& model)
    : model_{model}
    , world_{model} {
    setTitle("World of the trial");
    view_.onPull = [this](const std::string& body, Vector screenMetres, Vector point) {
        if (hasHands_)
            act(ImpulseAction{body, {thesisDrag * screenMetres.x, thesisDrag * screenMetres.y}, point});
    };
    tilt_.onValueChange = [this] { act(TiltAction{tilt_.angleRadians()}); };
    view_.setMargin(8);        // there are no badges here
    view_.showMaterials(true); // materials are visible, as participants form expectations by them
    addAndMakeVisible(view_);
    addChildComponent(tilt_);
}

void StudyWorldPane::act(const Action& action) {
    if (const auto fault = world_.act(action); !fault.empty() && onFault) onFault(fault);
}

std::string StudyWorldPane::begin(FeltWorld world, bool hasHands, const std::filesystem::path& file) {
    preview(world.setup.scene);
    if (!view_.fits()) {
        const auto millimetres = [this](double metres) { return fixedNumber(1e3 * metres / worldScale_, 0); };
        const Scene& scene = world.setup.scene;
        return "display_scale: expected a larger window or display, as the world is " +
               millimetres(scene.fieldWidthMetres) + " x " + millimetres(scene.fieldHeightMetres) +
               " mm at 1:" + numberText(worldScale_);
    }
    if (auto fault = world_.begin(std::move(world), hasHands, file); !fault.empty()) return fault;
    hasHands_ = hasHands;
    tilt_.setVisible(hasHands);
    tilt_.setValue(0.0, juce::dontSendNotification);
    preview(world_.scene());
    return {};
}

void StudyWorldPane::preview(const Scene& scene) {
    view_.setDisplayWidth(model_.displayWidthMetres());
    view_.show(Scene{}); // resets the view if the same scene starts again
    view_.show(scene);
}

void StudyWorldPane::refresh() {
    if (auto moment = world_.look(); !moment.poses.empty()) view_.update(std::move(moment));
}

void StudyWorldPane::resized() {
    view_.setBounds(getLocalBounds().reduced(3));
    tilt_.setBounds(getLocalBounds().reduced(10).removeFromBottom(44).removeFromRight(44));
}

} // namespace physvib
