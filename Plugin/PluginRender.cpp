// SPDX-License-Identifier: GPL-3.0-or-later
// The plug-in processor on the render thread: transport, controls, MIDI, samples; no memory, locks, waits.
#include "Core/PortableMath.h"
#include "PluginProcessor.h"
#include <algorithm>
#include <limits>
#include <utility>

namespace physvib {

namespace {

constexpr int slideController = 74; // MPE's third dimension
constexpr int sustainPedal = 64, allSoundOff = 120, resetControllers = 121;
constexpr int allNotesOff = 123; // lets held ones go; others ring out, and the world is no note
constexpr float peakFallDbPerSecond = 20.0f;

} // namespace

// In parts: some hosts send longer blocks than announced, and SILENCE acts at its frame.
void PluginProcessor::render(juce::AudioBuffer<float>& buffer, const juce::MidiBuffer& midi,
                             bool bypassed) noexcept {
    const int frames = buffer.getNumSamples();
    notes_ = std::exchange(noteSource_, nullptr);
    readNote();
    if (blockFrames_ == 0 || frames == 0) {
        source_ = nullptr;
        if (blockFrames_ > 0) { // a host tells what happened while it renders nothing
            for (const auto message : midi) receive(message, 0);
            takeNotes(0, 0, 1);
        }
        return buffer.clear();
    }
    points_.begin(std::exchange(source_, nullptr), frames);
    readParameters();
    followTransport(frames);
    auto message = midi.begin();
    for (int first = 0; first < frames;) {
        const int end = renderPart(buffer, message, midi, first);
        std::array<float*, limits::maxEnchanters> out{};
        const int channels = std::min(buffer.getNumChannels(), limits::maxEnchanters);
        for (int c = 0; c < channels; ++c)
            out[static_cast<std::size_t>(c)] = buffer.getWritePointer(c) + first;
        open_.moveTo(bypassed || isShut_ ? 0.0f : 1.0f);
        open_.apply(out.data(), channels, end - first);
        guard_.process(out.data(), end - first);
        first = end;
    }
    readPoints(frames); // of the next block's first frame
    points_.end();
    measure(buffer);
}

// A parameter without points in this block has its value from the block's first frame on.
void PluginProcessor::readParameters() noexcept {
    for (std::size_t p = 0; p < parameterCount; ++p)
        if (points_.nextOf(static_cast<Parameter>(p)) == ParameterPoints::none)
            normals_[p] = parameters_[p]->getValue();
}

void PluginProcessor::readPoints(int until) noexcept {
    points_.takeUntil(until, [this](std::size_t p, double normal) {
        normals_[p] = static_cast<float>(normal);
        parameters_[p]->setValue(normals_[p]);
    });
}

// From `first` on; where it ends. At each frame at which something comes: values first, then notes.
int PluginProcessor::renderPart(juce::AudioBuffer<float>& buffer, juce::MidiBufferIterator& message,
                                const juce::MidiBuffer& midi, int first) noexcept {
    const int frames = buffer.getNumSamples();
    const auto mode = isNonRealtime() ? RenderMode::offline : RenderMode::realtime;
    const auto frameOf = [&](const juce::MidiMessageMetadata& m) {
        return std::clamp(m.samplePosition, first, frames - 1);
    };
    int end = std::min(frames, first + blockFrames_);
    const double seconds = first / sampleRateHz_.load(std::memory_order_relaxed);
    if (takes_.begin(mode)) forgetControls(), tempo_.begin(seconds);
    followTempo(seconds);
    for (int at = first; at < end;) {
        readPoints(at);
        if (at == first) isShut_ = isStopped() || value(Parameter::bypass) > 0.5, playKeys(0);
        end = std::min(end, points_.nextOf(Parameter::bypass));
        sendControls(at - first);
        for (; message != midi.end() && frameOf(*message) <= at; ++message) {
            if ((*message).samplePosition >= frames) ++displaced_;
            receive(*message, at - first);
        }
        takeNotes(at, first, frames);
        int next = std::min(end, points_.next());
        if (hasNote_) next = std::min(next, std::clamp(note_.frame, first, frames - 1));
        if (message != midi.end()) next = std::min(next, frameOf(*message));
        sustain(at - first, next - first);
        hear(buffer, first, at - first, next - first); // what comes in goes by its frame
        sendPaced(at - first, next - first);           // what was said faster than it may go
        at = next;
    }
    buffer.clear(first, end - first);
    // Tiles on the grid of the take that plays, so that neither blocks nor L change a sample.
    if (const Session* const session = takes_.session())
        guard_.moveTo(session->timeline().nextRenderedFrame(0));
    takes_.setTiming(timing());
    takes_.render(end - first, mode);
    for (int j = 0; j < takes_.channels(); ++j)
        if (const int channel = outputs_.channelOf[static_cast<std::size_t>(j)];
            channel >= 0 && channel < buffer.getNumChannels())
            takes_.addTo(buffer.getWritePointer(channel) + first, j, end - first);
    return end;
}

void PluginProcessor::followTransport(int frames) noexcept {
    std::optional<bool> plays;
    std::optional<std::int64_t> at;
    std::optional<double> beats, tempo;
    const auto told = [](auto& to, const auto& from) {
        if (from) to = *from;
    };
    if (auto* host = getPlayHead())
        if (const auto position = host->getPosition()) {
            plays = position->getIsPlaying();
            told(at, position->getTimeInSamples());
            told(tempo, position->getBpm());
            told(beats, position->getPpqPosition());
        }
    tempo_.follow(tempo, beats, frames / sampleRateHz_.load(std::memory_order_relaxed));
    const auto change = transport_.follow(plays, at, frames);
    const bool restarts = takes_.lookForNew() != TransportMode::free;
    if (restarts && change == Transport::Change::started)
        takes_.start();
    else if (restarts && !transport_.isPlaying())
        takes_.stop();
    else if (!takes_.isPlaying())
        takes_.start();
    else if (change == Transport::Change::stopped)
        stopAll(0);
}

void PluginProcessor::followTempo(double seconds) noexcept {
    Session* const session = takes_.session();
    if (!session || takes_.settings().transport != TransportMode::inTempo) return;
    const auto takeSeconds = static_cast<double>(session->timeline().framesRendered()) /
                             sampleRateHz_.load(std::memory_order_relaxed);
    tempo_.news(seconds, takeSeconds, [session](const HostBeats::Script& script) {
        RenderInput input;
        input.group = RenderInput::script;
        input.scriptSeconds = script.seconds;
        input.scale = script.rate;
        return session->callback().perform(input, 0);
    });
}

// A new take has received no controls: it begins with the scene's own gravity and materials.
void PluginProcessor::forgetControls() noexcept {
    beats_.forget();
    music_.forget();
    held_.forget();
    for (auto* const pace : {&levelPace_, &pannerPace_, &holdPace_, &materialPace_})
        pace->reset(static_cast<int>(sampleRateHz_.load(std::memory_order_relaxed)));
    owesStop_ = false;
    sent_.fill(std::numeric_limits<double>::quiet_NaN());
    for (const auto which : {Parameter::gravity, Parameter::tilt, Parameter::material}) {
        const auto& row = rowOf(which);
        sent_[static_cast<std::size_t>(which)] =
            denormalised(row, static_cast<float>(normalised(row, row.initial)));
    }
}

// A value is sent again until the queue accepts it, so the newest is never lost.
template <class Send>
void PluginProcessor::send(std::initializer_list<Parameter> those, Send what) noexcept {
    if (std::ranges::none_of(those, [this](Parameter which) {
            return sent_[static_cast<std::size_t>(which)] != value(which);
        }))
        return;
    auto told = sent_;
    // before: the host may change it meanwhile
    for (const auto which : those) told[static_cast<std::size_t>(which)] = value(which);
    if (what()) sent_ = told;
}

// Calls `hold(frame)` at the first frame in [first, end) that the pace allows; false: none, or it failed.
template <class Hold>
bool PluginProcessor::sendAt(ControlPace& pace, int first, int end, Hold hold) noexcept {
    const std::int64_t now = takes_.session()->timeline().framesRendered(), at = pace.nextFrom(now + first);
    if (at >= now + end || !hold(static_cast<int>(at - now))) return false;
    pace.wentAt(at);
    return true;
}

// Values as they are from frame `first` to `end`.
void PluginProcessor::sendPaced(int first, int end) noexcept {
    Take* const take = takes_.take();
    if (!take) return;
    send({Parameter::level}, [&] {
        return sendAt(levelPace_, first, end, [&](int frame) {
            return take->queueLevel(gainOfLevel(value(Parameter::level)), frame);
        });
    });
    send({Parameter::law, Parameter::exponent}, [&] {
        return sendAt(pannerPace_, first, end, [&](int frame) {
            return take->queueLaw(lawOf(value(Parameter::law)), value(Parameter::exponent), frame);
        });
    });
    send({Parameter::gravity, Parameter::tilt}, [&] {
        RenderInput input;
        input.hold = {value(Parameter::gravity), juce::degreesToRadians(value(Parameter::tilt))};
        return sendAt(holdPace_, first, end,
                      [&](int frame) { return take->session.callback().perform(input, frame); });
    });
    send({Parameter::material}, [&] {
        RenderInput input;
        input.group = take->settings().midi.groupOfMaterial(juce::roundToInt(value(Parameter::material)));
        return sendAt(materialPace_, first, end, [&](int frame) {
            return input.group < 0 || take->session.callback().perform(input, frame);
        });
    });
}

void PluginProcessor::sendControls(int frame) noexcept {
    if (owesStop_) stopAll(frame);
    if (owesSilence_) silence(frame);
    sendPaced(frame, frame + 1);
}

void PluginProcessor::stopAll(int frame) noexcept {
    held_.forget();
    Session* const session = takes_.session();
    owesStop_ = session && !session->callback().control({.kind = RenderControl::Kind::stopAll}, frame);
}

void PluginProcessor::silence(int frame) noexcept {
    held_.forget();
    owesSilence_ = !takes_.silence(frame);
}

// Plays keys of the window's keyboard at `frame` of the coming part.
void PluginProcessor::playKeys(int frame) noexcept {
    for (Key key; keys_.pop(key);) {
        const juce::MidiMessage message{key.velocity > 0 ? 0x90 : 0x80, key.note & 127, key.velocity & 127};
        receive({message.getRawData(), message.getRawDataSize(), 0}, frame);
    }
}

void PluginProcessor::readNote() noexcept {
    note_ = {};
    hasNote_ = notes_ && notes_->next(note_);
}

// Handles note events up to frame `at`; the block has `frames` frames, its part begins at `first`. Changes of
// a note at its onset frame are part of its onset.
void PluginProcessor::takeNotes(int at, int first, int frames) noexcept {
    const auto frame = [&] { return std::clamp(note_.frame, first, frames - 1); };
    while (hasNote_ && frame() <= at) {
        if (note_.frame >= frames) ++displaced_;
        const auto event = note_;
        const int onset = frame();
        NoteTouch touch{.id = event.id, .semitones = event.isOn() ? event.value : 0.0};
        for (readNote();
             hasNote_ && event.isOn() && event.id >= 0 && note_.id == event.id && frame() == onset &&
             note_.kind >= NoteEvent::Kind::tuning && note_.kind < NoteEvent::Kind::pressure;
             readNote())
            note_.tell(touch);
        if (event.kind == NoteEvent::Kind::midi)
            receive({event.midi.data(), 3, 0}, at - first, touch);
        else
            express(event);
    }
}

void PluginProcessor::express(const NoteEvent& event) noexcept {
    if (event.kind == NoteEvent::Kind::off) return held_.stop(event.id, event.channel, event.number);
    held_.each([&](HeldNotes::Note& held) {
        if (!held.is(event.id, event.channel, event.number)) return;
        if (event.kind != NoteEvent::Kind::pressure) return event.tell(held.touch);
        if (std::isfinite(event.value)) held.pressure = std::clamp(event.value, 0.0, 1.0);
    });
}

void PluginProcessor::receive(const juce::MidiMessageMetadata& message, int frame,
                              const NoteTouch& touch) noexcept {
    if (message.numBytes < 2) return;
    const int kind = message.data[0] & 0xf0, channel = (message.data[0] & 0x0f) + 1;
    if (kind == 0xd0) press(channel, -1, message.data[1] / 127.0);
    if (kind == 0xc0) wantedProgram_ = message.data[1]; // the timer chooses it
    if (message.numBytes < 3) return;
    if (kind == 0xa0) press(channel, message.data[1], message.data[2] / 127.0);
    const bool isOn = kind == 0x90 && message.data[2] > 0;
    if (isOn) strike(channel, message.data[1], message.data[2], frame, touch);
    if (!isOn && (kind == 0x80 || kind == 0x90)) held_.stop(touch.id, channel, message.data[1]);
    if (kind == 0xe0)
        expression_.bend(channel,
                         static_cast<float>((message.data[2] * 128 + message.data[1]) - 8192) / 16384.0f);
    if (kind == 0xb0) control(channel, message.data[1], message.data[2], frame);
}

// Sets the pressure of that note, or (-1) of all notes of the channel and of the MPE zone that it leads.
void PluginProcessor::press(int channel, int note, double pressure) noexcept {
    held_.each([&](HeldNotes::Note& held) {
        if (held.channel == channel && (note < 0 || note == held.number)) held.pressure = pressure;
        if (note < 0 && expression_.masterOf(held.channel) == channel) held.masterPressure = pressure;
    });
}

void PluginProcessor::strike(int channel, int note, int velocity, int frame,
                             const NoteTouch& touch) noexcept {
    Session* const session = takes_.session();
    if (!session) return;
    const auto& midi = takes_.settings().midi;
    if (RenderInput input; (input.group = midi.groupOf(note)) >= 0) {
        input.scale = velocity / 127.0;
        session->callback().perform(input, frame);
        return;
    }
    const NoteKnobs now = knobs();
    CollisionEvent event = midi.strikeOf(note, now, takes_.settings().layout);
    if (event.frequencyHz <= 0.0) return;
    const double loudness = midi.loudnessOf(velocity, now);
    if (midi.isHeld(note, now))
        return held_.start({channel, note, loudness, session->timeline().framesRendered() + frame, touch});
    event.amplitude = gainOfLevel(value(Parameter::strikeLevel)) * loudness * touch.gain;
    session->callback().strike(placed(event, channel, touch), frame);
}

NoteKnobs PluginProcessor::knobs() const noexcept {
    return knobsBy([this](Parameter which) { return value(which); });
}

// Moves the strike by shifts, bend and slide, and makes it as loud there as the voice requires.
CollisionEvent PluginProcessor::placed(CollisionEvent strike, int channel,
                                       const NoteTouch& touch) const noexcept {
    const auto& settings = takes_.settings();
    const auto& midi = settings.midi;
    const double bend = expression_.bendOf(channel), master = expression_.masterBendOf(channel),
                 semitones = midi.bendSemitones(knobs());
    double shift = touch.semitones;
    if (semitones > 0.0) shift += 2.0 * (bend * semitones + master * ChannelExpression::masterSemitones);
    const auto shifted = [](double at, double by, double size) {
        return std::clamp(at + by * size, 0.0, size);
    };
    if (shift != 0.0)
        strike.frequencyHz = std::clamp(strike.frequencyHz * portable::pow(2.0, shift / 12.0),
                                        limits::slowestToneHz, limits::maxFrequencyHz);
    strike.x =
        shifted(strike.x,
                value(Parameter::strikeX) * 0.01 + (semitones > 0.0 ? 0.0 : bend + master) + 0.5 * touch.pan,
                midi.fieldWidthMetres());
    strike.y =
        shifted(strike.y, value(Parameter::strikeY) * 0.01 + expression_.slideOf(channel) + touch.brightness,
                midi.fieldHeightMetres());
    if (!midi.voice().isLoudest) return strike;
    PhantomPanner::Gains gains{};
    PhantomPanner{settings.layout, lawOf(value(Parameter::law)), value(Parameter::exponent),
                  midi.fieldWidthMetres(), midi.fieldHeightMetres()}
        .gainsOf(strike, Spread::layout, gains);
    const double most = *std::max_element(gains.begin(), gains.begin() + settings.layout.count);
    if (most > 0.0) strike.amplitude /= most;
    return strike;
}

// The amplitude is the larger of velocity and pressure.
NoteSound PluginProcessor::soundOf(const HeldNotes::Note& note) const noexcept {
    const auto& settings = takes_.settings();
    CollisionEvent event = settings.midi.strikeOf(note.number, knobs(), settings.layout);
    event.amplitude = gainOfLevel(value(Parameter::strikeLevel)) * note.touch.gain *
                      std::max({note.velocity, note.pressure, note.masterPressure});
    event = placed(event, note.channel, note.touch);
    return {event.frequencyHz, event.amplitude, event.x, event.y};
}

// Plays the strikes of held notes that begin in frames [first, end) of this part.
void PluginProcessor::sustain(int first, int end) noexcept {
    Session* const session = takes_.session();
    if (!session || first >= end) return;
    const std::int64_t now = session->timeline().framesRendered();
    const double release = takes_.settings().midi.releasePerSecond(knobs());
    held_.advance(
        now + end, static_cast<int>(sampleRateHz_.load(std::memory_order_relaxed)),
        [this](const HeldNotes::Note& note) { return soundOf(note); },
        [&](const HeldNotes::Note& note, const NoteSound& sound, std::int64_t afterNs,
            std::int64_t durationNs) {
            CollisionEvent event;
            event.frequencyHz = sound.frequencyHz;
            event.amplitude = sound.amplitude;
            event.x = sound.x;
            event.y = sound.y;
            event.durationNs = durationNs;
            event.decayPerSecond = durationNs > 0 ? 0.0 : release;
            session->callback().strike(event, static_cast<int>(note.onsetFrame - now), afterNs);
        });
}

// Frames `from` to `to` of the part of the block that begins at `first`. The side chain's channels are the
// buffer's first ones, until what is played is written over them. A beat strikes at its own time, which is
// past: L is longer than it took to be known; where strikes are direct, as soon as it is sure to be known.
void PluginProcessor::hear(const juce::AudioBuffer<float>& buffer, int first, int from, int to) noexcept {
    const double readiness = value(Parameter::beats);
    Session* const session = takes_.session();
    if (!session) return; // a take begins by forgetting
    beats_.hear(buffer, first + from, to - from, 0.01 * readiness, [&](const BandOnset& onset, int frame) {
        if (readiness <= 0.0) return;
        const auto& settings = takes_.settings();
        const int felt = frame - first + (session->timeline().isDirectFromStart() ? beats_.delayFrames() : 0);
        BeatVoices voices;
        voices.enchanters = usualBeatEnchanters(settings.layout.count);
        voices.level = gainOfLevel(value(Parameter::strikeLevel));
        strikeBeat(onset, 0, voices, settings.layout, settings.midi.fieldWidthMetres(),
                   settings.midi.fieldHeightMetres(),
                   [&](const CollisionEvent& event) { session->callback().strike(event, felt); });
    });
    if (auto* const delay = takes_.take()->music())
        music_.hear(buffer, first + from, to - from, gainOfLevel(value(Parameter::music)),
                    value(Parameter::musicSides) > 0.5, *delay, session->timeline().nextInputFrame(from));
}

void PluginProcessor::control(int channel, int controller, int value, int frame) noexcept {
    if (controller == slideController) expression_.slide(channel, static_cast<float>(value - 64) / 128.0f);
    expression_.controller(channel, controller, value);
    if (controller == allSoundOff) return silence(frame);
    if (controller == sustainPedal) held_.pedal(channel, value >= 64);
    if (controller == allNotesOff) held_.stopAll();
    if (controller == resetControllers) {
        expression_.bend(channel, 0.0f), expression_.slide(channel, 0.0f);
        held_.pedal(channel, false);
        press(channel, -1, 0.0);
    }
    if (controller < allSoundOff)
        lastController_.store(((lastController_.load(std::memory_order_relaxed) >> 8) + 1) << 8 |
                                  static_cast<std::uint32_t>(controller),
                              std::memory_order_relaxed);
    const int which = takes_.settings().midi.parameterOf(controller);
    if (which < 0) return;
    normals_[static_cast<std::size_t>(which)] = static_cast<float>(value) / 127.0f;
    parameters_[static_cast<std::size_t>(which)]->setByController(normals_[static_cast<std::size_t>(which)]);
    sendControls(frame);
}

void PluginProcessor::measure(const juce::AudioBuffer<float>& buffer) noexcept {
    const int frames = buffer.getNumSamples();
    const float fall = juce::Decibels::decibelsToGain(
        -peakFallDbPerSecond * static_cast<float>(frames / sampleRateHz_.load(std::memory_order_relaxed)));
    measured_.enchanters = takes_.channels();
    measured_.connected = outputs_.connected(measured_.enchanters);
    if (auto* session = takes_.session()) {
        const auto& render = session->status().render;
        measured_.limiterGain = render.limiterGain;
        measured_.guardGain = render.guardGain;
    }
    measured_.guardGain = std::min(measured_.guardGain, guard_.gain());
    for (std::size_t j = 0; j < measured_.peaks.size(); ++j) {
        const int channel = outputs_.channelOf[j];
        measured_.isConnected[j] = channel >= 0;
        const float peak = channel >= 0 && channel < buffer.getNumChannels()
                               ? buffer.getMagnitude(channel, 0, frames)
                               : 0.0f;
        measured_.peaks[j] = std::max(peak, measured_.peaks[j] * fall);
    }
    meters_.write(measured_);
}

} // namespace physvib
