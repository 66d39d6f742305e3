// SPDX-License-Identifier: GPL-3.0-or-later
// The CLAP entry, for builds that name the folder of clap/clap.h (Modules.cmake): PluginProcessor with
// parameter points and note expressions from the host's event list. It has no window.
#include "PluginProcessor.h"
#include <clap/clap.h>
#include <cmath>
#include <cstring>

namespace physvib {

namespace {

constexpr std::uint32_t channels = 4;

/// Runs JUCE's message loop while any instance exists, because hosts of CLAP do not.
class MessageThread final : public juce::Thread {
public:
    MessageThread()
        : Thread{"PhysVib messages"} {
        startThread();
        isReady_.wait(-1);
    }
    ~MessageThread() override {
        juce::MessageManager::getInstance()->stopDispatchLoop();
        stopThread(-1);
    }
    void run() override {
        juce::MessageManager::getInstance()->setCurrentThreadAsMessageThread();
        isReady_.signal();
        juce::MessageManager::getInstance()->runDispatchLoop();
    }

private:
    juce::WaitableEvent isReady_;
};

/// The events of a block, which hosts send in the order of frames. R, wait-free.
class ClapEvents final : public PointSource, public NoteSource {
public:
    ClapEvents(const clap_input_events_t* events, PluginProcessor& processor) noexcept
        : events_{events}
        , count_{events ? events->size(events) : 0}
        , processor_{processor} {
        processor.setPointSource(*this);
        processor.setNoteSource(*this);
    }

    bool next(std::size_t parameter, ParameterPoint& point) noexcept override {
        for (auto& index = nextIndex_[parameter]; index < count_;) {
            const auto* const event = get<clap_event_param_value_t>(index++, CLAP_EVENT_PARAM_VALUE);
            if (!event || event->param_id != parameter || !std::isfinite(event->value)) continue;
            point.frame = static_cast<int>(event->header.time);
            point.normal = processor_.parameter(static_cast<Parameter>(parameter))
                               .convertTo0to1(static_cast<float>(event->value));
            return true;
        }
        return false;
    }
    int lastPointFrame(std::size_t) noexcept override { return -1; }

    bool next(NoteEvent& note) noexcept override {
        while (nextNoteIndex_ < count_) {
            const auto index = nextNoteIndex_++;
            note = {};
            note.frame = static_cast<int>(events_->get(events_, index)->time);
            if (read(index, note)) return true;
        }
        return false;
    }

private:
    template <class Event>
    const Event* get(std::uint32_t index, std::uint16_t type) const noexcept {
        const auto* const header = events_->get(events_, index);
        return header->space_id == CLAP_CORE_EVENT_SPACE_ID && header->type == type
                   ? reinterpret_cast<const Event*>(header)
                   : nullptr;
    }
    bool read(std::uint32_t index, NoteEvent& note) const noexcept {
        if (const auto* const on = get<clap_event_note_t>(index, CLAP_EVENT_NOTE_ON))
            return readNoteOn(*on, 0x90, on->velocity > 0.0 ? std::min(on->velocity, 1.0) : 0.0, note);
        for (const std::uint16_t end : {CLAP_EVENT_NOTE_OFF, CLAP_EVENT_NOTE_CHOKE})
            if (const auto* const off = get<clap_event_note_t>(index, end)) return readNoteOff(*off, note);
        if (const auto* const midi = get<clap_event_midi_t>(index, CLAP_EVENT_MIDI)) {
            std::copy_n(midi->data, 3, note.midi.begin());
            return true;
        }
        const auto* const expression = get<clap_event_note_expression_t>(index, CLAP_EVENT_NOTE_EXPRESSION);
        return expression && readExpression(*expression, note);
    }
    static bool readNoteOn(const clap_event_note_t& from, int status, double velocity,
                           NoteEvent& note) noexcept {
        if (from.channel < 0 || from.channel > 15 || from.key < 0 || from.key > 127) return false;
        note.midi = {static_cast<std::uint8_t>(status | from.channel), static_cast<std::uint8_t>(from.key),
                     static_cast<std::uint8_t>(127.0 * velocity + 0.5)};
        note.id = from.note_id;
        return true;
    }
    static bool readNoteOff(const clap_event_note_t& from, NoteEvent& note) noexcept {
        note.kind = NoteEvent::Kind::off;
        readTarget(from, note);
        return true;
    }
    template <class From>
    static void readTarget(const From& from, NoteEvent& note) noexcept {
        note.id = from.note_id;
        note.channel = from.channel < 0 ? -1 : from.channel + 1;
        note.number = from.key;
    }
    static bool readExpression(const clap_event_note_expression_t& from, NoteEvent& note) noexcept {
        using enum NoteEvent::Kind;
        readTarget(from, note);
        note.value = from.value;
        switch (from.expression_id) {
        case CLAP_NOTE_EXPRESSION_VOLUME: note.kind = volume; return true;
        case CLAP_NOTE_EXPRESSION_PAN: note.kind = pan, note.value = 2.0 * from.value - 1.0; return true;
        case CLAP_NOTE_EXPRESSION_TUNING: note.kind = tuning; return true;
        case CLAP_NOTE_EXPRESSION_BRIGHTNESS: note.kind = brightness, note.value -= 0.5; return true;
        case CLAP_NOTE_EXPRESSION_PRESSURE: note.kind = pressure; return true;
        default: return false;
        }
    }
    const clap_input_events_t* const events_;
    const std::uint32_t count_;
    PluginProcessor& processor_;
    std::array<std::uint32_t, parameterCount> nextIndex_{};
    std::uint32_t nextNoteIndex_ = 0;
};

struct HostTransport final : juce::AudioPlayHead {
    const clap_event_transport_t* event = nullptr; // of this block
    double rateHz = 0.0;
    juce::Optional<PositionInfo> getPosition() const override {
        if (!event) return {};
        PositionInfo info;
        info.setIsPlaying((event->flags & CLAP_TRANSPORT_IS_PLAYING) != 0);
        if ((event->flags & CLAP_TRANSPORT_HAS_SECONDS_TIMELINE) != 0)
            info.setTimeInSamples(
                std::llround(static_cast<double>(event->song_pos_seconds) / CLAP_SECTIME_FACTOR * rateHz));
        if ((event->flags & CLAP_TRANSPORT_HAS_TEMPO) != 0) info.setBpm(event->tempo);
        if ((event->flags & CLAP_TRANSPORT_HAS_BEATS_TIMELINE) != 0)
            info.setPpqPosition(static_cast<double>(event->song_pos_beats) / CLAP_BEATTIME_FACTOR);
        return info;
    }
};

class Instance final : private juce::AudioProcessorListener {
public:
    explicit Instance(const clap_host_t* host)
        : host_{host} {
        clap.plugin_data = this;
        processor.setPlayHead(&transport);
        processor.addListener(this);
    }
    ~Instance() override { processor.removeListener(this); }

    clap_process_status process(const clap_process_t& block) noexcept {
        if (block.audio_outputs_count < 1 || !block.audio_outputs[0].data32 ||
            block.audio_outputs[0].channel_count < channels)
            return CLAP_PROCESS_ERROR;
        transport.event = block.transport;
        const ClapEvents events{block.in_events, processor};
        juce::AudioBuffer<float> buffer{block.audio_outputs[0].data32, static_cast<int>(channels),
                                        static_cast<int>(block.frames_count)};
        processor.processBlock(buffer, noMidi_);
        transport.event = nullptr;
        return CLAP_PROCESS_CONTINUE;
    }
    void notifyHost() { // on the host's main thread
        if (isRestartNeeded_.exchange(false)) host_->request_restart(host_);
        const auto* const parameters =
            static_cast<const clap_host_params_t*>(host_->get_extension(host_, CLAP_EXT_PARAMS));
        if (parameters) parameters->rescan(host_, CLAP_PARAM_RESCAN_VALUES);
    }

    juce::ScopedJuceInitialiser_GUI juce;
    juce::SharedResourcePointer<MessageThread> messages;
    HostTransport transport;
    PluginProcessor processor{"PhysVib", {BusPlan::Kind::oneBus, static_cast<int>(channels), false}};
    clap_plugin_t clap{};

private:
    void audioProcessorParameterChanged(juce::AudioProcessor*, int, float) override {
        host_->request_callback(host_);
    }
    void audioProcessorChanged(juce::AudioProcessor*, const ChangeDetails& details) override {
        if (details.latencyChanged) isRestartNeeded_ = true; // hosts read it while they activate
        host_->request_callback(host_);
    }
    const clap_host_t* const host_;
    std::atomic<bool> isRestartNeeded_{false};
    juce::MidiBuffer noMidi_;
};

Instance& instanceOf(const clap_plugin_t* plugin) noexcept {
    return *static_cast<Instance*>(plugin->plugin_data);
}
PluginProcessor& processorOf(const clap_plugin_t* plugin) noexcept { return instanceOf(plugin).processor; }
void write(char* to, std::size_t size, const juce::String& text) { text.copyToUTF8(to, size); }
bool isParameter(clap_id id) noexcept { return id < parameterCount; }

constexpr clap_plugin_params_t parameters{
    [](const clap_plugin_t*) { return static_cast<std::uint32_t>(parameterCount); },
    [](const clap_plugin_t* plugin, std::uint32_t index, clap_param_info_t* info) {
        if (!isParameter(index)) return false;
        const auto& parameter = processorOf(plugin).parameter(static_cast<Parameter>(index));
        const auto& range = parameter.getNormalisableRange();
        *info = {};
        info->id = index; // a parameter's place in the table never changes
        info->flags = CLAP_PARAM_IS_AUTOMATABLE;
        if (parameter.isBoolean()) info->flags |= CLAP_PARAM_IS_STEPPED;
        if (parameter.row().parameter == Parameter::bypass) info->flags |= CLAP_PARAM_IS_BYPASS;
        write(info->name, sizeof info->name, parameter.getName(CLAP_NAME_SIZE - 1));
        for (const auto& group : parameterGroups())
            if (std::ranges::find(group.parameters, parameter.row().parameter) != group.parameters.end())
                write(info->module, sizeof info->module, juce::String{group.name.data()});
        info->min_value = static_cast<double>(range.start);
        info->max_value = static_cast<double>(range.end);
        info->default_value = static_cast<double>(parameter.convertFrom0to1(parameter.getDefaultValue()));
        return true;
    },
    [](const clap_plugin_t* plugin, clap_id id, double* value) {
        if (!isParameter(id)) return false;
        const auto& parameter = processorOf(plugin).parameter(static_cast<Parameter>(id));
        *value = static_cast<double>(parameter.convertFrom0to1(parameter.getValue()));
        return true;
    },
    [](const clap_plugin_t* plugin, clap_id id, double value, char* text, std::uint32_t size) {
        if (!isParameter(id)) return false;
        const auto& parameter = processorOf(plugin).parameter(static_cast<Parameter>(id));
        write(text, size, parameter.getText(parameter.convertTo0to1(static_cast<float>(value)), 0));
        return true;
    },
    [](const clap_plugin_t* plugin, clap_id id, const char* text, double* value) {
        if (!isParameter(id)) return false;
        const auto& parameter = processorOf(plugin).parameter(static_cast<Parameter>(id));
        *value = static_cast<double>(
            parameter.convertFrom0to1(parameter.getValueForText(juce::String::fromUTF8(text))));
        return true;
    },
    [](const clap_plugin_t* plugin, const clap_input_events_t* in, const clap_output_events_t*) {
        auto& processor = processorOf(plugin);
        juce::AudioBuffer<float> noAudio;
        juce::MidiBuffer noMidi;
        ClapEvents events{in, processor};
        for (std::size_t p = 0; p < parameterCount; ++p)
            for (ParameterPoint point; events.next(p, point);)
                processor.parameter(static_cast<Parameter>(p)).setValue(static_cast<float>(point.normal));
        processor.processBlock(noAudio, noMidi); // an empty block handles notes
    }};

constexpr clap_plugin_state_t state{
    [](const clap_plugin_t* plugin, const clap_ostream_t* to) {
        juce::MemoryBlock chunk;
        processorOf(plugin).getStateInformation(chunk);
        for (std::size_t done = 0; done < chunk.getSize();) {
            const auto writtenBytes = to->write(to, chunk.begin() + done, chunk.getSize() - done);
            if (writtenBytes <= 0) return false;
            done += static_cast<std::size_t>(writtenBytes);
        }
        return true;
    },
    [](const clap_plugin_t* plugin, const clap_istream_t* from) {
        juce::MemoryBlock chunk;
        std::array<char, 4096> part{};
        std::int64_t read = 0;
        while ((read = from->read(from, part.data(), part.size())) > 0)
            chunk.append(part.data(), static_cast<std::size_t>(read));
        if (read < 0) return false;
        processorOf(plugin).setStateInformation(chunk.getData(), static_cast<int>(chunk.getSize()));
        return !processorOf(plugin).hasRefusedChunk();
    }};

constexpr clap_plugin_audio_ports_t audioPorts{
    [](const clap_plugin_t*, bool isInput) -> std::uint32_t { return isInput ? 0 : 1; },
    [](const clap_plugin_t*, std::uint32_t index, bool isInput, clap_audio_port_info_t* info) {
        if (index != 0 || isInput) return false;
        *info = {0, "Actuators", CLAP_AUDIO_PORT_IS_MAIN, channels, nullptr, CLAP_INVALID_ID};
        return true;
    }};

constexpr clap_plugin_note_ports_t notePorts{
    [](const clap_plugin_t*, bool isInput) -> std::uint32_t { return isInput ? 1 : 0; },
    [](const clap_plugin_t*, std::uint32_t index, bool isInput, clap_note_port_info_t* info) {
        if (index != 0 || !isInput) return false;
        *info = {0, CLAP_NOTE_DIALECT_CLAP | CLAP_NOTE_DIALECT_MIDI | CLAP_NOTE_DIALECT_MIDI_MPE,
                 CLAP_NOTE_DIALECT_CLAP, "Notes"};
        return true;
    }};

constexpr clap_plugin_latency_t latency{[](const clap_plugin_t* plugin) {
    return static_cast<std::uint32_t>(processorOf(plugin).getLatencySamples());
}};
constexpr clap_plugin_tail_t tail{[](const clap_plugin_t* plugin) -> std::uint32_t {
    const auto& processor = processorOf(plugin);
    const double frames = processor.getTailLengthSeconds() * processor.getSampleRate();
    return frames < INT32_MAX ? static_cast<std::uint32_t>(frames) : INT32_MAX; // an infinite tail
}};
constexpr clap_plugin_render_t renderMode{[](const clap_plugin_t*) { return false; },
                                          [](const clap_plugin_t* plugin, clap_plugin_render_mode mode) {
                                              processorOf(plugin).setNonRealtime(mode == CLAP_RENDER_OFFLINE);
                                              return true;
                                          }};

const void* extension(const clap_plugin_t*, const char* id) {
    struct Row {
        const char* id;
        const void* functions;
    };
    static constexpr std::array<Row, 7> rows{{{CLAP_EXT_PARAMS, &parameters},
                                              {CLAP_EXT_STATE, &state},
                                              {CLAP_EXT_AUDIO_PORTS, &audioPorts},
                                              {CLAP_EXT_NOTE_PORTS, &notePorts},
                                              {CLAP_EXT_LATENCY, &latency},
                                              {CLAP_EXT_TAIL, &tail},
                                              {CLAP_EXT_RENDER, &renderMode}}};
    for (const auto& row : rows)
        if (std::strcmp(row.id, id) == 0) return row.functions;
    return nullptr;
}

constexpr std::array<const char*, 3> features{CLAP_PLUGIN_FEATURE_INSTRUMENT, CLAP_PLUGIN_FEATURE_SYNTHESIZER,
                                              nullptr};
constexpr clap_plugin_descriptor_t descriptor{
    CLAP_VERSION_INIT,
    "org.physvib.PhysVib",
    "PhysVib",
    "PhysVib",
    "",
    "",
    "",
    PHYSVIB_VERSION,
    "Collisions one can feel: each channel drives a vibration module",
    features.data()};

const clap_plugin_t* create(const clap_plugin_factory_t*, const clap_host_t* host, const char* id) {
    if (!clap_version_is_compatible(host->clap_version) || std::strcmp(id, descriptor.id) != 0)
        return nullptr;
    auto* const created = new Instance{host};
    auto& clap = created->clap;
    clap.desc = &descriptor;
    clap.init = [](const clap_plugin_t*) { return true; };
    clap.destroy = [](const clap_plugin_t* plugin) { delete &instanceOf(plugin); };
    clap.activate = [](const clap_plugin_t* plugin, double rate, std::uint32_t, std::uint32_t maxFrames) {
        auto& instance = instanceOf(plugin);
        instance.transport.rateHz = rate;
        instance.processor.setRateAndBufferSizeDetails(rate, static_cast<int>(maxFrames));
        instance.processor.prepareToPlay(rate, static_cast<int>(maxFrames));
        return true;
    };
    clap.deactivate = [](const clap_plugin_t* plugin) { processorOf(plugin).releaseResources(); };
    clap.start_processing = [](const clap_plugin_t*) { return true; };
    clap.stop_processing = [](const clap_plugin_t*) {};
    clap.reset = [](const clap_plugin_t* plugin) { processorOf(plugin).silenceNextBlock(); };
    clap.process = [](const clap_plugin_t* plugin, const clap_process_t* block) {
        return instanceOf(plugin).process(*block);
    };
    clap.get_extension = extension;
    clap.on_main_thread = [](const clap_plugin_t* plugin) { instanceOf(plugin).notifyHost(); };
    return &clap;
}

constexpr clap_plugin_factory_t factory{
    [](const clap_plugin_factory_t*) -> std::uint32_t { return 1; },
    [](const clap_plugin_factory_t*, std::uint32_t index) { return index == 0 ? &descriptor : nullptr; },
    create};

} // namespace

} // namespace physvib

extern "C" const CLAP_EXPORT clap_plugin_entry_t clap_entry{
    CLAP_VERSION_INIT, [](const char*) { return true; }, [] {},
    [](const char* id) -> const void* {
        return std::strcmp(id, CLAP_PLUGIN_FACTORY_ID) == 0 ? &physvib::factory : nullptr;
    }};
