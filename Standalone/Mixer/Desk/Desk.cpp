// SPDX-License-Identifier: GPL-3.0-or-later
// The mixer's state, the session that plays it, and its output device.
#include "Mixer/Desk/Desk.h"
#include "Mixer/Desk/DeskRouting.h"
#include "Mixer/Desk/DeskWords.h"
#include "Scene/SceneCatalogue.h"
#include <algorithm>
#include <cmath>

namespace physvib {
namespace {

constexpr int stepsPerSecond = 100;
constexpr const char* deviceLabel = "device"; // as Rig names it
constexpr double newStripDb = -12.0;          // quiet, because people may be holding the actuators

Mix shakeTheBox() {
    Mix mix;
    mix.scene = std::make_shared<const Scene>(*findBuiltInScene("shake-the-box"));
    mix.layout = presetLayout("phone4");
    mix.resizeStrips();
    return mix;
}

SessionSetup setupOf(const Mix& mix) {
    SessionSetup setup;
    setup.scene = *mix.scene;
    setup.seed = mix.seed;
    setup.stepsPerSecond = stepsPerSecond;
    setup.channels = Desk::channels;
    setup.panner = mix.panner();
    setup.layout = mix.layout;
    setup.longestGapSeconds = Desk::gapSeconds;
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

} // namespace

Mix Desk::firstMix() { return shakeTheBox(); }

/// An undoable edit of the mixer state; repeated edits of one fader merge into one.
class Desk::MixEdit final : public juce::UndoableAction {
public:
    MixEdit(Desk& desk, Mix before, Mix after)
        : desk_{desk}
        , before_{std::move(before)}
        , after_{std::move(after)} {}
    // JUCE keeps no step of an action that fails at first, but forgets all steps if one fails later
    bool perform() override {
        const bool isDone = desk_.apply(after_);
        return std::exchange(isRepeated_, true) || isDone;
    }
    bool undo() override { return desk_.apply(before_), true; }
    int getSizeInUnits() override { return 1; }
    juce::UndoableAction* createCoalescedAction(juce::UndoableAction* next) override {
        const auto* other = dynamic_cast<MixEdit*>(next);
        if (other == nullptr) return nullptr;
        auto* both = new MixEdit{desk_, before_, other->after_};
        both->isRepeated_ = true;
        return both;
    }

private:
    Desk& desk_;
    Mix before_, after_;
    bool isRepeated_ = false;
};

Desk::Desk(AudioDrivers drivers, const DeviceChoice& device, Mix mix, DeskStart start)
    : mix_{std::move(mix)}
    , rig_{rigOf(mix_, device), drivers}
    , device_{rig_, std::move(drivers), mix_, [this] { sendChangeMessage(); }}
    , recording_{session(), output(), mix_, [this] { sendChangeMessage(); }}
    , undo_{1000, 30}
    , world_{session(), mix_, undo_, [this](bool isShown) { edited(isShown); }}
    , told_{mix_.panner()}
    , strikes_{session(),
               output(),
               mix_,
               world_,
               [this] { edited(true); },
               [this](const Result<std::string>& note) { takeFelt(note); }} {
    const auto without = settleOutputs(mix_.strips);
    saved_.run = setupOf(mix_).run();
    saved_.panner = mix_.panner();
    saved_.layout = mix_.layout;
    mostEnchanters_ = mix_.count();
    signals_.tap().hear(mix_.count());
    exposure_.use(mix_.layout);
    session().sinks().attach(signals_.tap());
    const auto fault = rig_.connectSinks();
    setSilent(start.isSilent); // before anything can be felt
    session().world().setSlowness(start.isPaused ? 0 : 1);
    open(device);
    if (!fault.empty()) report(utf8(fault));
    reportWithout(*this, without);
    told_.follow(session(), mix_);
    told_.tell(session(), mix_);
    edits_ = 0;
    rig_.start();
}

Desk::~Desk() {
    output().stop();
    recording_.keep(); // first, since closing devices may hang
    inputs_.close();
    rig_.close();
}

void Desk::edit(const juce::String& name, const Mix& next, bool goesOn) {
    if (!goesOn || undo_.getCurrentTransactionName() != name) undo_.beginNewTransaction(name);
    // undo restores the scene as it was drawn
    if (const Scene& drawn = world_.drawing().drawn(); next.scene != mix_.scene && drawn != *mix_.scene)
        mix_.scene = std::make_shared<const Scene>(drawn);
    Mix settled = next;
    quietenNew(mix_.strips, settled.strips);
    const auto withoutEar = placeNew(device_.choice(), settled.strips, mix_.strips.size());
    const auto without = settleOutputs(settled.strips);
    undo_.perform(new MixEdit{*this, mix_, std::move(settled)});
    reportWithout(*this, without);
    reportNoEar(*this, withoutEar);
}

bool Desk::apply(const Mix& next) {
    const Mix before = std::exchange(mix_, next);
    bool isRefused = false;
    ++edits_;
    mostEnchanters_ = std::max(mostEnchanters_, mix_.count());
    if (mix_.scene != before.scene || mix_.seed != before.seed) beginWorld(mix_.scene == before.scene);
    signals_.tap().hear(mix_.count());
    exposure_.use(mix_.layout);
    told_.follow(session(), mix_);
    told_.tell(session(), mix_);
    if (!mix_.strips.empty() &&
        !std::ranges::equal(before.strips, mix_.strips, {}, &Strip::output, &Strip::output))
        if (const auto error = device_.assign(); !error.empty()) {
            takeOutputs(output().channelMap(), mix_.strips); // a refused output is neither shown nor saved
            report(utf8(error));
            isRefused = isSame(mix_, before);
        }
    output().setLevel(masterGain(mix_));
    if (isRefused) --edits_;
    sendChangeMessage();
    return !isRefused;
}

bool Desk::attach(double shareX, double shareY) {
    if (mix_.count() >= limits::maxEnchanters) return false;
    change("Attach an actuator", [&](Mix& mix) {
        auto& layout = mix.layout;
        const auto label = [&layout](int n) {
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

void Desk::detach(int enchanter) {
    if (mix_.count() < 2) return;
    change("Detach " + juce::String::fromUTF8(
                           mix_.layout.enchanters[static_cast<std::size_t>(enchanter)].label.c_str()),
           [&](Mix& mix) {
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

const SavedSession& Desk::saved() {
    saved_.channels = mostEnchanters_;
    saved_.lengthNs = session().status().sessionNs;
    session().readLog(saved_.log);
    saved_.mix = mix_;
    return saved_;
}

std::string Desk::open(const DeviceChoice& choice) {
    const int slowness = session().world().slowness();
    auto error = device_.open(choice);
    session().world().setSlowness(slowness); // the first device resets it
    if (!error.empty())
        messages_.show({utf8(error), false, {}, deviceLabel});
    else
        messages_.withdraw(deviceLabel);
    signals_.setRate(output().sampleRateHz());
    sendChangeMessage(); // it may have other outputs, or name them otherwise
    return error;
}

std::string Desk::monitorInstead(std::vector<int> outputs, double db) {
    if (!std::ranges::all_of(outputs, [this](int output) {
            return output >= device_.outputs() || device_.listening().isFree(output);
        }))
        change("Listen instead of feeling", [&](Mix& mix) {
            for (Strip& strip : mix.strips)
                if (std::ranges::find(outputs, strip.output) != outputs.end()) strip.output = -1;
        });
    return device_.listening().monitor(std::move(outputs), db);
}

void Desk::watchOutput() {
    told_.tell(session(), mix_); // retries controls for which the queue was full
    if (isSilent_ != output().isSilent()) showSilence();
    const int slowness = session().world().slowness();
    device_.maintain();
    session().world().setSlowness(slowness);
    // each source of errors has a message of its own
    const auto before = std::exchange(troubles_, device_.troubles());
    for (const RigTrouble& old : before)
        if (std::ranges::find(troubles_, old.source, &RigTrouble::source) == troubles_.end())
            messages_.withdraw(utf8(old.source));
    for (const RigTrouble& trouble : troubles_)
        if (std::ranges::find(before, trouble) == before.end())
            messages_.show({utf8(trouble.words), false, {}, utf8(trouble.source)});
}

void Desk::restart(std::uint32_t seed) {
    if (seed != mix_.seed) return change("Seed", [seed](Mix& mix) { mix.seed = seed; });
    beginWorld(true);
    edited();
}

void Desk::beginWorld(bool isSameScene) {
    if (const auto fault = world_.begin(isSameScene); !fault.empty()) report(utf8(fault));
}

void Desk::setSlowness(int slowness) {
    session().world().setSlowness(slowness);
    sendChangeMessage();
}

void Desk::edited(bool isShown) {
    ++edits_;
    if (isShown) sendChangeMessage(); // lets idle views repaint
}

void Desk::takeFelt(const Result<std::string>& note) {
    if (!note) return report(utf8(note.error));
    const auto mute = device_.withoutClips();
    if (!note.value.empty()) tell(utf8(note.value));
    if (mute.isNotEmpty())
        messages_.add({"The " + mute + " plays no clips: it is felt on the device alone", true});
    edited();
}

void Desk::setSilent(bool silent) {
    output().setSilent(silent);
    showSilence();
}

void Desk::showSilence() {
    isSilent_ = output().isSilent();
    sendChangeMessage();
}

void Desk::setDisplayWidth(double metres) {
    displayWidthMetres_ = metres;
    sendChangeMessage();
}

} // namespace physvib
