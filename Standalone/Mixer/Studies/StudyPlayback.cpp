// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of StudyScreen that play a trial: StimulusPlayer sends events to the mixer's session, and checks in
// the output's level history (receipts) that they were played whole; StudyWorld runs a world as a session of
// its own, which StudyWorldPane displays; StudyMarkers reports their times to the Lab Streaming Layer.
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
constexpr std::int64_t eventLeadNs = 50'000'000; // events begin this long after the gains, which are ramped

// An actuator is compared if its planned peak is at least this share of the loudest one, and of full scale.
constexpr double minComparedShare = 0.01, minComparedPeak = 1e-4, toleranceDb = 1.0;
constexpr double maxPauseMs = 1e-6 * DevicePulse::goneAfterNs + 500.0; // longer pauses lose events
constexpr double maxPlannedSeconds = 60.0; // receipts are kept that long; longer stimuli are not compared

constexpr const char* controlsError = "The session took no more controls: expected a device that plays";

constexpr std::int32_t textFormat = 3;      // cft_string
constexpr double irregularRateHz = 0.0;     // LSL_IRREGULAR_RATE
constexpr std::int32_t bufferSeconds = 360; // liblsl's default

/// Default names of the library per system; the variable PHYSVIB_LSL names another one.
juce::StringArray lslLibraryNames() {
    if (const auto path = juce::SystemStats::getEnvironmentVariable("PHYSVIB_LSL", {}); path.isNotEmpty())
        return {path};
    return {"liblsl.so.2", "liblsl.so", "liblsl.2.dylib", "liblsl.dylib", "lsl.dll"};
}

constexpr std::int64_t fadeNs = 100'000'000; // longer than any fade-out by limits::stealFadePerSecond
constexpr std::int64_t receiptIntervalNs = 500'000'000; // receipts are read in pieces of this duration

} // namespace

StimulusPlayer::StimulusPlayer(MixerModel& model)
    : model_{model}
    , slowness_{model.session().world().slowness()} {
    model_.setSlowness(0);
    send(Kind::stopAll, 0, 0.0f);
    for (int j = 0; j < model_.mix().count(); ++j) send(Kind::mute, j, 0.0f);
}

StimulusPlayer::~StimulusPlayer() {
    const Mix& mix = model_.mix();
    if (isPlaying()) send(Kind::stopAll, 0, 0.0f);
    const PhantomPanner panner = mix.panner();
    send(Kind::panner, 0, 0.0f, &panner);
    model_.exposure().setLayout(mix.layout);
    useRecordings({});
    const auto strips = effectiveStrips(mix);
    for (int j = 0; j < mix.count(); ++j) {
        send(Kind::gain, j, channelGain(nth(strips, j)));
        send(Kind::mute, j, mix.isSilent(j) ? 1.0f : 0.0f);
    }
    model_.setSlowness(slowness_);
}

void StimulusPlayer::send(Kind kind, int channel, float value, const PhantomPanner* panner) {
    const RenderControl control{.kind = kind, .channel = channel, .value = value, .panner = panner};
    if (!model_.session().submit({control})) model_.report(controlsError);
}

void StimulusPlayer::useRecordings(const std::vector<ContactRecording>& recordings) {
    if (!model_.session().submit({PlayedRecordings{recordings}})) model_.report(controlsError);
}

Result<PlayableStimulus> StimulusPlayer::prepare(MixerModel& model, const TrialJob& job,
                                                 const std::string& folder) {
    auto stimulus = makePlayableStimulus(
        job, model.output().sampleRateHz() > 0 ? model.output().sampleRateHz() : 48000, folder);
    if (!stimulus) return stimulus;
    if (auto error = playbackError(model, stimulus.value); !error.empty()) return Failure{error};
    return stimulus;
}

std::string actuatorCountError(const std::string& layout, int needed, int available) {
    if (needed <= available) return {};
    return layout + " needs " + std::to_string(needed) + (needed == 1 ? " actuator" : " actuators") +
           ", the mixer has " + std::to_string(available) + ": choose a preset under Actuators";
}

std::string StimulusPlayer::playbackError(const MixerModel& model, const PlayableStimulus& stimulus) {
    if (const auto sinkName = model.device().sinkWithoutClips();
        !stimulus.recordings.empty() && sinkName.isNotEmpty())
        return "--method SV: expected a mixer without the " + sinkName.toStdString() +
               ", which plays no recordings";
    return actuatorCountError(stimulus.layout.name, stimulus.layout.geometry.count, model.mix().count());
}

std::string StimulusPlayer::play(const PlayableStimulus& stimulus) {
    if (auto error = playbackError(model_, stimulus); !error.empty()) return error;
    const auto& strips = model_.mix().strips;
    gains_.resize(strips.size());
    model_.exposure().setLayout(stimulus.layout);
    send(Kind::panner, 0, 0.0f, &stimulus.stimulus.panner);
    useRecordings(stimulus.recordings);
    for (std::size_t j = 0; j < stimulus.gains.size(); ++j) {
        const float gain = strips[j].isInverted ? -stimulus.gains[j] : stimulus.gains[j];
        if (gain != std::exchange(gains_[j], gain)) send(Kind::gain, static_cast<int>(j), gain);
    }
    if (std::exchange(isMuted_, false))
        for (std::size_t j = 0; j < strips.size(); ++j) send(Kind::mute, static_cast<int>(j), 0.0f);
    auto events = stimulus.stimulus.events;
    for (auto& event : events) event.timeNs += eventLeadNs;
    const auto submission = model_.session().submit({Strikes{events}});
    if (!submission) return submission.error;
    startNs_ = submission.value + eventLeadNs;
    endNs_ = startNs_ + std::llround(1e9 * stimulus.stimulus.seconds);
    sessionNumber_ = model_.output().playedSession();
    model_.output().alignBinsTo(startNs_, endNs_);
    plannedPeaks_ = plannedPeaks(stimulus);
    actuators_ = stimulus.layout.actuators;
    status_ = PlaybackStatus::playing;
    wasSilent_ = false;
    lastPlayingMs_ = nowMs();
    outputStartMs_ =
        nowMs() + 1e-6 * static_cast<double>(eventLeadNs) + 1e3 * model_.device().outputLatencySeconds();
    seconds_ = stimulus.stimulus.seconds;
    return {};
}

/// Renders the stimulus for the peak of each actuator at its output; empty: it is too long to be compared.
std::vector<double> StimulusPlayer::plannedPeaks(const PlayableStimulus& stimulus) const {
    if (stimulus.stimulus.seconds > maxPlannedSeconds) return {};
    const int rate = model_.output().sampleRateHz();
    const ContactSounds sounds{stimulus.recordings, rate};
    OfflineSettings settings{.renderer = {.sampleRateHz = rate, .panner = stimulus.stimulus.panner},
                             .frames = std::llround(stimulus.stimulus.seconds * rate),
                             .contacts = {sounds.contacts()}};
    std::vector<RenderControl> controls;
    for (std::size_t j = 0; j < stimulus.gains.size(); ++j) {
        settings.renderer.ceilings[j] = channelCeiling(model_.mix().strips[j]);
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

// After a short pause the device continues with what was sent, so the end is awaited even if the playback
// is already incomplete.
void StimulusPlayer::update() {
    if (status_ != PlaybackStatus::playing) return;
    wasSilent_ = wasSilent_ || model_.isSilent();
    if (model_.output().isPlaying()) lastPlayingMs_ = nowMs();
    const bool isOver = model_.output().receiptFor(startNs_, endNs_, 0, sessionNumber_).hasEnded;
    if (isOver)
        status_ = wasSilent_ ? PlaybackStatus::incomplete : statusFromReceipts();
    else if (nowMs() - lastPlayingMs_ > maxPauseMs)
        status_ = PlaybackStatus::incomplete;
    if (status_ != PlaybackStatus::playing)
        playedSeconds_ = isOver ? seconds_ : std::clamp(1e-3 * (nowMs() - outputStartMs_), 0.0, seconds_);
}

/// Compares the receipts with the plan, and stores their level in level_.
PlaybackStatus StimulusPlayer::statusFromReceipts() {
    level_ = {};
    const double loudest = plannedPeaks_.empty() ? 0.0 : std::ranges::max(plannedPeaks_);
    PlaybackStatus status = PlaybackStatus::complete;
    for (std::size_t j = 0; j < actuators_.size(); ++j) {
        const Receipt receipt =
            model_.output().receiptFor(startNs_, endNs_, static_cast<int>(j), sessionNumber_);
        level_.peakG = std::max(level_.peakG, receipt.peak * actuators_[j].fullScaleG);
        level_.rmsG = std::max(level_.rmsG, std::sqrt(receipt.meanSquare) * actuators_[j].fullScaleG);
        if (!receipt.isInMemory || !receipt.isRunning) return PlaybackStatus::incomplete;
        const double planned = j < plannedPeaks_.size() ? plannedPeaks_[j] : 0.0;
        if (planned < std::max(minComparedPeak, minComparedShare * loudest)) continue;
        if (std::abs(toDecibels(std::max(receipt.peak, 1e-9) / planned)) > toleranceDb)
            status = PlaybackStatus::wrongLevel;
    }
    return status;
}

double StimulusPlayer::playedSeconds() const {
    return status_ == PlaybackStatus::playing ? std::clamp(1e-3 * (nowMs() - outputStartMs_), 0.0, seconds_)
                                              : playedSeconds_;
}

void StimulusPlayer::stop() {
    status_ = PlaybackStatus::none;
    isMuted_ = true;
    send(Kind::stopAll, 0, 0.0f);
    for (int j = 0; j < model_.mix().count(); ++j) send(Kind::mute, j, 1.0f);
}

// Loads liblsl at run time: the six functions of its C interface (1.14 and newer) that markers need.

struct StudyMarkers::Outlet {
    juce::DynamicLibrary library;
    void* (*createInfo)(const char* name, const char* type, std::int32_t channels, double rateHz,
                        std::int32_t format, const char* source) = nullptr;
    void* (*createOutlet)(void* info, std::int32_t chunk, std::int32_t maxBufferSeconds) = nullptr;
    std::int32_t (*pushText)(void* outlet, const char** text, double timestamp) = nullptr;
    double (*clock)() = nullptr;
    void (*destroyOutlet)(void* outlet) = nullptr;
    void (*destroyInfo)(void* info) = nullptr;
    void* info = nullptr;
    void* outlet = nullptr;

    template <class Function>
    bool resolve(Function& function, const char* name) {
        function = reinterpret_cast<Function>(library.getFunction(name));
        return function != nullptr;
    }
    bool load() {
        for (const auto& name : lslLibraryNames())
            if (library.open(name)) break;
        return resolve(createInfo, "lsl_create_streaminfo") && resolve(createOutlet, "lsl_create_outlet") &&
               resolve(pushText, "lsl_push_sample_strt") && resolve(clock, "lsl_local_clock") &&
               resolve(destroyOutlet, "lsl_destroy_outlet") && resolve(destroyInfo, "lsl_destroy_streaminfo");
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
    outlet->info = outlet->createInfo(name.c_str(), "Markers", 1, irregularRateHz, textFormat, name.c_str());
    if (outlet->info != nullptr) outlet->outlet = outlet->createOutlet(outlet->info, 0, bufferSeconds);
    if (outlet->outlet != nullptr) outlet_ = std::move(outlet);
}

StudyMarkers::~StudyMarkers() = default;

void StudyMarkers::push(const std::string& marker, double secondsFromNow) {
    if (!isOpen()) return;
    const std::string line = cleanLine(marker);
    const char* text = line.c_str();
    outlet_->pushText(outlet_->outlet, &text, outlet_->clock() + secondsFromNow);
}

std::string StudyWorld::playbackError(const MixerModel& model, const PlayableWorld& world) {
    if (const auto sinks = model.session().sinks().states(); !sinks.empty())
        return "a world: expected a mixer without the " + sinks.front().name +
               ", which follows one session only";
    return actuatorCountError(world.layout.name, world.layout.geometry.count, model.mix().count());
}

std::string StudyWorld::begin(PlayableWorld world, bool isInteractive, const std::filesystem::path& file) {
    finish();
    if (auto error = playbackError(model_, world); !error.empty()) return error;
    setup_ = std::move(world.setup);
    if (isInteractive) setup_.scene = sceneForUserInput(std::move(setup_.scene));
    setup_.longestGapSeconds = threadGapSeconds(setup_.stepsPerSecond);
    setup_.log = LogUse::stream;
    setup_.marks = MarkedOnsets::all;
    seconds_ = isInteractive ? 0.0 : world.seconds;
    playedNs_ = lastUpdateNs_ = checkedNs_ = 0;
    outputSums_.clear();
    for (const auto& actuator : world.layout.actuators) outputSums_.push_back({actuator.fullScaleG});
    status_ = PlaybackStatus::none;
    stoppedNs_ = -1;
    saveError_.clear();
    std::error_code ignored;
    const auto folder = file.parent_path();
    std::filesystem::create_directories(folder, ignored);
    if (!isWithin(folder.parent_path(), folder)) return folder.string() + ": " + linkLeadsElsewhere;
    session_ = std::make_unique<Session>(setup_);
    model_.exposure().setLayout(world.layout);
    model_.output().alignBinsTo(0, std::llround(1e9 * seconds_));
    if (!model_.output().playInstead(session_.get())) return session_.reset(), "expected a device that plays";
    sessionNumber_ = model_.output().playedSession();
    sendStrips();
    journal_ = std::make_unique<SessionJournal>(
        file, *session_, setup_,
        Provenance{PHYSVIB_VERSION, {{"scene", setup_.scene.name}, {"seed", std::to_string(setup_.seed)}}});
    if (auto error = journal_->error(); !error.empty()) return finish(), error;
    driver_ = std::make_unique<ThreadDriver>(*session_, setup_.stepsPerSecond); // starts session time
    status_ = PlaybackStatus::playing;
    return {};
}

/// Adds the receipts from checkedNs_ to `untilNs` to the sums of the level, at most up to the nominal
/// duration. The world is incomplete as soon as an actuator of its layout missed a frame.
void StudyWorld::readReceipts(std::int64_t untilNs) {
    if (!model_.output().isPlaying()) status_ = PlaybackStatus::incomplete;
    if (status_ != PlaybackStatus::playing || untilNs <= checkedNs_) return;
    const std::int64_t nominalNs = std::llround(1e9 * seconds_), requestedNs = untilNs;
    const bool isMeasured = nominalNs == 0 || checkedNs_ < nominalNs;
    if (isMeasured && nominalNs > 0) untilNs = std::min(untilNs, nominalNs);
    auto sums = outputSums_;
    std::int64_t endNs = untilNs;
    for (std::size_t j = 0; j < sums.size(); ++j) {
        const Receipt receipt =
            model_.output().receiptFor(checkedNs_, untilNs, static_cast<int>(j), sessionNumber_);
        if (!receipt.hasEnded) return; // the last block has no receipt yet
        if (!receipt.isRunning) status_ = PlaybackStatus::incomplete;
        endNs = receipt.endNs; // the next span begins there, so that no frame counts twice
        if (!isMeasured) continue;
        sums[j].peak = std::max(sums[j].peak, receipt.peak);
        sums[j].squareSeconds +=
            receipt.meanSquare * static_cast<double>(receipt.frames) / model_.output().sampleRateHz();
    }
    outputSums_ = std::move(sums);
    checkedNs_ = std::max(endNs, untilNs); // a span with lost frames ends before untilNs
    readReceipts(requestedNs);
}

PlayedLevel StudyWorld::level() const {
    const double seconds = std::max(1e-3, seconds_ > 0.0 ? seconds_ : playedSeconds());
    PlayedLevel level;
    for (const OutputSums& output : outputSums_) {
        level.peakG = std::max(level.peakG, output.peak * output.fullScaleG);
        level.rmsG = std::max(level.rmsG, std::sqrt(output.squareSeconds / seconds) * output.fullScaleG);
    }
    return level;
}

void StudyWorld::sendStrips() {
    auto strips = model_.mix().strips;
    strips.resize(static_cast<std::size_t>(setup_.channels));
    for (Strip& strip : strips) strip.gainDb = 0.0, strip.isMuted = strip.isSolo = false;
    std::array<SentStrip, limits::maxActuators> sentStrips{};
    physvib::sendStrips(sentStrips, strips, [this](const RenderControl& control) {
        return session_->submit({control}).error.empty();
    });
}

void StudyWorld::stop() {
    if (!isMoving()) return;
    session_->world().setSlowness(0);
    // if the queue is full, the world continues, and the next update() calls stop() again
    if (const auto submission = session_->submit({RenderControl{.kind = Kind::stopAll}}))
        stoppedNs_ = submission.value;
}

std::string StudyWorld::applyInput(const Action& action) {
    return isMoving() ? session_->submit({action}).error : std::string{};
}

WorldFrame StudyWorld::update() {
    WorldFrame frame;
    if (!session_) return frame;
    for (PlayedEvent event; session_->played().pop(event);)
        journal_->onPlayed(event, session_->timeline().sampleRateHz());
    frame.sessionNs = session_->world().readPoses(frame.poses);
    frame.aheadNs = session_->timeline().outputLatencyFrames() * 1'000'000'000 /
                    std::max(1, model_.output().sampleRateHz());
    const std::int64_t nowNs = session_->status().sessionNs, outputNs = session_->timeline().nextOutputNs();
    if (outputNs >= checkedNs_ + receiptIntervalNs || !model_.output().isPlaying()) readReceipts(outputNs);
    if (model_.isSilent() && seconds_ > 0.0 && isMoving())
        status_ = PlaybackStatus::incomplete;                          // the trial will repeat the world
    if (status_ == PlaybackStatus::incomplete) return finish(), frame; // a stopped device plays no fade-out
    if (isMoving()) {
        session_->world().setSlowness(model_.isSilent() ? 0 : 1); // a world pauses while silent
        if (!model_.isSilent())
            playedNs_ =
                std::min(playedNs_ + nowNs - lastUpdateNs_, std::max<std::int64_t>(0, nowNs - frame.aheadNs));
        if (seconds_ > 0.0 && playedSeconds() >= seconds_) stop();
    } else if (outputNs >= stoppedNs_ + fadeNs) { // the latency may have grown
        readReceipts(stoppedNs_);
        if (status_ == PlaybackStatus::playing) status_ = PlaybackStatus::complete;
        finish();
    }
    lastUpdateNs_ = nowNs;
    return frame;
}

void StudyWorld::finish() {
    if (!session_) return;
    if (status_ == PlaybackStatus::playing) status_ = PlaybackStatus::none;
    model_.output().playInstead(nullptr);
    driver_.reset();
    session_->advance(); // simulates up to the time at which a later render would continue
    // Impacts of the last step are known after the next step, which is not made here. A render that ended at
    // the pause would include them.
    const std::int64_t endNs = stoppedNs_ < 0 ? session_->status().sessionNs : stoppedNs_ + fadeNs;
    if (journal_ && journal_->error().empty()) {
        for (PlayedEvent event; session_->played().pop(event);)
            journal_->onPlayed(event, session_->timeline().sampleRateHz());
        journal_->end(endNs);
        saveError_ = journal_->finish(SessionJournal::maxQuickBytes); // limited, as the window waits for it
    }
    journal_.reset();
    session_.reset();
}

StudyWorldPane::StudyWorldPane(MixerModel& model)
    : model_{model}
    , world_{model} {
    setTitle("World of the trial");
    view_.onFling = [this](const std::string& body, Vector screenMetres, Vector point) {
        if (isInteractive_)
            applyInput(
                ImpulseAction{body, {defaultDrag * screenMetres.x, defaultDrag * screenMetres.y}, point});
    };
    tilt_.onValueChange = [this] { applyInput(TiltAction{tilt_.angleRadians()}); };
    view_.setMargin(8);        // pixels; there are no badges of actuators here
    view_.showMaterials(true); // materials are visible, as participants form expectations by them
    addAndMakeVisible(view_);
    addChildComponent(tilt_);
}

void StudyWorldPane::applyInput(const Action& action) {
    if (const auto error = world_.applyInput(action); !error.empty() && onError) onError(error);
}

std::string StudyWorldPane::begin(PlayableWorld world, bool isInteractive,
                                  const std::filesystem::path& file) {
    preview(world.setup.scene);
    if (!view_.fits()) {
        const auto millimetres = [this](double metres) { return fixedNumber(1e3 * metres / worldScale_, 0); };
        const Scene& scene = world.setup.scene;
        return "display_scale: expected a larger window or display, as the world is " +
               millimetres(scene.fieldWidthMetres) + " x " + millimetres(scene.fieldHeightMetres) +
               " mm at 1:" + numberText(worldScale_);
    }
    if (auto error = world_.begin(std::move(world), isInteractive, file); !error.empty()) return error;
    isInteractive_ = isInteractive;
    tilt_.setVisible(isInteractive);
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
    if (auto frame = world_.update(); !frame.poses.empty()) view_.update(std::move(frame));
}

void StudyWorldPane::resized() {
    view_.setBounds(getLocalBounds().reduced(3));
    tilt_.setBounds(getLocalBounds().reduced(10).removeFromBottom(44).removeFromRight(44));
}

} // namespace physvib
