// SPDX-License-Identifier: GPL-3.0-or-later
// The mixer's state, the session that plays it, and its output device.
#include "Mixer/Model/MixerModel.h"
#include "Scene/Drawing/BodyEdits.h"
#include "Scene/SceneFile.h"
#include <limits>

namespace physvib {
namespace {

constexpr int stepsPerSecond = 100;
constexpr const char* deviceLabel = "device"; // as Rig names it
constexpr double newStripDb = -12.0;          // quiet, because people may be holding the actuators

SessionSetup setupOf(const Mix& mix) {
    SessionSetup setup;
    setup.scene = *mix.scene;
    setup.seed = mix.seed;
    setup.stepsPerSecond = stepsPerSecond;
    setup.channels = MixerModel::channels;
    setup.panner = mix.panner();
    setup.layout = mix.layout;
    setup.longestGapSeconds = threadGapSeconds(stepsPerSecond);
    setup.contactSound.emplace();
    setup.ears = 2;
    setup.marks = MarkedOnsets::all;
    return setup;
}

/// Strips of new actuators are no louder than the quietest that is heard.
void quietenNew(std::span<const Strip> before, std::span<Strip> strips) {
    double most = mostStripDb;
    for (const Strip& strip : before)
        if (strip.gainDb > leastStripDb) most = std::min(most, strip.gainDb);
    for (std::size_t j = before.size(); j < strips.size(); ++j)
        strips[j].gainDb = std::min(strips[j].gainDb, most);
}

RigSettings rigOf(const Mix& mix, const DeviceChoice& device) {
    return {.setup = setupOf(mix), .sinks = device.sinks, .awaitsSinks = false};
}

bool isSame(const PhantomPanner& a, const PhantomPanner& b) {
    return a.law() == b.law() && a.exponent() == b.exponent() &&
           (a.requestedLaw() == b.requestedLaw() || !hasParts(a.layout())) &&
           a.fieldWidthMetres() == b.fieldWidthMetres() && a.fieldHeightMetres() == b.fieldHeightMetres() &&
           isSame(a.layout(), b.layout());
}

} // namespace

/// What of the mixer state the session has received. Message thread.
class SentMix {
public:
    /// Initial state: the session was created with `panner` and default strips.
    explicit SentMix(const PhantomPanner& panner)
        : panner_{panner} {}

    /// Posts all differences. If the session's queue is full, the rest is posted by the next call.
    void send(Session& session, const Mix& mix) {
        using Kind = RenderControl::Kind;
        const auto post = [&session](Kind kind, const PhantomPanner* panner = nullptr) {
            return session.submit({RenderControl{0, kind, 0, 0.0f, panner}}).error.empty();
        };
        if (const auto panner = mix.panner(); !isSame(panner_, panner)) {
            // a channel may belong to another actuator now
            if (panner.channels() < panner_.channels() && !post(Kind::stopAll)) return;
            if (!post(Kind::panner, &panner)) return;
            panner_ = panner;
        }
        const auto felt = feltStrips(mix);
        for (std::size_t j = 0; j < follows_.size(); ++j)
            if (follows_[j]) strips_[j].gain = channelGain(felt[j]); // set by its lane
        sendStrips(strips_, felt, [&session](const RenderControl& control) {
            return session.submit({control}).error.empty();
        });
    }

    /// Sends changed lanes; the session itself then controls strips with a lane.
    void follow(Session& session, const Mix& mix) {
        std::vector<bool> follows(mix.strips.size());
        for (std::size_t j = 0; j < follows.size(); ++j) follows[j] = hasLane(mix, j);
        for (std::size_t j = 0; j < follows_.size(); ++j) // the gain at the end of its lane is unknown here
            if (follows_[j] && (j >= follows.size() || !follows[j]))
                strips_[j].gain = std::numeric_limits<float>::quiet_NaN();
        const bool any = std::ranges::find(follows, true) != follows.end(),
                   wereAny = std::ranges::find(follows_, true) != follows_.end();
        follows_ = std::move(follows);
        if (any || wereAny) session.submit({Lanes{any ? std::make_shared<const Mix>(mix) : nullptr}});
    }

private:
    PhantomPanner panner_;
    std::vector<bool> follows_; // by strip
    std::array<SentStrip, limits::maxEnchanters> strips_{};
};

Mix MixerModel::firstMix() {
    Mix mix;
    mix.scene = std::make_shared<const Scene>(*findBuiltInScene("shake-the-box"));
    mix.layout = presetLayout("phone4");
    mix.resizeStrips();
    return mix;
}

/// An undoable edit of the mixer state; repeated edits of one fader merge into one.
class MixerModel::MixEdit final : public juce::UndoableAction {
public:
    MixEdit(MixerHistory& history, Mix before, Mix after)
        : history_{history}
        , before_{std::move(before)}
        , after_{std::move(after)} {}
    // JUCE keeps no step of an action that fails at first, but forgets all steps if one fails later
    bool perform() override {
        const bool isDone = history_.model->apply(after_);
        return std::exchange(isRepeated_, true) || isDone;
    }
    bool undo() override { return history_.model->apply(before_), true; }
    int getSizeInUnits() override { return 1; }
    juce::UndoableAction* createCoalescedAction(juce::UndoableAction* next) override {
        const auto* other = dynamic_cast<MixEdit*>(next);
        if (other == nullptr) return nullptr;
        auto* both = new MixEdit{history_, before_, other->after_};
        both->isRepeated_ = true;
        return both;
    }

private:
    MixerHistory& history_;
    Mix before_, after_;
    bool isRepeated_ = false;
};

MixerModel::MixerModel(AudioDrivers drivers, const DeviceChoice& device, Mix mix, MixerStart start)
    : mix_{std::move(mix)}
    , rig_{rigOf(mix_, device), drivers}
    , device_{rig_, std::move(drivers), mix_, [this] { sendChangeMessage(); }}
    , recording_{session(), output(), mix_, [this] { sendChangeMessage(); }}
    , history_{start.history ? std::move(start.history) : std::make_shared<MixerHistory>()}
    , world_{session(), mix_, *history_, [this](bool isShown) { edited(isShown); },
             [this](const std::string& fault) { report(utf8(fault)); }}
    , lastSent_{std::make_unique<SentMix>(mix_.panner())}
    , strikes_{session(),
               output(),
               mix_,
               world_,
               [this] { edited(true); },
               [this](const Result<std::string>& note) { clipWasRead(note); }} {
    history_->model = this;
    const auto without = settleOutputs(mix_.strips);
    saved_.run = setupOf(mix_).run();
    saved_.panner = mix_.panner();
    saved_.layout = mix_.layout;
    maxEnchanters_ = mix_.count();
    signals_.tap().hear(mix_.count());
    exposure_.use(mix_.layout);
    session().sinks().attach(signals_.tap());
    const auto fault = rig_.connectSinks();
    setSilent(start.isSilent); // before anything can be felt
    session().world().setSlowness(start.isPaused ? 0 : 1);
    open(device);
    if (!fault.empty()) messages_.show({utf8(fault), false, {}, "sinks"});
    reportWithout(*this, without);
    lastSent_->follow(session(), mix_);
    lastSent_->send(session(), mix_);
    edits_ = 0;
    rig_.start();
}

MixerModel::~MixerModel() {
    output().stop();
    recording_.keep(); // first, since closing devices may hang
    inputs_.close();
    rig_.close();
}

void MixerModel::edit(const juce::String& name, const Mix& next, bool continuesEdit, bool returns) {
    auto& undo = history_->undo;
    if (!continuesEdit || undo.getCurrentTransactionName() != name) undo.beginNewTransaction(name);
    if (const Scene& drawn = world_.drawing().drawn();
        next.scene != mix_.scene && (returns || drawn != *mix_.scene)) {
        auto left = std::make_shared<const Scene>(returns ? sceneNow(drawn, world_.posesNow()) : drawn);
        const auto before = std::exchange(mix_.scene, std::move(left));
        history_->drawn.emplace_back(before, mix_.scene);
    }
    Mix settled = next;
    quietenNew(mix_.strips, settled.strips);
    const auto withoutEar = placeNew(device_.choice(), settled.strips, mix_.strips.size());
    const auto without = settleOutputs(settled.strips);
    undo.perform(new MixEdit{*history_, mix_, std::move(settled)});
    reportWithout(*this, without);
    reportNoEar(*this, withoutEar);
}

bool MixerModel::apply(const Mix& next) {
    const Mix before = std::exchange(mix_, next);
    if (history_->isSame(mix_.scene, before.scene)) mix_.scene = before.scene; // with what is drawn there
    bool isRefused = false;
    ++edits_;
    maxEnchanters_ = std::max(maxEnchanters_, mix_.count());
    if (mix_.scene != before.scene || mix_.seed != before.seed)
        reportFault(world_.begin(mix_.scene == before.scene));
    signals_.tap().hear(mix_.count());
    exposure_.use(mix_.layout);
    lastSent_->follow(session(), mix_);
    lastSent_->send(session(), mix_);
    if (!mix_.strips.empty() &&
        !std::ranges::equal(before.strips, mix_.strips, {}, &Strip::output, &Strip::output))
        if (const auto error = device_.assign(); !error.empty()) {
            showPlayedOutputs(output().channelMap(), mix_.strips); // refused: neither shown nor saved
            report(utf8(error));
            isRefused = isSame(mix_, before);
        }
    if (std::ranges::none_of(mix_.strips, [](const Strip& strip) { return strip.output < 0; }))
        for (const char* label : {noOutputLabel, noEarLabel}) messages_.withdraw(label);
    output().setLevel(masterGain(mix_));
    if (isRefused) --edits_;
    sendChangeMessage();
    return !isRefused;
}

bool MixerModel::attach(double shareX, double shareY) {
    if (mix_.count() >= limits::maxEnchanters) return false;
    change("Attach an actuator", [&](Mix& mix) {
        auto& layout = mix.layout;
        const auto label = [](int n) {
            return describeLayout("", EnchanterLayout{1, 1, n + 1, {}}).enchanters.back().label;
        };
        int n = 0;
        while (std::ranges::any_of(layout.enchanters, [&](const auto& e) { return e.label == label(n); }))
            ++n;
        layout.name = "own";
        layout.enchanters.push_back(
            {label(n), layout.enchanters.back().actuator, layout.enchanters.back().fullScaleG});
        auto& geometry = layout.geometry;
        const double x = shareX * geometry.extentWidthMetres, y = shareY * geometry.extentHeightMetres;
        // in space: as deep as, and on the part of, the one that is nearest in the view
        const auto others = std::span{geometry.places}.first(static_cast<std::size_t>(geometry.count));
        const auto nearest = *std::ranges::min_element(
            others, {}, [=](const ActuatorPlace& at) { return std::hypot(at.xMetres - x, at.yMetres - y); });
        geometry.places[others.size()] = {x, y, nearest.zMetres, nearest.part};
        ++geometry.count;
        mix.strips.push_back(nextStrip(mix.strips));
        mix.strips.back().gainDb = newStripDb;
    });
    return true;
}

void MixerModel::detach(int enchanter) {
    if (mix_.count() < 2) return;
    change("Detach " + labelOf(mix_, enchanter), [&](Mix& mix) {
        auto& layout = mix.layout;
        auto& places = layout.geometry.places;
        std::copy(places.begin() + enchanter + 1, places.begin() + layout.geometry.count,
                  places.begin() + enchanter);
        --layout.geometry.count;
        layout.name = "own";
        layout.enchanters.erase(layout.enchanters.begin() + enchanter);
        mix.strips.erase(mix.strips.begin() + enchanter);
    });
}

const SavedSession& MixerModel::saved() {
    saved_.channels = maxEnchanters_;
    saved_.lengthNs = session().status().sessionNs;
    session().readLog(saved_.log);
    saved_.mix = mix_;
    return saved_;
}

std::string MixerModel::open(const DeviceChoice& choice) {
    const int slowness = session().world().slowness();
    const DeviceChoice before = device_.choice();
    auto error = device_.open(choice);
    if (!choice.isHeadphones) {
        messages_.withdraw(noEarLabel);
        if (before.isHeadphones) leaveHeadphones(*this, before);
    }
    session().world().setSlowness(slowness); // the first device resets it
    if (!error.empty())
        messages_.show({utf8(error), false, {}, deviceLabel});
    else
        messages_.withdraw(deviceLabel);
    signals_.setRate(output().sampleRateHz());
    sendChangeMessage(); // it may have other outputs, or name them otherwise
    return error;
}

std::string MixerModel::monitorInstead(std::vector<int> outputs, double db) {
    if (!std::ranges::all_of(outputs, [this](int output) {
            return output >= device_.outputs() || device_.listening().isFree(output);
        }))
        change("Listen instead of feeling", [&](Mix& mix) {
            for (Strip& strip : mix.strips)
                if (std::ranges::find(outputs, strip.output) != outputs.end()) strip.output = -1;
        });
    return device_.listening().monitor(std::move(outputs), db);
}

void MixerModel::watchOutput() {
    lastSent_->send(session(), mix_); // retries controls for which the queue was full
    if (isSilent_ != output().isSilent()) showSilence();
    const int slowness = session().world().slowness();
    device_.maintain();
    session().world().setSlowness(slowness);
    // each source of errors has a message of its own
    const auto before = std::exchange(troubles_, rig_.troubles());
    for (const RigTrouble& old : before)
        if (std::ranges::find(troubles_, old.source, &RigTrouble::source) == troubles_.end())
            messages_.withdraw(utf8(old.source));
    for (const RigTrouble& trouble : troubles_)
        if (std::ranges::find(before, trouble) == before.end())
            messages_.show({utf8(trouble.words), false, {}, utf8(trouble.source)});
}

void MixerModel::restart(std::uint32_t seed) {
    if (seed != mix_.seed) return change("Seed", [seed](Mix& mix) { mix.seed = seed; });
    reportFault(world_.begin(true));
    edited();
}

void MixerModel::setSlowness(int slowness) {
    session().world().setSlowness(slowness);
    sendChangeMessage();
}

void MixerModel::edited(bool isShown) {
    ++edits_;
    if (isShown) sendChangeMessage(); // lets idle views repaint
}

void MixerModel::clipWasRead(const Result<std::string>& note) {
    if (!note) return report(utf8(note.error));
    const auto mute = device_.withoutClips();
    if (!note.value.empty()) announce(utf8(note.value));
    if (mute.isNotEmpty())
        messages_.add({"The " + mute + " plays no clips: it is felt on the device alone", true});
    edited();
}

bool MixerModel::reportFault(const std::string& fault) {
    if (!fault.empty()) report(utf8(fault));
    return !fault.empty();
}

void MixerModel::setSilent(bool silent) {
    output().setSilent(silent);
    showSilence();
}

bool MixerModel::isOnlySeen() const {
    return device_.isNone() && session().sinks().states().empty() && inputs_.choice().receiver.empty();
}

void MixerModel::showSilence() {
    isSilent_ = output().isSilent();
    sendChangeMessage();
}

void MixerModel::setDisplayWidth(double metres) {
    displayWidthMetres_ = metres;
    sendChangeMessage();
}

MixerMoment MixerModel::look() {
    const WorldRunner& world = session().world();
    signals_.follow(world.take(),
                    1e-9 * static_cast<double>(world.sceneNs()) - device_.outputLatencySeconds(),
                    world.slowness());
    MixerSignals::Played played{};
    for (std::size_t j = 0; j < mix_.strips.size(); ++j) played[j] = !isSilent_ && device_.isPlayed(j);
    const float loudest = signals_.read(now_, mix_.count(), played);
    now_.session = session().status();
    now_.device = output().status();
    exposure_.update();
    now_.dailyExposure = exposure_.daily();
    collectPlayed();
    now_.hits.clear();
    now_.hits.swap(hits_);
    recording_.look(now_.device);
    lanes_.look();
    now_.meters.limiterGain = now_.session.render.limiterGain;
    now_.meters.guardGain = now_.device.guardGain;
    now_.meters.enchanters = mix_.count();
    for (std::size_t j = 0; j < static_cast<std::size_t>(mix_.count()); ++j)
        now_.meters.isConnected[j] = mix_.strips[j].output >= 0;
    now_.masterPeak = loudest * masterGain(mix_);
    now_.sessionNs = session().world().readPoses(now_.poses);
    now_.aheadNs = static_cast<std::int64_t>(1e9 * device_.outputLatencySeconds());
    watchOutput();
    if (const auto words = world_.tooMuch(now_.session.sessionNs, now_.sessionNs, now_.poses);
        words.isNotEmpty())
        report(words);
    script_.look();
    if (inputs_.haveCome()) ++edits_; // events from messages are part of the saved session
    return now_;
}

void MixerModel::collectPlayed() {
    rig_.takePlayed([this](const PlayedEvent& played) {
        hits_.push_back(played.event);
        recent_.add(played.event);
        recording_.add(played);
    });
}

} // namespace physvib
