// SPDX-License-Identifier: GPL-3.0-or-later
// From the mix to the session's controls, and from what was played to what is shown.
#include "Mixer/Desk.h"
#include "Files/SceneCatalogue.h"
#include <algorithm>
#include <cmath>

namespace physvib {

namespace {

constexpr int stepsPerSecond = 100;
constexpr double gapSeconds = 0.005; // the driver's thread shares the machine with painting
constexpr double holdMs = 1500.0, maintainMs = 1000.0;
constexpr double newStripDb = -12.0; // hands are attached

double nowMs() { return juce::Time::getMillisecondCounterHiRes(); }

Mix firstMix() {
    Mix mix;
    mix.scene = std::make_shared<const Scene>(*findBuiltInScene("shake-the-box"));
    EnchanterLayout layout;
    layoutPreset("phone4", layout);
    mix.layout = describeLayout("phone4", layout);
    for (int j = 0; j < layout.count; ++j) {
        mix.strips.emplace_back();
        mix.strips.back().output = j;
    }
    return mix;
}

SessionSetup setupOf(const Mix& mix) {
    SessionSetup setup;
    setup.scene = *mix.scene;
    setup.seed = mix.seed;
    setup.stepsPerSecond = stepsPerSecond;
    setup.channels = Desk::channels;
    setup.panner = mix.panner();
    setup.longestGapSeconds = gapSeconds;
    return setup;
}

float levelOf(const Mix& mix) { return mix.levelDb <= leastStripDb ? 0.0f : static_cast<float>(std::pow(10.0, mix.levelDb / 20.0)); }

bool isSame(const PhantomPanner& a, const PhantomPanner& b) {
    const auto places = [](const PhantomPanner& p) { return std::span{p.layout().places}.first(static_cast<std::size_t>(p.channels())); };
    const auto equal = [](const EnchanterPlace& p, const EnchanterPlace& q) { return p.xMetres == q.xMetres && p.yMetres == q.yMetres; };
    return a.channels() == b.channels() && a.law() == b.law() && a.exponent() == b.exponent() && a.fieldWidthMetres() == b.fieldWidthMetres() &&
           a.fieldHeightMetres() == b.fieldHeightMetres() && a.layout().extentWidthMetres == b.layout().extentWidthMetres &&
           a.layout().extentHeightMetres == b.layout().extentHeightMetres && std::ranges::equal(places(a), places(b), equal);
}

int firstFreeOutput(const Mix& mix) {
    for (int k = 0;; ++k)
        if (std::ranges::none_of(mix.strips, [k](const Strip& s) { return s.output == k; })) return k;
}

} // namespace

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

Desk::Desk(AudioDeviceTypes types, const DeviceChoice& device)
    : types_{std::move(types)}
    , mix_{firstMix()}
    , session_{setupOf(mix_)}
    , tap_{channels, 1 << 14}
    , output_{session_, types_}
    , undo_{1000, 30}
    , sceneNow_{*mix_.scene} {
    tap_.hear(mix_.count());
    output_.listen(&tap_);
    open(device);
    postDifferences(mix_, true);
    driver_ = std::make_unique<ThreadDriver>(session_, stepsPerSecond);
}

Desk::~Desk() {
    driver_.reset();
    output_.close();
}

void Desk::edit(const juce::String& name, const Mix& next, bool goesOn) {
    if (!goesOn || undo_.getCurrentTransactionName() != name) undo_.beginNewTransaction(name);
    undo_.perform(new MixEdit{*this, mix_, next});
}

void Desk::apply(const Mix& next) {
    const Mix before = std::exchange(mix_, next);
    if (mix_.scene != before.scene || mix_.seed != before.seed) {
        if (const auto fault = session_.setState({mix_.scene, mix_.seed}); !fault.empty()) report(juce::String::fromUTF8(fault.c_str()));
        sceneNow_ = *mix_.scene;
    }
    tap_.hear(mix_.count());
    postDifferences(before, false);
    if (outputMap() != std::vector<int>{} && (before.count() != mix_.count() || !std::ranges::equal(before.strips, mix_.strips, {}, &Strip::output, &Strip::output)))
        if (const auto error = output_.assign(outputMap(), mix_.count()); !error.empty()) report(juce::String::fromUTF8(error.c_str()));
    output_.setLevel(levelOf(mix_));
    sendChangeMessage();
}

// What the session plays by: as little as has changed.
void Desk::postDifferences(const Mix& before, bool all) {
    using Kind = RenderControl::Kind;
    if (!all && !isSame(before.panner(), mix_.panner())) {
        if (mix_.count() < before.count()) session_.post({0, Kind::stopAll, 0, 0.0f, {}}); // a channel may be another enchanter's now
        session_.post({0, Kind::panner, 0, 0.0f, mix_.panner()});
    }
    for (int j = 0; j < mix_.count(); ++j) {
        const auto i = static_cast<std::size_t>(j);
        const Strip strip = mix_.strips[i], old = !all && i < before.strips.size() ? before.strips[i] : Strip{};
        const bool isSilent = mix_.isSilent(j), wasSilent = !all && i < before.strips.size() && before.isSilent(j);
        if (channelGain(strip) != channelGain(old)) session_.post({0, Kind::gain, j, channelGain(strip), {}});
        if (isSilent != wasSilent) session_.post({0, Kind::mute, j, isSilent ? 1.0f : 0.0f, {}});
    }
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
        const auto label = [&layout](int n) { return describeLayout("", EnchanterLayout{1, 1, n + 1, {}}).enchanters.back().label; };
        int n = 0;
        while (std::ranges::any_of(layout.enchanters, [&](const auto& e) { return e.label == label(n); })) ++n;
        layout.name = "own";
        layout.enchanters.push_back({label(n), layout.enchanters.back().actuator, layout.enchanters.back().fullScaleG});
        layout.geometry.places[static_cast<std::size_t>(layout.geometry.count++)] = {shareX * layout.geometry.extentWidthMetres, shareY * layout.geometry.extentHeightMetres};
        Strip strip;
        strip.gainDb = newStripDb;
        strip.output = firstFreeOutput(mix);
        mix.strips.push_back(strip);
    });
    return true;
}

void Desk::detach(int enchanter) {
    if (mix_.count() < 2) return;
    change("Detach " + juce::String::fromUTF8(mix_.layout.enchanters[static_cast<std::size_t>(enchanter)].label.c_str()), [&](Mix& mix) {
        auto& layout = mix.layout;
        auto& places = layout.geometry.places;
        std::copy(places.begin() + enchanter + 1, places.begin() + layout.geometry.count, places.begin() + enchanter);
        --layout.geometry.count;
        layout.name = "own";
        layout.enchanters.erase(layout.enchanters.begin() + enchanter);
        mix.strips.erase(mix.strips.begin() + enchanter);
    });
}

std::string Desk::act(const Action& action) {
    const auto fault = session_.act(action);
    if (!fault.empty()) return fault;
    if (std::holds_alternative<SpawnAction>(action)) {
        sceneNow_.inputs.push_back({0.0, action});
        sendChangeMessage();
    }
    return {};
}

void Desk::restart(std::uint32_t seed) {
    if (seed != mix_.seed) return change("Seed", [seed](Mix& mix) { mix.seed = seed; });
    sceneNow_ = *mix_.scene;
    session_.restart();
    sendChangeMessage();
}

void Desk::setSlowness(int slowness) {
    session_.setSlowness(slowness);
    sendChangeMessage();
}

void Desk::strike(int enchanter, std::vector<CollisionEvent> strikes) {
    const auto& layout = mix_.layout.geometry;
    const auto& place = layout.places[static_cast<std::size_t>(enchanter)]; // there it is alone
    for (auto& s : strikes) {
        s.x = place.xMetres / layout.extentWidthMetres * mix_.scene->fieldWidthMetres;
        s.y = place.yMetres / layout.extentHeightMetres * mix_.scene->fieldHeightMetres;
    }
    session_.play(strikes);
}

void Desk::testPulse(int enchanter) {
    CollisionEvent pulse;
    pulse.frequencyHz = 205.0; // where the thesis' actuators are strongest
    pulse.decayPerSecond = 30.0;
    pulse.amplitude = 0.5;
    strike(enchanter, {pulse});
}

void Desk::testSweep(int enchanter) {
    std::vector<CollisionEvent> tones;
    constexpr int count = 40;
    for (int k = 0; k < count; ++k) {
        CollisionEvent tone;
        tone.timeNs = k * std::int64_t{60'000'000};
        tone.durationNs = 60'000'000;
        tone.frequencyHz = 40.0 * std::pow(10.0, static_cast<double>(k) / (count - 1)); // 40 to 400 Hz: what is felt
        tone.amplitude = 0.3;
        tones.push_back(tone);
    }
    strike(enchanter, std::move(tones));
}

std::string Desk::open(const DeviceChoice& device) {
    AudioOutputSettings settings{device.name, outputMap(), device.sampleRateHz, device.blockFrames, levelOf(mix_), mix_.count(), true};
    const auto error = output_.open(settings);
    device_ = device;
    report(deviceTrouble_ = juce::String::fromUTF8(error.c_str()));
    scope_.setRate(output_.sampleRateHz());
    return error;
}

void Desk::setSilent(bool silent) {
    isSilent_ = silent;
    output_.setSilent(silent);
    sendChangeMessage();
}

double Desk::playOutSeconds() const noexcept {
    return output_.sampleRateHz() > 0 ? static_cast<double>(session_.playOutFrames()) / output_.sampleRateHz() : 0.0;
}

void Desk::report(const juce::String& trouble) {
    if (trouble == trouble_) return;
    trouble_ = trouble;
    sendChangeMessage();
}

void Desk::measure(const float* const* block, int frames) {
    const int heard = mix_.count();
    scope_.add(block, heard, frames);
    for (int j = 0; j < heard; ++j) {
        const auto range = juce::FloatVectorOperations::findMinAndMax(block[j], frames);
        const float peak = std::max(-range.getStart(), range.getEnd());
        auto& shown = now_.meters.peaks[static_cast<std::size_t>(j)];
        shown = std::max(shown, peak);
    }
}

DeskMoment Desk::look() {
    const double now = nowMs(), passed = std::min(1000.0, now - lookedAtMs_);
    lookedAtMs_ = now;
    const auto fall = static_cast<float>(std::pow(10.0, -meterFallDbPerSecond * passed / 20'000.0));
    for (auto& peak : now_.meters.peaks) peak = peak * fall < 1e-4f ? 0.0f : peak * fall;
    tap_.read([this](const float* const* block, int frames) { measure(block, frames); });
    now_.hits.clear();
    for (PlayedEvent played; session_.played().pop(played);) now_.hits.push_back(played.event);
    now_.session = session_.status();
    now_.device = output_.status();
    now_.meters.limiterGain = now_.session.render.limiterGain;
    now_.meters.enchanters = mix_.count();
    float loudest = 0.0f;
    for (std::size_t j = 0; j < static_cast<std::size_t>(mix_.count()); ++j) {
        const float peak = now_.meters.peaks[j];
        now_.meters.isConnected[j] = mix_.strips[j].output >= 0;
        if (peak >= now_.holds[j] || now - heldAtMs_[j] > holdMs) now_.holds[j] = peak, heldAtMs_[j] = now;
        loudest = std::max(loudest, peak);
    }
    now_.masterPeak = isSilent_ ? 0.0f : loudest * levelOf(mix_);
    now_.sessionNs = session_.readPoses(now_.poses);
    now_.aheadNs = static_cast<std::int64_t>(1e9 * playOutSeconds());
    if (now - maintainedAtMs_ > maintainMs) {
        maintainedAtMs_ = now;
        if (const auto trouble = juce::String::fromUTF8(output_.maintain().c_str()); trouble != deviceTrouble_) report(deviceTrouble_ = trouble);
    }
    return now_;
}

} // namespace physvib
