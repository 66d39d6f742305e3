// SPDX-License-Identifier: GPL-3.0-or-later
// The CLAP module in the least host there can be: ports, parameters, notes with expression, points, states,
// odd blocks. What it plays is compared with the processor's own samples, to the bit.
#include "Plugin/PluginTesting.h"
#include <clap/clap.h>
#include <cstring>
#include <dlfcn.h>

namespace physvib::clap_test {

using namespace test;

constexpr int block = 512;

class RawClap {
public:
    RawClap() {
        module_ = dlopen(PHYSVIB_PLUGINS "/PhysVib.clap", RTLD_NOW | RTLD_LOCAL);
        if (!module_) return;
        entry_ = static_cast<const clap_plugin_entry_t*>(dlsym(module_, "clap_entry"));
        entry_->init(PHYSVIB_PLUGINS "/PhysVib.clap");
        const auto* const factory =
            static_cast<const clap_plugin_factory_t*>(entry_->get_factory(CLAP_PLUGIN_FACTORY_ID));
        plugin = factory->create_plugin(factory, &host_, factory->get_plugin_descriptor(factory, 0)->id);
        plugin->init(plugin);
        params = get<clap_plugin_params_t>(CLAP_EXT_PARAMS);
        state_ = get<clap_plugin_state_t>(CLAP_EXT_STATE);
    }
    ~RawClap() {
        if (!module_) return;
        if (isActive_) plugin->deactivate(plugin);
        plugin->destroy(plugin);
        entry_->deinit();
        dlclose(module_);
    }
    template <class Extension>
    const Extension* get(const char* id) const {
        return static_cast<const Extension*>(plugin->get_extension(plugin, id));
    }
    void start(int most = block) {
        if (isActive_) plugin->deactivate(plugin);
        get<clap_plugin_render_t>(CLAP_EXT_RENDER)->set(plugin, CLAP_RENDER_OFFLINE);
        isActive_ = plugin->activate(plugin, 48000.0, 1, static_cast<std::uint32_t>(most)) &&
                    plugin->start_processing(plugin);
    }
    /// Blocks of so many frames, of which the first has the events that were added; [channel][frame].
    Samples play(int blocks, int frames = block) {
        Samples signal(4);
        for (int b = 0; b < blocks; ++b) {
            std::vector<std::vector<float>> out(4, std::vector<float>(static_cast<std::size_t>(frames)));
            std::array<float*, 4> pointers{out[0].data(), out[1].data(), out[2].data(), out[3].data()};
            clap_audio_buffer_t bus{pointers.data(), nullptr, 4, 0, 0};
            const auto in = inputs();
            clap_process_t process{};
            process.frames_count = static_cast<std::uint32_t>(frames);
            process.audio_outputs = &bus;
            process.audio_outputs_count = 1;
            process.in_events = &in;
            EXPECT_EQ(plugin->process(plugin, &process), CLAP_PROCESS_CONTINUE);
            for (std::size_t c = 0; c < 4; ++c)
                signal[c].insert(signal[c].end(), out[c].begin(), out[c].end());
            events_.clear();
        }
        return signal;
    }
    void flush() {
        const auto in = inputs();
        params->flush(plugin, &in, nullptr);
        events_.clear();
    }
    void note(std::uint16_t type, int id, int key, int frame = 0) {
        clap_event_note_t event{
            headerOf<clap_event_note_t>(type, frame), id, 0, 0, static_cast<int16_t>(key), 1.0};
        add(event);
    }
    void express(clap_note_expression kind, int id, double value, int frame = 0) {
        clap_event_note_expression_t event{
            headerOf<clap_event_note_expression_t>(CLAP_EVENT_NOTE_EXPRESSION, frame),
            kind,
            id,
            -1,
            -1,
            -1,
            value};
        add(event);
    }
    void set(Parameter which, double value, int frame = 0) {
        clap_event_param_value_t event{headerOf<clap_event_param_value_t>(CLAP_EVENT_PARAM_VALUE, frame),
                                       static_cast<clap_id>(which),
                                       nullptr,
                                       -1,
                                       -1,
                                       -1,
                                       -1,
                                       value};
        add(event);
    }
    double valueOf(Parameter which) const {
        double value = 0.0;
        EXPECT_TRUE(params->get_value(plugin, static_cast<clap_id>(which), &value));
        return value;
    }
    std::string save() const {
        std::string bytes;
        const clap_ostream_t to{&bytes, [](const clap_ostream_t* s, const void* from, std::uint64_t size) {
                                    const auto n = std::min<std::uint64_t>(size, 100); // as hosts may
                                    static_cast<std::string*>(s->ctx)->append(static_cast<const char*>(from),
                                                                              n);
                                    return static_cast<std::int64_t>(n);
                                }};
        EXPECT_TRUE(state_->save(plugin, &to));
        return bytes;
    }
    bool load(std::string bytes) const {
        const clap_istream_t from{&bytes, [](const clap_istream_t* s, void* to, std::uint64_t size) {
                                      auto& rest = *static_cast<std::string*>(s->ctx);
                                      const auto n = std::min<std::uint64_t>({size, rest.size(), 77});
                                      std::memcpy(to, rest.data(), n);
                                      rest.erase(0, n);
                                      return static_cast<std::int64_t>(n);
                                  }};
        return state_->load(plugin, &from);
    }
    bool isLoaded() const { return plugin && params && state_; }
    const clap_plugin_t* plugin = nullptr;
    const clap_plugin_params_t* params = nullptr;

private:
    template <class Event>
    static clap_event_header_t headerOf(std::uint16_t type, int frame) {
        return {sizeof(Event), static_cast<std::uint32_t>(frame), CLAP_CORE_EVENT_SPACE_ID, type, 0};
    }
    template <class Event>
    void add(const Event& event) {
        const auto* const from = reinterpret_cast<const std::byte*>(&event);
        events_.emplace_back(from, from + sizeof event);
    }
    clap_input_events_t inputs() {
        return {&events_,
                [](const clap_input_events_t* list) {
                    return static_cast<std::uint32_t>(static_cast<Events*>(list->ctx)->size());
                },
                [](const clap_input_events_t* list, std::uint32_t i) {
                    return reinterpret_cast<const clap_event_header_t*>(
                        (*static_cast<Events*>(list->ctx))[i].data());
                }};
    }
    using Events = std::vector<std::vector<std::byte>>;
    Events events_;
    clap_host_t host_{CLAP_VERSION_INIT,
                      nullptr,
                      "test",
                      "",
                      "",
                      "1",
                      [](const clap_host_t*, const char*) -> const void* { return nullptr; },
                      [](const clap_host_t*) {},
                      [](const clap_host_t*) {},
                      [](const clap_host_t*) {}};
    void* module_ = nullptr;
    const clap_plugin_entry_t* entry_ = nullptr;
    const clap_plugin_state_t* state_ = nullptr;
    bool isActive_ = false;
};

TEST(Clap, PortsAndParametersAreTold) {
    RawClap host;
    ASSERT_TRUE(host.isLoaded());
    clap_audio_port_info_t audio{};
    ASSERT_TRUE(
        host.get<clap_plugin_audio_ports_t>(CLAP_EXT_AUDIO_PORTS)->get(host.plugin, 0, false, &audio));
    EXPECT_EQ(audio.channel_count, 4u);
    clap_note_port_info_t notes{};
    ASSERT_TRUE(host.get<clap_plugin_note_ports_t>(CLAP_EXT_NOTE_PORTS)->get(host.plugin, 0, true, &notes));
    EXPECT_EQ(notes.preferred_dialect, std::uint32_t{CLAP_NOTE_DIALECT_CLAP});
    ASSERT_EQ(host.params->count(host.plugin), parameterCount);
    for (std::uint32_t i = 0; i < parameterCount; ++i) {
        clap_param_info_t info{};
        ASSERT_TRUE(host.params->get_info(host.plugin, i, &info));
        EXPECT_EQ(info.name, std::string{allParameters()[i].name});
        std::array<char, 64> text{};
        double back = -1e9;
        ASSERT_TRUE(host.params->value_to_text(host.plugin, i, info.default_value, text.data(), text.size()));
        ASSERT_TRUE(host.params->text_to_value(host.plugin, i, text.data(), &back));
        EXPECT_NEAR(back, info.default_value, 0.06) << info.name << ' ' << text.data();
    }
    clap_param_info_t info{};
    EXPECT_FALSE(host.params->get_info(host.plugin, parameterCount, &info));
}

TEST(Clap, NotesAndPointsAreTheProcessorsSamplesToTheBit) {
    RawClap host;
    ASSERT_TRUE(host.isLoaded());
    const auto text = pluginStateJson(shakenBox());
    ASSERT_TRUE(host.load(text));
    host.start();
    EXPECT_EQ(host.get<clap_plugin_latency_t>(CLAP_EXT_LATENCY)->get(host.plugin), 1999u)
        << "as in other formats";
    PluginProcessor own{"PhysVib", {}};
    restore(own, text);
    own.setNonRealtime(true);
    auto buffer = prepareBlocks(own, block);
    host.note(CLAP_EVENT_NOTE_ON, 1, 48, 100);
    host.set(Parameter::level, -6.0, 256);
    const auto signal = host.play(60);
    Samples expected(4);
    for (int part = 0; part < 120; ++part) { // the same level from the second half of the first block on
        auto midi = part == 0 ? oneNote(48, 127, 100) : juce::MidiBuffer{};
        if (part == 1)
            own.parameter(Parameter::level).setValue(own.parameter(Parameter::level).convertTo0to1(-6.0f));
        buffer.setSize(4, block / 2, false, false, true);
        own.processBlock(buffer, midi);
        append(expected, buffer);
    }
    EXPECT_TRUE(signal == expected);
    EXPECT_GT(peakOf(signal), 0.01f);
}

TEST(Clap, AStateIsWholeAndABadOneIsRefused) {
    RawClap one, other;
    ASSERT_TRUE(one.isLoaded() && other.isLoaded());
    one.set(Parameter::gravity, 2.5);
    one.set(Parameter::bypass, 1.0);
    one.flush();
    EXPECT_NEAR(one.valueOf(Parameter::gravity), 2.5, 1e-6);
    const auto bytes = one.save();
    ASSERT_TRUE(other.load(bytes));
    EXPECT_EQ(other.save(), bytes);
    EXPECT_NEAR(other.valueOf(Parameter::bypass), 1.0, 0.0);
    EXPECT_FALSE(other.load("{"));
}

TEST(Clap, ExpressionMovesOneNoteAndOddBlocksAreHeard) {
    RawClap host;
    ASSERT_TRUE(host.isLoaded());
    auto state = strikeAt(0, 4);
    state.layout = presetLayout("phone4");
    state.notes.clear();
    state.voice = {.pitch = NotePitch::note, .placement = NotePlacement::middle, .isHeld = true};
    ASSERT_TRUE(host.load(pluginStateJson(state)));
    host.start();
    host.note(CLAP_EVENT_NOTE_ON, 3, 57);
    const auto middle = host.play(20);
    EXPECT_GT(peakOf(middle), 0.001f);
    host.express(CLAP_NOTE_EXPRESSION_VOLUME, 4, 0.0);
    EXPECT_GT(peakOf(host.play(20)), 0.9f * peakOf(middle)) << "of another note";
    host.express(CLAP_NOTE_EXPRESSION_VOLUME, 3, 0.0);
    host.play(1, 1);
    host.play(20);
    EXPECT_LT(peakOf(host.play(20)), 1e-4f);
    host.express(CLAP_NOTE_EXPRESSION_VOLUME, -1, 1.0);
    host.play(20);
    EXPECT_GT(peakOf(host.play(20)), 0.001f);
    host.note(CLAP_EVENT_NOTE_OFF, -1, -1);
    host.flush();
    host.play(200);
    EXPECT_LT(peakOf(host.play(4)), 1e-4f) << "every note was let go, with no frame rendered";
    host.note(CLAP_EVENT_NOTE_ON, 5, 57);
    EXPECT_GT(peakOf(host.play(20)), 0.001f);
    host.plugin->reset(host.plugin);
    host.play(4);
    EXPECT_EQ(peakOf(host.play(20)), 0.0f);
}

} // namespace physvib::clap_test
