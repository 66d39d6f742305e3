// SPDX-License-Identifier: GPL-3.0-or-later
// PluginProcessor on the audio thread: transport, controls, MIDI, music, meters. It never locks or allocates.
#include "Core/PortableMath.h"
#include "PluginProcessor.h"
#include <algorithm>
#include <limits>
#include <utility>

namespace physvib {

namespace {

constexpr int slideController = 74; // MPE's third dimension
constexpr int sustainPedal = 64, allSoundOff = 120, resetControllers = 121;
constexpr int allNotesOff = 123; // as the modes above it, ends its channel's held notes; struck ones ring out
constexpr float peakFallDbPerSecond = 20.0f;

} // namespace

// Renders in parts: some hosts send longer blocks than announced, and bypass (SILENCE) acts at its frame.
void PluginProcessor::render(juce::AudioBuffer<float>& buffer, const juce::MidiBuffer& midi,
                             bool bypassed) noexcept {
    const int frames = buffer.getNumSamples();
    blockNotes_ = std::exchange(noteSource_, nullptr);
    readNextNote();
    if (blockFrames_ == 0 || frames == 0) {
        pointSource_ = nullptr;
        if (blockFrames_ > 0) { // hosts send MIDI and notes in empty blocks too
            for (const auto message : midi) handleMidi(message, 0);
            handleNotes(0, 0, 1);
        }
        return buffer.clear();
    }
    parameterPoints_.begin(std::exchange(pointSource_, nullptr), frames);
    readParameters();
    followTransport(frames);
    auto message = midi.begin();
    for (int first = 0; first < frames;) {
        const int end = renderPart(buffer, message, midi, first);
        std::array<float*, limits::maxActuators> out{};
        const int channels = std::min(buffer.getNumChannels(), limits::maxActuators);
        for (int c = 0; c < channels; ++c)
            out[static_cast<std::size_t>(c)] = buffer.getWritePointer(c) + first;
        outputGate_.moveTo(bypassed || isMuted_ ? 0.0f : 1.0f);
        outputGate_.apply(out.data(), channels, end - first);
        guard_.process(out.data(), end - first);
        first = end;
    }
    applyPoints(frames); // of the next block's first frame
    parameterPoints_.end();
    updateMeters(buffer);
}

// Reads the parameters that have no points in this block: their values hold from its first frame on.
void PluginProcessor::readParameters() noexcept {
    for (std::size_t p = 0; p < parameterCount; ++p)
        if (parameterPoints_.nextFrame(static_cast<Parameter>(p)) == ParameterPoints::noFrame)
            normalisedValues_[p] = parameters_[p]->getValue();
}

void PluginProcessor::applyPoints(int until) noexcept {
    parameterPoints_.readPointsUntil(until, [this](std::size_t p, double normal) {
        normalisedValues_[p] = static_cast<float>(normal);
        parameters_[p]->setValue(normalisedValues_[p]);
    });
}

// Renders a part of the block from frame `first` on and returns its end. It goes from one frame at which
// anything happens to the next; at each of them parameters act before notes.
int PluginProcessor::renderPart(juce::AudioBuffer<float>& buffer, juce::MidiBufferIterator& message,
                                const juce::MidiBuffer& midi, int first) noexcept {
    const int frames = buffer.getNumSamples();
    const auto frameOf = [&](const juce::MidiMessageMetadata& m) {
        return std::clamp(m.samplePosition, first, frames - 1);
    };
    int end = std::min(frames, first + blockFrames_);
    partSeconds_ = first / sampleRateHz_.load(std::memory_order_relaxed);
    beginRun();
    for (int frame = first; frame < end;) {
        applyPoints(frame);
        if (frame == first) isMuted_ = isStopped() || value(Parameter::bypass) > 0.5, playWindowKeys(0);
        end = std::min(end, parameterPoints_.nextFrame(Parameter::bypass));
        sendControls(frame - first);
        for (; message != midi.end() && frameOf(*message) <= frame &&
               !needsPart(*(*message).data, frame - first);
             ++message) {
            if ((*message).samplePosition >= frames) ++displacedMessages_;
            handleMidi(*message, frame - first);
        }
        handleNotes(frame, first, frames);
        int next = std::min(end, parameterPoints_.next());
        if (hasNextNote_) next = std::min(next, std::clamp(nextNote_.frame, first, frames - 1));
        if (message != midi.end()) next = std::min(next, frameOf(*message));
        if (next == frame) end = frame; // what comes next needs a part
        playHeldNotes(frame - first, next - first);
        processSideChain(buffer, first, frame - first, next - first);
        sendPacedControls(frame - first, next - first); // changes that came faster than their pace allows
        frame = next;
    }
    buffer.clear(first, end - first);
    // The guard's tiles are those of the playing run, so that samples depend neither on blocks nor on L.
    if (const Session* const session = runs_.session())
        guard_.moveTo(session->timeline().nextRenderedFrame(0));
    runs_.setTiming(timing());
    runs_.render(end - first, renderMode());
    for (int j = 0; j < runs_.channels(); ++j)
        if (const int channel = outputMap_.channels[static_cast<std::size_t>(j)];
            channel >= 0 && channel < buffer.getNumChannels())
            runs_.addTo(buffer.getWritePointer(channel) + first, j, end - first);
    return end;
}

void PluginProcessor::followTransport(int frames) noexcept {
    std::optional<bool> isPlaying;
    std::optional<std::int64_t> positionFrames;
    std::optional<double> beats, tempo;
    const auto copyIfSet = [](auto& to, const auto& from) {
        if (from) to = *from;
    };
    if (auto* host = getPlayHead())
        if (const auto position = host->getPosition()) {
            isPlaying = position->getIsPlaying();
            copyIfSet(positionFrames, position->getTimeInSamples());
            copyIfSet(tempo, position->getBpm());
            copyIfSet(beats, position->getPpqPosition());
        }
    hostBeats_.follow(tempo, beats, frames / sampleRateHz_.load(std::memory_order_relaxed));
    const auto change = transport_.follow(isPlaying, positionFrames, frames);
    const bool restarts = runs_.adoptNewSettings() != TransportMode::free;
    if (restarts && change == Transport::Change::started)
        runs_.start();
    else if (restarts && !transport_.isPlaying())
        runs_.stop();
    else if (!runs_.isPlaying())
        runs_.start();
    else if (change == Transport::Change::stopped)
        stopAll(0);
}

// Begins the run that is due, and lets its script follow the host's tempo.
void PluginProcessor::beginRun() noexcept {
    if (runs_.begin(renderMode())) resetControls(), hostBeats_.begin(partSeconds_);
    Session* const session = runs_.session();
    if (!session || runs_.settings().transport != TransportMode::inTempo) return;
    const auto runSeconds = static_cast<double>(session->timeline().framesRendered()) /
                            sampleRateHz_.load(std::memory_order_relaxed);
    hostBeats_.sendIfChanged(partSeconds_, runSeconds, [session](const HostBeats::Script& script) {
        RenderInput input;
        input.group = RenderInput::script;
        input.scriptSeconds = script.seconds;
        input.scale = script.rate;
        return session->callback().postInput(input, 0);
    });
}

// Marks all controls as not sent, but gravity, tilt and materials: a new run has the scene's own.
void PluginProcessor::resetControls() noexcept {
    beats_.reset();
    music_.reset();
    heldNotes_.clear();
    for (auto* const pace : {&levelPace_, &pannerPace_, &gravityPace_, &materialPace_})
        pace->reset(static_cast<int>(sampleRateHz_.load(std::memory_order_relaxed)));
    isStopPending_ = false;
    lastSentValues_.fill(std::numeric_limits<double>::quiet_NaN());
    for (const auto which : {Parameter::gravity, Parameter::tilt, Parameter::material}) {
        const auto& row = rowOf(which);
        lastSentValues_[static_cast<std::size_t>(which)] =
            denormalised(row, static_cast<float>(normalised(row, row.initial)));
    }
}

// Calls `submit()` if a watched parameter has changed, and again until it returns true: no value is lost.
template <class Send>
void PluginProcessor::sendIfChanged(std::initializer_list<Parameter> watched, Send submit) noexcept {
    if (std::ranges::none_of(watched, [this](Parameter which) {
            return lastSentValues_[static_cast<std::size_t>(which)] != value(which);
        }))
        return;
    auto values = lastSentValues_;
    for (const auto which : watched) values[static_cast<std::size_t>(which)] = value(which);
    if (submit()) lastSentValues_ = values;
}

// Calls `submit(frame)` at the first frame in [first, end) that the pace allows; false: none, or it failed.
template <class Submit>
bool PluginProcessor::sendWhenAllowed(ControlPace& pace, int first, int end, Submit submit) noexcept {
    const std::int64_t now = runs_.session()->timeline().framesRendered(),
                       sendFrame = pace.nextAllowedFrame(now + first);
    if (sendFrame >= now + end || !submit(static_cast<int>(sendFrame - now))) return false;
    pace.recordSent(sendFrame);
    return true;
}

// Sends changed values within frames [first, end), each kind no faster than its pace allows.
void PluginProcessor::sendPacedControls(int first, int end) noexcept {
    PluginRun* const run = runs_.currentRun();
    if (!run) return;
    sendIfChanged({Parameter::level}, [&] {
        return sendWhenAllowed(levelPace_, first, end, [&](int frame) {
            return run->queueLevel(gainFromLevelDb(value(Parameter::level)), frame);
        });
    });
    sendIfChanged({Parameter::law, Parameter::exponent}, [&] {
        return sendWhenAllowed(pannerPace_, first, end, [&](int frame) {
            return run->queueLaw(lawFromValue(value(Parameter::law)), value(Parameter::exponent), frame);
        });
    });
    sendIfChanged({Parameter::gravity, Parameter::tilt}, [&] {
        RenderInput input;
        input.hold = {value(Parameter::gravity), juce::degreesToRadians(value(Parameter::tilt))};
        return sendWhenAllowed(gravityPace_, first, end,
                               [&](int frame) { return run->session.callback().postInput(input, frame); });
    });
    sendIfChanged({Parameter::material}, [&] {
        RenderInput input;
        input.group = run->settings().midi.materialGroup(juce::roundToInt(value(Parameter::material)));
        return sendWhenAllowed(materialPace_, first, end, [&](int frame) {
            return input.group < 0 || run->session.callback().postInput(input, frame);
        });
    });
}

void PluginProcessor::sendControls(int frame) noexcept {
    if (isStopPending_) stopAll(frame);
    if (isSilencePending_) silence(frame);
    sendPacedControls(frame, frame + 1);
}

void PluginProcessor::stopAll(int frame) noexcept {
    heldNotes_.clear();
    Session* const session = runs_.session();
    isStopPending_ = session && !session->callback().control({.kind = RenderControl::Kind::stopAll}, frame);
}

void PluginProcessor::silence(int frame) noexcept {
    heldNotes_.clear();
    isSilencePending_ = !runs_.silence(frame);
}

// Plays keys of the window's keyboard at `frame` of the coming part.
void PluginProcessor::playWindowKeys(int frame) noexcept {
    for (Key key; keys_.pop(key);) {
        const juce::MidiMessage message{key.velocity > 0 ? 0x90 : 0x80, key.note & 127, key.velocity & 127};
        handleMidi({message.getRawData(), message.getRawDataSize(), 0}, frame);
    }
}

void PluginProcessor::readNextNote() noexcept {
    nextNote_ = {};
    hasNextNote_ = blockNotes_ && blockNotes_->next(nextNote_);
}

// Handles note events up to frame `until`. Expression at the frame of a note's onset belongs to the onset.
void PluginProcessor::handleNotes(int until, int first, int frames) noexcept {
    const auto frame = [&] { return std::clamp(nextNote_.frame, first, frames - 1); };
    while (hasNextNote_ && frame() <= until && !needsPart(nextNote_.midi[0], until - first)) {
        if (nextNote_.frame >= frames) ++displacedMessages_;
        const auto event = nextNote_;
        const int onset = frame();
        NoteExpression expression{.id = event.id, .semitones = event.isOn() ? event.value : 0.0};
        for (readNextNote();
             hasNextNote_ && event.isOn() && event.id >= 0 && nextNote_.id == event.id && frame() == onset &&
             nextNote_.kind >= NoteEvent::Kind::tuning && nextNote_.kind < NoteEvent::Kind::pressure;
             readNextNote())
            nextNote_.applyTo(expression);
        if (event.kind == NoteEvent::Kind::midi)
            handleMidi({event.midi.data(), 3, 0}, until - first, expression);
        else
            applyExpression(event);
    }
}

void PluginProcessor::applyExpression(const NoteEvent& event) noexcept {
    heldNotes_.forEachNote([&](HeldNotes::Note& held) {
        if (!held.matches(event.id, event.channel, event.number)) return;
        held.isDown = held.isDown && event.kind != NoteEvent::Kind::off;
        if (event.kind != NoteEvent::Kind::pressure) return event.applyTo(held.expression);
        if (std::isfinite(event.value)) held.pressure = std::clamp(event.value, 0.0, 1.0);
    });
}

void PluginProcessor::handleMidi(const juce::MidiMessageMetadata& message, int frame,
                                 const NoteExpression& expression) noexcept {
    if (message.numBytes < 2) return;
    const int kind = message.data[0] & 0xf0, channel = (message.data[0] & 0x0f) + 1;
    if (kind == 0xd0) applyPressure(channel, -1, message.data[1] / 127.0);
    if (kind == programChange) chooseProgram(message.data[1], frame);
    if (message.numBytes < 3) return;
    if (kind == 0xa0) applyPressure(channel, message.data[1], message.data[2] / 127.0);
    const bool isOn = kind == 0x90 && message.data[2] > 0;
    if (isOn) strike(channel, message.data[1], message.data[2], frame, expression);
    if (!isOn && (kind == 0x80 || kind == 0x90))
        applyExpression({NoteEvent::Kind::off, frame, {}, expression.id, channel, message.data[1]});
    if (kind == 0xe0)
        expression_.setBend(channel,
                            static_cast<float>((message.data[2] * 128 + message.data[1]) - 8192) / 16384.0f);
    if (kind != 0xb0) return;
    const bool isAny = isOfAnyChannel() && message.data[1] > allSoundOff;
    for (int c = isAny ? 1 : channel; c <= (isAny ? 16 : channel); ++c)
        handleController(c, message.data[1], message.data[2], frame);
}

// The timer chooses a program; a bounce does not wait for it, unless memory is lacking.
void PluginProcessor::chooseProgram(int program, int frame) noexcept {
    if (!isNonRealtime()) return requestedProgram_.store(program);
    requestedProgram_ = -1; // an older one
    if (program == program_) return;
    try {
        setCurrentProgram(program);
        readParameters();
        beginRun();
        sendControls(frame);
    } catch (const std::bad_alloc&) {
        requestedProgram_ = program;
    }
}

// Sets the pressure of that note, or (-1) of all notes of the channel and of the MPE zone that it leads.
void PluginProcessor::applyPressure(int channel, int note, double pressure) noexcept {
    heldNotes_.forEachNote([&](HeldNotes::Note& held) {
        if (held.channel == channel && (note < 0 || note == held.number)) held.pressure = pressure;
        if (note < 0 && expression_.findMaster(held.channel) == channel) held.masterPressure = pressure;
    });
}

void PluginProcessor::strike(int channel, int note, int velocity, int frame,
                             const NoteExpression& expression) noexcept {
    Session* const session = runs_.session();
    if (!session) return;
    const auto& midi = runs_.settings().midi;
    if (RenderInput input; (input.group = midi.noteGroup(note)) >= 0) {
        input.scale = velocity / 127.0;
        session->callback().postInput(input, frame);
        return;
    }
    const NoteKnobs now = knobs();
    CollisionEvent event = midi.strikeOf(note, now, runs_.settings().layout);
    if (event.frequencyHz <= 0.0) return;
    const double loudness = midi.velocityAmplitude(velocity, now);
    if (midi.isHeld(note, now))
        return heldNotes_.start({channel, std::max(1, expression_.findMaster(channel)), note, loudness,
                                 session->timeline().framesRendered() + frame, expression});
    event.amplitude = gainFromLevelDb(value(Parameter::strikeLevel)) * loudness * expression.gain;
    session->callback().strike(strikeAtPlace(event, channel, expression), frame);
}

NoteKnobs PluginProcessor::knobs() const noexcept {
    return noteKnobsFrom([this](Parameter which) { return value(which); });
}

// Returns the strike with its place and pitch changed by the shift parameters, bend, slide and `expression`;
// if the voice requires it, its amplitude is set so that the loudest actuator gets all of it.
CollisionEvent PluginProcessor::strikeAtPlace(CollisionEvent strike, int channel,
                                              const NoteExpression& expression) const noexcept {
    const auto& settings = runs_.settings();
    const auto& midi = settings.midi;
    const double semitones = midi.bendSemitones(knobs());
    double shift = expression.semitones;
    if (semitones > 0.0) shift += expression_.bendSemitones(channel, semitones);
    const auto shifted = [](double place, double offset, double size) {
        return std::clamp(place + offset * size, 0.0, size);
    };
    if (shift != 0.0)
        strike.frequencyHz = std::clamp(strike.frequencyHz * portable::pow(2.0, shift / 12.0),
                                        limits::slowestToneHz, limits::maxFrequencyHz);
    strike.x = shifted(strike.x,
                       value(Parameter::strikeX) * 0.01 +
                           (semitones > 0.0 ? 0.0 : expression_.bend(channel)) + 0.5 * expression.pan,
                       midi.fieldWidthMetres());
    strike.y = shifted(strike.y,
                       value(Parameter::strikeY) * 0.01 + expression_.slide(channel) + expression.brightness,
                       midi.fieldHeightMetres());
    if (!midi.voice().levelsPeak) return strike;
    PhantomPanner::Gains gains{};
    PhantomPanner{settings.layout, lawFromValue(value(Parameter::law)), value(Parameter::exponent),
                  midi.fieldWidthMetres(), midi.fieldHeightMetres()}
        .gainsOf(strike, Spread::layout, gains);
    const double maxGain = *std::max_element(gains.begin(), gains.begin() + settings.layout.count);
    if (maxGain > 0.0) strike.amplitude /= maxGain;
    return strike;
}

// The present sound of a held note; its amplitude is that of velocity or pressure, whichever is larger.
CollisionEvent PluginProcessor::heldNoteSound(const HeldNotes::Note& note) const noexcept {
    const auto& settings = runs_.settings();
    CollisionEvent event = settings.midi.strikeOf(note.number, knobs(), settings.layout);
    event.amplitude = gainFromLevelDb(value(Parameter::strikeLevel)) * note.expression.gain *
                      std::max({note.velocity, note.pressure, note.masterPressure});
    return strikeAtPlace(event, note.channel, note.expression);
}

// Plays the strikes of held notes that begin in frames [first, end) of this part.
void PluginProcessor::playHeldNotes(int first, int end) noexcept {
    Session* const session = runs_.session();
    if (!session || first >= end) return;
    const std::int64_t now = session->timeline().framesRendered();
    const double release = runs_.settings().midi.releasePerSecond(knobs());
    heldNotes_.advance(
        now + end, static_cast<int>(sampleRateHz_.load(std::memory_order_relaxed)),
        [this](const HeldNotes::Note& note) { return heldNoteSound(note); },
        [&](const HeldNotes::Note& note, CollisionEvent event, std::int64_t afterNs,
            std::int64_t durationNs) {
            event.durationNs = durationNs;
            event.decayPerSecond = durationNs > 0 ? 0.0 : release;
            session->callback().strike(event, static_cast<int>(note.onsetFrame - now), afterNs);
        });
}

// Processes frames [from, to) of the part that begins at `first`. The first channels of the buffer are the
// side chain until the output overwrites them. A beat strikes at the time of its onset, which is past but,
// since L includes the delay of detection, not too late; direct strikes come a constant delay after it.
void PluginProcessor::processSideChain(const juce::AudioBuffer<float>& buffer, int first, int from,
                                       int to) noexcept {
    const double readiness = value(Parameter::beats);
    Session* const session = runs_.session();
    if (!session) return; // resetControls() clears the history when a run begins
    beats_.process(buffer, first + from, to - from, 0.01 * readiness, [&](const BandOnset& onset, int frame) {
        if (readiness <= 0.0) return;
        const auto& settings = runs_.settings();
        const int strikeFrame =
            frame - first + (session->timeline().isDirectFromStart() ? beats_.delayFrames() : 0);
        BeatVoices voices;
        voices.actuators = defaultBeatActuators(settings.layout.count);
        voices.level = gainFromLevelDb(value(Parameter::strikeLevel));
        makeBeatEvents(onset, 0, voices, settings.layout, settings.midi.fieldWidthMetres(),
                       settings.midi.fieldHeightMetres(),
                       [&](const CollisionEvent& event) { session->callback().strike(event, strikeFrame); });
    });
    if (auto* const delay = runs_.currentRun()->musicDelay())
        music_.process(buffer, first + from, to - from, gainFromLevelDb(value(Parameter::music)),
                       value(Parameter::musicSides) > 0.5, *delay, session->timeline().nextInputFrame(from));
}

void PluginProcessor::handleController(int channel, int controller, int value, int frame) noexcept {
    if (controller == slideController) expression_.setSlide(channel, static_cast<float>(value - 64) / 128.0f);
    expression_.handleController(channel, controller, value, !isOfAnyChannel());
    if (controller == allSoundOff) return silence(frame);
    if (controller == sustainPedal) heldNotes_.setPedal(channel, value >= 64);
    if (controller >= allNotesOff)
        heldNotes_.forEachNote([&](HeldNotes::Note& held) {
            held.isEnded |= held.channel == channel || expression_.findMaster(held.channel) == channel;
        });
    if (controller == resetControllers) {
        expression_.reset(channel);
        heldNotes_.setPedal(channel, false);
        applyPressure(channel, -1, 0.0);
    }
    if (controller < allSoundOff)
        lastController_.store(((lastController_.load(std::memory_order_relaxed) >> 8) + 1) << 8 |
                                  static_cast<std::uint32_t>(controller),
                              std::memory_order_relaxed);
    const int which = runs_.settings().midi.controllerParameter(controller);
    if (which < 0) return;
    normalisedValues_[static_cast<std::size_t>(which)] = static_cast<float>(value) / 127.0f;
    parameters_[static_cast<std::size_t>(which)]->setByController(
        normalisedValues_[static_cast<std::size_t>(which)]);
    sendControls(frame);
}

void PluginProcessor::updateMeters(const juce::AudioBuffer<float>& buffer) noexcept {
    const int frames = buffer.getNumSamples();
    const float fallGain = juce::Decibels::decibelsToGain(
        -peakFallDbPerSecond * static_cast<float>(frames / sampleRateHz_.load(std::memory_order_relaxed)));
    channelMeters_.actuatorCount = runs_.channels();
    channelMeters_.connectedCount = outputMap_.connectedCount(channelMeters_.actuatorCount);
    if (auto* session = runs_.session()) {
        const auto& render = session->status().render;
        channelMeters_.limiterGain = render.limiterGain;
        channelMeters_.guardGain = render.guardGain;
    }
    channelMeters_.guardGain = std::min(channelMeters_.guardGain, guard_.gain());
    for (std::size_t j = 0; j < channelMeters_.peaks.size(); ++j) {
        const int channel = outputMap_.channels[j];
        channelMeters_.isConnected[j] = channel >= 0;
        const float peak = channel >= 0 && channel < buffer.getNumChannels()
                               ? buffer.getMagnitude(channel, 0, frames)
                               : 0.0f;
        channelMeters_.peaks[j] = std::max(peak, channelMeters_.peaks[j] * fallGain);
    }
    meters_.write(channelMeters_);
}

} // namespace physvib
