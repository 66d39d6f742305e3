// SPDX-License-Identifier: GPL-3.0-or-later
// The mix, the session that plays it, and the output.
#include "Mixer/Desk/Desk.h"
#include "Files/SceneCatalogue.h"
#include "Mixer/Desk/DeskWords.h"
#include <algorithm>
#include <cmath>

namespace physvib {
namespace {

constexpr int stepsPerSecond = 100;
constexpr double maintainMs = 1000.0;
constexpr double newStripDb = -12.0; // hands are attached

Mix shakeTheBox() {
    Mix mix;
    mix.scene = std::make_shared<const Scene>(*findBuiltInScene("shake-the-box"));
    EnchanterLayout layout;
    layoutPreset("phone4", layout);
    mix.layout = describeLayout("phone4", layout);
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
    setup.longestGapSeconds = Desk::gapSeconds;
    setup.contactSound.emplace();
    setup.ears = 2;
    setup.marks = MarkedOnsets::all;
    return setup;
}

} // namespace

Mix Desk::firstMix() {
    return shakeTheBox();
}

juce::String titleOf(const std::string& name) {
    const auto words = juce::String::fromUTF8(name.c_str()).replaceCharacter('-', ' ');
    return words.substring(0, 1).toUpperCase() + words.substring(1);
}

/// One thing to undo; edits of a held fader grow into one.
class Desk::MixEdit final : public juce::UndoableAction {
public:
    MixEdit(Desk& desk, Mix before, Mix after)
        : desk_{desk}
        , before_{std::move(before)}
        , after_{std::move(after)} {}
    bool perform() override { return desk_.apply(after_), true; }
    bool undo() override { return desk_.apply(before_), true; }
    int getSizeInUnits() override { return 1; }
    juce::UndoableAction* createCoalescedAction(juce::UndoableAction* next) override {
        const auto* other = dynamic_cast<MixEdit*>(next);
        return other != nullptr ? new MixEdit{desk_, before_, other->after_} : nullptr;
    }

private:
    Desk& desk_;
    Mix before_, after_;
};

Desk::Desk(AudioDeviceTypes types, const DeviceChoice& device, Mix mix)
    : types_{std::move(types)}
    , mix_{std::move(mix)}
    , session_{setupOf(mix_)}
    , output_{session_, types_}
    , recording_{session_, output_, mix_, [this] { sendChangeMessage(); }}
    , undo_{1000, 30}
    , sceneNow_{*mix_.scene}
    , told_{mix_.panner()}
    , clips_{session_, output_, [this](const Result<std::string>& note) { takeFelt(note); }} {
    saved_.run = setupOf(mix_).run();
    saved_.panner = mix_.panner();
    mostEnchanters_ = mix_.count();
    signals_.tap().hear(mix_.count());
    exposure_.use(mix_.layout);
    session_.sinks().attach(signals_.tap());
    if (!device.board.empty()) {
        board_ = std::make_unique<DeskBoard>(device.board, mix_.panner());
        session_.sinks().attach(board_->sink());
    }
    open(device);
    told_.tell(session_, mix_);
    edits_ = 0;
    session_.sinks().follow(&output_);
    driver_ = std::make_unique<ThreadDriver>(session_, stepsPerSecond);
}

Desk::~Desk() {
    output_.stop();
    recording_.keep(); // before what may hang
    osc_.reset();
    driver_.reset();
    session_.sinks().follow(nullptr);
    output_.close();
}

void Desk::edit(const juce::String& name, const Mix& next, bool goesOn) {
    if (!goesOn || undo_.getCurrentTransactionName() != name) undo_.beginNewTransaction(name);
    undo_.perform(new MixEdit{*this, mix_, next});
}

void Desk::apply(const Mix& next) {
    const Mix before = std::exchange(mix_, next);
    ++edits_;
    mostEnchanters_ = std::max(mostEnchanters_, mix_.count());
    if (mix_.scene != before.scene || mix_.seed != before.seed) takeScene(mix_.scene == before.scene);
    signals_.tap().hear(mix_.count());
    exposure_.use(mix_.layout);
    told_.tell(session_, mix_);
    if (outputMap() != std::vector<int>{} &&
        (before.count() != mix_.count() ||
         !std::ranges::equal(before.strips, mix_.strips, {}, &Strip::output, &Strip::output))) {
        output_.hear(heard_ = ofStudy_.value_or(
                         ListeningSettings{})); // hands first: an enchanter may come where somebody listens
        if (const auto error = output_.assign(outputMap(), mix_.count()); !error.empty()) report(utf8(error));
        hearWanted();
    }
    output_.setLevel(masterGain(mix_));
    sendChangeMessage();
}

std::vector<int> Desk::outputMap() const {
    std::vector<int> map;
    for (const Strip& strip : mix_.strips) map.push_back(strip.output);
    return map;
}

bool Desk::attach(double shareX, double shareY) {
    if (mix_.count() >= limits::maxEnchanters) return false;
    change("Attach an enchanter", [&](Mix& mix) {
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
        layout.geometry.places[static_cast<std::size_t>(layout.geometry.count++)] = {
            shareX * layout.geometry.extentWidthMetres, shareY * layout.geometry.extentHeightMetres};
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
    saved_.lengthNs = session_.status().sessionNs;
    session_.readLog(saved_.log);
    saved_.mix = mix_;
    return saved_;
}

std::string Desk::open(const DeviceChoice& device) {
    AudioOutputSettings settings{device.name,
                                 outputMap(),
                                 device.sampleRateHz,
                                 device.blockFrames,
                                 masterGain(mix_),
                                 mix_.count(),
                                 true,
                                 heard_ = ofStudy_.value_or(ListeningSettings{})};
    const auto error = output_.open(settings);
    device_ = device;
    hearWanted();
    report(outputTrouble_ = deviceTrouble_ = utf8(error));
    signals_.setRate(output_.sampleRateHz());
    return error;
}

bool Desk::isFree(int output) const {
    return output >= 0 && output < outputs() &&
           std::ranges::find(mix_.strips, output, &Strip::output) == mix_.strips.end();
}

// What is only heard never keeps a device from being felt: where it cannot be, it is not asked for.
ListeningSettings Desk::wantedListening() const {
    ListeningSettings wanted = ofStudy_.value_or(ListeningSettings{});
    if (!ofStudy_ && std::ranges::all_of(device_.monitor, [this](int output) { return isFree(output); }))
        wanted.contacts = device_.monitor;
    wanted.contactDb = device_.monitorDb;
    const auto has = [&](const std::vector<int>& those) {
        return std::ranges::find(those, device_.marker) != those.end();
    };
    if (isFree(device_.marker) && !has(wanted.noise) && !has(wanted.contacts))
        wanted.marks = {device_.marker};
    return wanted;
}

std::string Desk::hearWanted() {
    const auto wanted = wantedListening();
    if (wanted == heard_) return {};
    auto error = output_.hear(wanted);
    if (error.empty()) heard_ = wanted;
    return error;
}

std::string Desk::hear(const ListeningSettings& ofStudy) {
    const auto before = std::exchange(ofStudy_, ofStudy);
    auto error = hearWanted();
    if (!error.empty()) ofStudy_ = before;
    return error;
}

void Desk::endStudy() {
    ofStudy_.reset();
    hearWanted();
}

std::string Desk::listen(const ListeningSettings& wanted, const DeviceChoice& choice) {
    if (auto error = output_.hear(wanted); !error.empty()) return error;
    heard_ = wanted;
    device_ = choice;
    sendChangeMessage();
    return {};
}

std::string Desk::monitor(std::vector<int> outputs, double db) {
    auto wanted = heard_;
    auto choice = device_;
    wanted.contacts = choice.monitor = std::move(outputs);
    wanted.contactDb = choice.monitorDb = db;
    return listen(wanted, choice);
}

std::string Desk::mark(int output) {
    auto wanted = heard_;
    auto choice = device_;
    choice.marker = output;
    wanted.marks = output < 0 ? std::vector<int>{} : std::vector{output};
    return listen(wanted, choice);
}

std::string Desk::monitorInstead(std::vector<int> outputs, double db) {
    if (!std::ranges::all_of(outputs,
                             [this](int output) { return output >= this->outputs() || isFree(output); }))
        change("Listen instead of feeling", [&](Mix& mix) {
            for (Strip& strip : mix.strips)
                if (std::ranges::find(outputs, strip.output) != outputs.end()) strip.output = -1;
        });
    return monitor(std::move(outputs), db);
}

void Desk::watchOutput() {
    told_.tell(session_, mix_); // what found no room before
    if (isSilent_ != output_.isSilent()) showSilence();
    if (const double now = nowMs(); now - maintainedAtMs_ > maintainMs) {
        maintainedAtMs_ = now;
        hearWanted(); // the device may have gone, or may be back
        deviceTrouble_ = utf8(output_.maintain());
    }
    const auto board = board_ ? board_->trouble() : juce::String{},
               both = deviceTrouble_.isEmpty() || board.isEmpty() ? deviceTrouble_ + board
                                                                  : deviceTrouble_ + "; " + board;
    if (both != outputTrouble_) report(outputTrouble_ = both);
}

void Desk::setSilent(bool silent) {
    output_.setSilent(silent);
    showSilence();
}

void Desk::showSilence() {
    isSilent_ = output_.isSilent();
    sendChangeMessage();
}

void Desk::setDisplayWidth(double metres) {
    displayWidthMetres_ = metres;
    sendChangeMessage();
}

double Desk::playOutSeconds() const noexcept {
    return output_.sampleRateHz() > 0 ? static_cast<double>(session_.playOutFrames()) / output_.sampleRateHz()
                                      : 0.0;
}

void Desk::report(const juce::String& trouble) {
    if (trouble == trouble_ && !isNews_) return;
    trouble_ = trouble;
    isNews_ = false;
    sendChangeMessage();
}

void Desk::tell(const juce::String& news) {
    trouble_ = news;
    isNews_ = true;
    sendChangeMessage();
}

} // namespace physvib
