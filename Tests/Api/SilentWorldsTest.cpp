// SPDX-License-Identifier: MIT
// Worlds from which nothing is felt, each for one reason: the explanation names it, and what to change.
#include "Support/SizedEvents.h"
#include <array>
#include <functional>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace physvib::silent_worlds_test {

/// A floor (body 0), a ball of 2 kg above it (body 1) that is a haptic source, and a renderer with their
/// field. Nothing is wrong with them.
class Silent {
public:
    Silent() {
        contact.a = 1;
        contact.b = 0;
        contact.x_m = contact.y_m = 0.5;
        contact.normal_y = -1.0;
        contact.approach_m_per_s = 3.0;
        output.field_width_m = output.field_height_m = 1.0;
    }
    ~Silent() {
        physvib_world_free(world);
        physvib_renderer_free(renderer);
    }
    Silent(const Silent&) = delete;
    Silent& operator=(const Silent&) = delete;

    void set() { EXPECT_EQ(physvib_world_set_body(world, 1, &ball), PHYSVIB_OK) << physvib_error(); }
    void configure() { EXPECT_EQ(physvib_world_configure(world, &settings), PHYSVIB_OK); }

    /// A step without contacts, and one with the contact; the code of the contact.
    int hit(double seconds = 0.01, double gravity = 9.81) {
        step(seconds, gravity);
        physvib_world_begin_step(world, seconds, gravity);
        const int code = physvib_world_touch(world, &contact);
        physvib_world_end_step(world);
        return code;
    }
    void step(double seconds = 0.01, double gravity = 9.81) {
        physvib_world_begin_step(world, seconds, gravity);
        physvib_world_end_step(world);
    }

    void open() { renderer = test::rendererOf(output); }
    void noteAfterStep(int body, int what) {
        step();
        EXPECT_EQ(physvib_world_note(world, body, what), PHYSVIB_OK) << physvib_error();
    }
    void pull(int frames = 64) {
        std::vector<float> samples(static_cast<std::size_t>(frames) * 64);
        int channels = output.channels > 0 ? output.channels : output.layout.count;
        EXPECT_EQ(physvib_renderer_pull_interleaved(renderer, samples.data(), channels, frames), PHYSVIB_OK);
    }
    /// A hit that has been sent to the renderer, which is pulled.
    void play() {
        if (renderer == nullptr) open();
        pull();
        EXPECT_EQ(hit(), PHYSVIB_OK) << physvib_error();
        physvib_world_send(world, renderer, 0, 1);
        pull();
    }

    std::string explain() {
        std::array<char, 512> text{};
        const int length = renderer == nullptr
                               ? physvib_world_explain(world, text.data(), text.size())
                               : physvib_renderer_explain(renderer, world, text.data(), text.size());
        EXPECT_GT(length, 20) << physvib_error();
        EXPECT_LT(length, 512) << "as physvib.h promises";
        return text.data();
    }

    physvib_world world = test::worldOfABall();
    physvib_renderer renderer = nullptr;
    physvib_world_settings settings = test::begun(physvib_world_settings_init);
    physvib_body ball = test::feltBall();
    physvib_contact contact = test::touching();
    physvib_renderer_settings output = test::begun(physvib_renderer_settings_init);
};

using Make = std::function<void(Silent&)>;

struct Reason {
    const char* name;
    Make make;
    std::vector<std::string> says; // all of them
};

/// A hit after that change; and after one of the ball or the settings, or of an open renderer, which plays
/// it.
Make hit(void (*change)(Silent&)) {
    return [=](Silent& s) {
        change(s);
        s.hit();
    };
}
Make hitWithBall(void (*change)(Silent&)) {
    return [=](Silent& s) {
        change(s);
        s.set();
        s.hit();
    };
}
Make hitWithSettings(void (*change)(Silent&)) {
    return [=](Silent& s) {
        change(s);
        s.configure();
        s.hit();
    };
}
Make playedBy(void (*change)(Silent&)) {
    return [=](Silent& s) {
        s.open();
        change(s);
        s.play();
    };
}

const std::vector<Reason>& reasons() {
    static const std::vector<Reason> all{
        {"NeverStepped", [](Silent&) {}, {"No step has been made", "physvib_world_begin_step"}},
        {"OutsideAStep",
         [](Silent& s) { EXPECT_EQ(physvib_world_touch(s.world, &s.contact), PHYSVIB_ERROR_ORDER); },
         {"No step has begun when contacts are reported", "physvib_world_begin_step"}},
        {"StepOfZero", [](Silent& s) { s.step(0.0); }, {"Steps were 0 s long", "seconds"}},
        {"StepOfMilliseconds", [](Silent& s) { s.step(16.7); }, {"16.7 s long", "seconds, not milliseconds"}},
        {"NoContact", [](Silent& s) { s.step(); }, {"No contact has begun", "physvib_world_touch"}},
        {"NotTold",
         [](Silent& s) {
             s.contact.b = 7;
             EXPECT_EQ(s.hit(), PHYSVIB_ERROR_ARGUMENT);
         },
         {"does not know (7)", "physvib_world_set_body"}},
        {"NoSource",
         hitWithBall([](Silent& s) { s.ball.is_camera = 0; }),
         {"haptic source", "set is_camera"}},
        {"OthersTouch",
         [](Silent& s) {
             physvib_body other = s.ball;
             other.is_camera = 0;
             physvib_world_set_body(s.world, 2, &other);
             s.contact.a = 2;
             s.hit();
         },
         {"No body that touched is a haptic source", "set is_camera"}},
        {"Sensor",
         [](Silent& s) { s.noteAfterStep(1, PHYSVIB_NOTE_SENSOR); },
         {"body 1 is a sensor", "solid"}},
        {"Filtered",
         [](Silent& s) { s.noteAfterStep(1, PHYSVIB_NOTE_FILTERED); },
         {"body 1 is filtered", "mask"}},
        {"Disabled",
         [](Silent& s) { s.noteAfterStep(1, PHYSVIB_NOTE_DISABLED); },
         {"body 1 is disabled", "enable it"}},
        {"Asleep",
         [](Silent& s) {
             s.noteAfterStep(1, PHYSVIB_NOTE_ASLEEP);
             physvib_world_note(s.world, 0, PHYSVIB_NOTE_SENSOR); // no source: it does not count
         },
         {"body 1 is asleep", "wakes"}},
        {"BothMassesZero",
         hitWithBall([](Silent& s) {
             s.ball.mass_kg = 0.0;
             s.ball.static_mass_kg = 2.0;
         }),
         {"have a mass of 0", "set mass_kg"}},
        {"NormalReversed",
         hit([](Silent& s) {
             s.contact.approach_m_per_s = PHYSVIB_UNKNOWN;
             s.contact.normal_y = 1.0;
             physvib_world_move(s.world, 1, 0.5, 0.6, 0.0, -3.0, 0.0);
         }),
         {"part along the reported normal, at up to 3 m/s", "from a to b"}},
        {"NoSpeed",
         hit([](Silent& s) { s.contact.approach_m_per_s = PHYSVIB_UNKNOWN; }),
         {"without a speed", "approach_m_per_s or impulse_n_s", "physvib_world_move"}},
        {"BelowThreshold",
         hit([](Silent& s) { s.contact.approach_m_per_s = 0.08; }),
         {"slower than the threshold of 0.15 m/s", "the strongest impact had 0.08 m/s", "threshold_m_per_s"}},
        {"BelowThresholdOfTheStep",
         [](Silent& s) {
             s.contact.approach_m_per_s = 0.3;
             s.hit(0.05);
         },
         {"1.5 times what gravity adds in a step", "0.3 m/s", "shorter steps"}},
        {"PixelsOfGravity", [](Silent& s) { s.hit(0.02, 981.0); }, {"981 m/s^2", "pixels"}},
        {"PixelsOfGravityThatAreFelt",
         [](Silent& s) {
             s.contact.approach_m_per_s = 40.0;
             s.hit(0.02, 981.0);
         },
         {"under a gravity of 981 m/s^2", "pixels"}},
        {"Pixels",
         hit([](Silent& s) {
             s.contact.x_m = 400.0;
             s.contact.y_m = 300.0;
             s.contact.approach_m_per_s = 500.0;
         }),
         {"x 400 to 400 m", "pixels", "divide lengths"}},
        {"FastPixels",
         hit([](Silent& s) { s.contact.approach_m_per_s = 500.0; }),
         {"up to 500 m/s", "pixels"}},
        {"FieldNotSet",
         hit([](Silent& s) { s.contact.x_m = 3.0; }),
         {"x 3 to 3 m", "outside the field of 1 m, as it is at first", "set field_width_m"}},
        {"OutsideTheWorldsField",
         hitWithSettings([](Silent& s) {
             s.settings.field_width_m = 2.0;
             s.contact.x_m = 3.0;
         }),
         {"outside the field of 2 m", "set field_width_m"}},
        {"OutsideTheRenderersField",
         [](Silent& s) {
             s.settings.field_width_m = 12.0;
             s.configure();
             s.contact.x_m = 9.0;
             s.play();
         },
         {"outside the renderer's field of 1 x 1 m", "x 9 to 9 m", "field_width_m"}},
        {"RenderersFieldNotSet",
         [](Silent& s) {
             s.output.field_width_m = s.output.field_height_m = 0.0;
             s.play();
         },
         {"which is not set and so the layout's", "field_width_m"}},
        {"LayoutDoesNotCover",
         [](Silent& s) { // four in one corner of the extent
             for (int j = 0; j < 4; ++j) {
                 s.output.layout.x_m[j] = j % 2 == 0 ? 0.0 : 1.0e-3;
                 s.output.layout.y_m[j] = j < 2 ? 0.0 : 1.0e-3;
             }
             s.output.law = PHYSVIB_LAW_LINEAR;
             s.output.exponent = 40.0;
             s.play();
         },
         {"layout does not cover"}},
        {"WorldMuted",
         hitWithSettings([](Silent& s) { s.settings.is_muted = 1; }),
         {"muted", "set is_muted of the world to false"}},
        {"GainOfZero", hitWithBall([](Silent& s) { s.ball.gain = 0.0; }), {"gain of 0 of the haptic source"}},
        {"NoSound",
         hitWithBall([](Silent& s) { s.ball.frequency_hz = s.ball.decay_per_s = 0.0; }),
         {"have no sound", "set frequency_hz and decay_per_s"}},
        {"LevelOfZero",
         playedBy([](Silent& s) { physvib_renderer_set_level(s.renderer, 0, 0.0); }),
         {"level of the output is 0"}},
        {"LevelOfMinus60dB",
         playedBy([](Silent& s) { physvib_renderer_set_level(s.renderer, 0, 0.001); }),
         {"level of the output is -60 dB, which nobody feels"}},
        {"LevelLow",
         playedBy([](Silent& s) { physvib_renderer_set_level(s.renderer, 0, 0.01); }),
         {"level of the output is low, -40 dB"}},
        {"ChannelsMuted",
         playedBy([](Silent& s) {
             for (int j = 0; j < 3; ++j) physvib_renderer_set_mute(s.renderer, 0, j, 1);
             physvib_renderer_set_gain(s.renderer, 0, 3, 0.0);
         }),
         {"channels that play these places are muted", "gain is 0"}},
        {"SilenceHeld",
         playedBy([](Silent& s) { physvib_renderer_silence(s.renderer, 0, 10'000'000'000); }),
         {"Silence is held by physvib_renderer_silence"}},
        {"NeverPulled",
         [](Silent& s) {
             s.open();
             s.hit();
         },
         {"No device plays the events", "pulled"}},
        {"QueueFull",
         [](Silent& s) {
             s.open();
             s.pull();
             s.hit();
             auto event = test::sized<physvib_event>();
             event.frequency_hz = 200.0;
             event.decay_per_s = 30.0;
             while (physvib_renderer_strike(s.renderer, &event) == PHYSVIB_OK) {
             }
         },
         {"queue full"}},
        {"Late",
         [](Silent& s) {
             s.open();
             s.pull(48000);
             s.play();
         },
         {"1 event came late", "latency"}},
    };
    return all;
}

class SilentWorld : public testing::TestWithParam<Reason> {};

TEST_P(SilentWorld, IsExplained) {
    Silent silent;
    GetParam().make(silent);
    const std::string why = silent.explain();
    for (const std::string& said : GetParam().says) EXPECT_NE(why.find(said), std::string::npos) << why;
}
INSTANTIATE_TEST_SUITE_P(Each, SilentWorld, testing::ValuesIn(reasons()),
                         [](const auto& told) { return told.param.name; });

// Of a device that somebody else opened.
TEST(SilentWorlds, AreExplainedByTheFactsOfAnyOutput) {
    const auto why = [](const std::function<void(physvib_output_facts&)>& change) {
        Silent silent;
        silent.hit();
        auto facts = test::begun(physvib_output_facts_init);
        facts.renderer = &silent.output;
        change(facts);
        std::array<char, 512> text{};
        EXPECT_GT(physvib_world_explain_output(silent.world, &facts, text.data(), text.size()), 0)
            << physvib_error();
        return std::string(text.data());
    };
    EXPECT_EQ(why([](auto& facts) {
                  facts.is_missing = 1;
                  facts.trouble = "JACK:system: not found";
              }),
              "No device plays the events (JACK:system: not found): open one, or connect it again.");
    EXPECT_EQ(why([](auto& facts) {
                  facts.is_silent = 1;
                  facts.silent_by = "OSC";
              }),
              "Silence is held by OSC: end it where it was asked for.");
    EXPECT_EQ(
        why([](auto& facts) { facts.channels = 2; }),
        "The device has 2 channels, but the layout 4 actuators: choose a layout with as many, or another "
        "device.");
    EXPECT_NE(why([](auto& facts) { facts.rejected = 3; }).find("3 events cannot be played"),
              std::string::npos);
    EXPECT_NE(why([](auto& facts) { facts.trouble = "xruns"; }).find("reports: xruns"), std::string::npos);
    EXPECT_NE(why([](auto&) {}).find("1 event was made, at x 0.5 to 0.5 m"), std::string::npos);
}

TEST(SilentWorlds, AnOutputsCountsAreExplainedOnce) {
    for (const auto count : {&physvib_output_facts::late, &physvib_output_facts::dropped,
                             &physvib_output_facts::rejected, &physvib_output_facts::without_part}) {
        Silent silent;
        auto facts = test::begun(physvib_output_facts_init);
        facts.renderer = &silent.output;
        const auto says = [&](const char* what) {
            silent.hit();
            std::array<char, 512> text{};
            EXPECT_GT(physvib_world_explain_output(silent.world, &facts, text.data(), text.size()), 0);
            return std::string(text.data()).find(what) != std::string::npos;
        };
        facts.*count = 7;
        EXPECT_TRUE(says("7 events"));
        EXPECT_FALSE(says("7 events")) << "long ago";
        facts.*count = 9;
        EXPECT_TRUE(says("2 events")) << "since";
    }
}

TEST(SilentWorlds, AreExplainedByWhatIsSilentNow) {
    Silent silent;
    silent.play();
    EXPECT_NE(silent.explain().find("1 event was made"), std::string::npos);
    silent.settings.is_muted = 1;
    silent.configure();
    silent.hit();
    EXPECT_NE(silent.explain().find("is_muted"), std::string::npos);
    silent.settings.is_muted = 0;
    silent.configure();
    silent.ball.is_camera = 0;
    silent.set();
    silent.hit();
    EXPECT_NE(silent.explain().find("set is_camera"), std::string::npos);
    const std::string again = silent.explain();
    EXPECT_EQ(again.find("Nothing was stepped since the last explanation; before: 1 event was made"), 0U)
        << again;
    silent.ball.is_camera = 1;
    silent.set();
    silent.play();
    const std::string late = silent.explain();
    EXPECT_NE(late.find("1 event "), std::string::npos) << "since the last call: " << late;
    silent.step();
    EXPECT_EQ(silent.explain().find("No contact has begun in 1 step"), 0U);
}

TEST(SilentWorlds, RefuseWhatIsNoNote) {
    Silent silent;
    EXPECT_EQ(physvib_world_note(silent.world, 1, 9), PHYSVIB_ERROR_ARGUMENT);
    EXPECT_EQ(physvib_world_note(silent.world, 9, PHYSVIB_NOTE_SENSOR), PHYSVIB_ERROR_ARGUMENT);
    std::array<char, 8> text{};
    EXPECT_GT(physvib_world_explain(silent.world, text.data(), text.size()), 20);
    EXPECT_STREQ(text.data(), "No step");
    EXPECT_EQ(physvib_world_explain(silent.world, nullptr, 5), PHYSVIB_ERROR_ARGUMENT);
    EXPECT_EQ(physvib_renderer_explain(nullptr, silent.world, text.data(), text.size()),
              PHYSVIB_ERROR_HANDLE);
}

} // namespace physvib::silent_worlds_test
