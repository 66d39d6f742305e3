// SPDX-License-Identifier: GPL-3.0-or-later
// Hosts that call faster or slower than time, in bursts, with pauses, in blocks of any size, and that call a
// bounce what is none or not what is one: it is the bounce to the bit, by the latency that was said at first.
#include "PluginEditor.h"
#include "PluginTesting.h"
#include <functional>

namespace physvib::paced_host_test {

using namespace test;

/// A host on a clock that the test moves: worlds are stepped every 5 ms of it, whatever the host asks for.
class PacedHost : public TestHost {
public:
    explicit PacedHost(const PluginState& state)
        : TestHost{state} {
        plugin->runs().useManualStepping();
    }
    PacedHost(const PluginState& state, int block)
        : PacedHost{state} {
        prepare(48000, block, false);
    }

    void wait(std::int64_t lengthNs) {
        for (const std::int64_t end = nowNs + lengthNs; nowNs < end;) {
            const std::int64_t next = std::min(end, (nowNs / tickNs + 1) * tickNs);
            nowNs = next;
            if (next % tickNs == 0) plugin->runs().tick();
        }
    }
    void waitFrames(std::int64_t frames) { wait(frames * 1'000'000'000 / 48000); }

    /// A second in real time, appended to `signal`.
    void playInTime(Samples& signal) {
        for (int done = 0; done < 48000; done += largest) play(largest, signal), waitFrames(largest);
    }

    RunsStatus status() { return plugin->runs().status(); }

    std::int64_t nowNs = 0;

private:
    static constexpr std::int64_t tickNs = 5'000'000;
};

/// The scene struck all the time, so that a block that is not the bounce's shows.
PluginState busy() {
    auto state = shakenBox();
    state.limiterEnabled = false;
    return state;
}

/// Notes that drop discs and push, beside those that strike.
PluginState playedWorld() {
    auto state = busy();
    state.notes = {{.note = 62, .kind = NoteKind::spawn, .material = 1, .atFullVelocity = {1.0, -2.0}},
                   {.note = 64,
                    .kind = NoteKind::push,
                    .object = state.scene.bodies.back().name,
                    .atFullVelocity = {0.2, 0.1}}};
    return state;
}

/// How a host calls, beside what it says of that.
struct Lie {
    const char* name;
    std::function<bool(int)> saysOffline; ///< in its i-th block
    std::function<int(int)> frames;       ///< of its i-th block
    std::function<double(int)> seconds;   ///< that pass on the clock after its i-th block, in block lengths
    std::int64_t pauseNs = 0;             ///< after every 50th block
};

std::vector<Lie> lies() {
    const auto never = [](int) { return false; };
    const auto always = [](int) { return true; };
    const auto steady = [](int) { return 512; };
    const auto any = [](int i) { return 1 + i * 7919 % 4096; };
    const auto paced = [](int) { return 1.0; };
    const auto atOnce = [](int) { return 0.0; };
    const auto inTurn = [](int i) { return i / 7 % 2 == 1; };
    return {{"calls a bounce live", never, steady, atOnce},
            {"calls live a bounce", always, steady, paced},
            {"cannot decide", inTurn, steady, paced},
            {"cannot decide, ahead of time", inTurn, steady, atOnce},
            {"goes a tenth faster", never, steady, [](int) { return 0.9; }},
            {"goes thirty times faster", never, steady, [](int) { return 1.0 / 30.0; }},
            {"goes three times slower", never, steady, [](int) { return 3.0; }},
            {"comes in bursts of 20", never, steady, [](int i) { return i % 20 == 19 ? 20.0 : 0.0; }},
            {"is half a second ahead", never, steady, [](int i) { return i < 47 ? 0.0 : 1.0; }},
            {"takes blocks of any size", never, any, paced},
            {"takes blocks of any size, ahead of time", never, any, atOnce},
            {"is silent now and then", never, steady, paced, 5'000'000'000},
            {"is silent now and then, ahead of time", never, steady, atOnce, 5'000'000'000},
            {"stutters", never, steady, [](int i) { return i % 30 == 0   ? 12.0
                                                           : i % 30 < 12 ? 0.0
                                                                         : 1.0; }}};
}

/// Keys, controllers and automation at frames of their own.
juce::MidiBuffer song(std::int64_t from, int frames) {
    juce::MidiBuffer midi;
    for (int n = 0; n < frames; ++n) {
        const auto at = from + n;
        const int key = static_cast<int>(at / 5003 % 3) * 2 + 60;
        if (at % 5003 == 17) midi.addEvent(juce::MidiMessage::noteOn(1, key, juce::uint8{110}), n);
        if (at % 5003 == 3000) midi.addEvent(juce::MidiMessage::noteOff(1, key), n);
        if (at % 6007 == 5) midi.addEvent(juce::MidiMessage::pitchWheel(1, static_cast<int>(at % 16384)), n);
        if (at % 2003 == 9)
            midi.addEvent(juce::MidiMessage::controllerEvent(1, 20, static_cast<int>(at / 2003 % 128)), n);
    }
    return midi;
}

constexpr std::int64_t length = 4 * 48000;

/// What is felt of that song, the told latency taken out.
template <class Host>
Samples feltOf(Host& host, const Lie& lie, bool isTight) {
    host.setNormal(Parameter::timing, isTight ? 1.0f : 0.0f);
    host.prepare(48000, 512, lie.saysOffline(0));
    const int latency = host.plugin->getLatencySamples();
    Samples signal(4);
    for (std::int64_t done = 0, i = 0; done < length + latency; ++i) {
        const int block = static_cast<int>(i), frames = lie.frames(block);
        host.plugin->setNonRealtime(lie.saysOffline(block));
        append(signal, host.block(frames, song(done, frames)));
        done += frames;
        if constexpr (std::is_same_v<Host, PacedHost>) {
            host.waitFrames(std::llround(lie.seconds(block) * frames));
            if (block % 50 == 49) host.wait(lie.pauseNs);
        }
    }
    signal = later(signal, latency);
    for (auto& c : signal) c.resize(length);
    const auto status = host.plugin->runs().status();
    EXPECT_EQ(host.plugin->runs().latencyFrames(), latency) << "as told at first";
    EXPECT_EQ(status.stalledNs, 0);
    EXPECT_EQ(status.late, 0u);
    return signal;
}

Samples bounceOf(const PluginState& state, bool isTight) {
    TestHost host{state};
    return feltOf(host, {"", [](int) { return true; }, [](int) { return 512; }, {}}, isTight);
}

void expectTheBounce(PluginState state, const char* what) {
    state.controllers = {{20, "strike_x"}};
    for (const bool isTight : {false, true}) {
        const auto bounce = bounceOf(state, isTight);
        EXPECT_GT(peakOf(bounce), 0.01f) << what;
        for (const auto& lie : lies()) {
            SCOPED_TRACE(std::string{what} + (isTight ? ", tight: " : ": ") + lie.name);
            PacedHost host{state};
            EXPECT_TRUE(feltOf(host, lie, isTight) == bounce);
        }
    }
}

TEST(LyingHost, AWorldIsTheBounce) { expectTheBounce(playedWorld(), "world"); }
TEST(LyingHost, NotesAreTheBounce) {
    for (const char* const name : {"Keys", "Drum kit", "MPE pad"}) expectTheBounce(presetNamed(name), name);
}
TEST(LyingHost, DirectNotesBesideAWorldAreTheBounce) {
    auto state = playedWorld();
    state.isDirect = true;
    PacedHost host{state};
    EXPECT_TRUE(feltOf(host, lies().front(), false) == bounceOf(state, false));
}

TEST(PacedHost, TheEditorSaysWhatIsFeltWhen) {
    PacedHost host{busy(), 512};
    const auto editor = openEditor<PluginEditor>(*host.plugin);
    editor->refresh();
    EXPECT_TRUE(editor->statusText().startsWith(
        "felt 41.6 ms after the contact: 20.7 ms block and thread + 20.0 ms two steps + 1.0 ms limiter"))
        << editor->statusText();
    auto direct = busy();
    direct.isDirect = true;
    ASSERT_TRUE(host.plugin->edit(direct));
    editor->refresh();
    EXPECT_TRUE(
        editor->statusText().endsWith("limiter, strikes 1.0 ms after the note (reported to the host)"))
        << editor->statusText();
    ASSERT_TRUE(host.plugin->edit(presetNamed("Keys")));
    editor->refresh();
    EXPECT_TRUE(editor->statusText().startsWith("felt 1.0 ms after the note: 1.0 ms limiter"))
        << editor->statusText();
}

// A thread that never comes costs nothing: the world is stepped where it is needed.
TEST(PacedHost, AThreadThatDoesNotComeIsReplacedByTheCall) {
    PacedHost host{busy(), 512};
    Samples signal = host.played(48000);
    EXPECT_EQ(host.status().stalledNs, 0);
    EXPECT_GT(host.status().blocksSteppedInRender, 20u);
    PacedHost paced{busy(), 512};
    paced.playInTime(signal);
    EXPECT_EQ(paced.status().blocksSteppedInRender, 0u) << "where the thread is in time";
}

// A machine that is busy elsewhere: the thread comes a hundred times too late, then in time again.
TEST(PacedHost, AThreadThatIsLateForLongChangesNoSampleAndIsBackAtOnce) {
    PacedHost host{busy(), 512};
    const int latency = host.plugin->getLatencySamples();
    Samples signal;
    host.playInTime(signal);
    EXPECT_EQ(host.status().blocksSteppedInRender, 0u);
    for (int b = 0; b < 500; ++b) {
        host.play(512, signal);
        if (b % 100 == 99) host.waitFrames(512);
    }
    const auto stepped = host.status().blocksSteppedInRender;
    EXPECT_GT(stepped, 100u) << "one block in four needs a step";
    host.waitFrames(512);
    host.playInTime(signal);
    EXPECT_EQ(host.status().blocksSteppedInRender, stepped) << "the thread does it again";
    EXPECT_EQ(host.status().stalledNs, 0);
    TestHost offline{busy(), 512};
    EXPECT_EQ(host.plugin->runs().latencyFrames(), latency);
    EXPECT_TRUE(later(signal, latency) ==
                later(offline.played(static_cast<std::int64_t>(signal[0].size())), latency));
}

/// A step takes many times longer than real time.
PluginState absurdlyHeavy() {
    auto state = heap(200);
    state.limiterEnabled = false;
    return state;
}

// However late the thread is and however long a step takes: the call owes no more than its own frames and L,
// since each call leaves the world at its end. The samples stay the bounce's, and people are told.
TEST(PacedHost, NoCallStepsMoreThanItsOwnFramesAndTheLatencyOfAWorldThatIsFarTooHeavy) {
    const auto frames = [](int i) { return i % 7 == 3 ? 2048 : i % 7 == 5 ? 33 : 512; };
    constexpr int calls = 50;
    for (const bool isTight : {false, true}) {
        PacedHost host{absurdlyHeavy()};
        host.setNormal(Parameter::timing, isTight ? 1.0f : 0.0f);
        host.prepare(48000, 2048, false);
        const auto editor = openEditor<PluginEditor>(*host.plugin);
        editor->refresh();
        const std::int64_t latency = host.plugin->runs().outputLatencyFrames(),
                           stepNs = 1'000'000'000 / host.plugin->state().stepsPerSecond;
        Samples signal, bounce;
        std::int64_t before = 0, all = 0, most = 0;
        for (int i = 0; i < calls; ++i) {
            host.play(frames(i), signal); // and the thread never comes
            const std::int64_t now = host.plugin->runs().session()->world().sceneNs(),
                               steps = (now - before) / stepNs;
            EXPECT_LE((steps - 1) * stepNs, (frames(i) + latency) * 1'000'000'000 / 48000) << i;
            before = now;
            all += steps;
            most = std::max(most, steps);
        }
        editor->refresh();
        const auto length = static_cast<std::int64_t>(signal[0].size());
        EXPECT_NEAR(static_cast<double>(all), static_cast<double>(length) / 480.0,
                    2.0 + static_cast<double>(latency) / 480.0);
        EXPECT_GT(most, 1);
        EXPECT_EQ(host.plugin->runs().outputLatencyFrames(), latency);
        if (!isTight) {
            EXPECT_GE(host.status().blocksSteppedInRender, static_cast<std::uint64_t>(calls / 7)); // the long
                                                                                                   // ones
            EXPECT_TRUE(editor->statusText().contains("the host waits for the world"))
                << editor->statusText();
        }
        TestHost offline{absurdlyHeavy()};
        offline.setNormal(Parameter::timing, isTight ? 1.0f : 0.0f);
        offline.prepare(48000, 2048);
        offline.play(length, bounce);
        EXPECT_TRUE(signal == bounce);
    }
}

} // namespace physvib::paced_host_test
