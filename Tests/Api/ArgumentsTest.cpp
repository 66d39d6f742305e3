// SPDX-License-Identifier: MIT
// Every argument of every call that a program makes in play counts, for itself alone; and a change of the
// renderer is what it says: from its time on, of its channel, by its factor, and nothing else.
#include "Support/SizedEvents.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <gtest/gtest.h>
#include <physvib/physvib.h>
#include <string>
#include <tuple>
#include <unistd.h>
#include <vector>

namespace physvib::arguments_test {

constexpr int channels = 4, rate = 8000, frames = 4000;
constexpr physvib_int64 ms = 1'000'000;
using Channels = std::array<std::vector<float>, channels>;

physvib_renderer_settings plainSettings() {
    auto settings = test::begun(physvib_renderer_settings_init);
    settings.rate_hz = rate;
    settings.channels = channels;
    settings.limiter = 0;
    settings.field_width_m = 1.0;
    settings.field_height_m = 0.5;
    return settings;
}

physvib_event tone(physvib_int64 timeNs, double x, double y) {
    physvib_event event = test::hitAt(timeNs);
    event.frequency_hz = 150.0;
    event.decay_per_s = 1.0;
    event.x_m = x;
    event.y_m = y;
    return event;
}

/// What leaves such a renderer after `act`.
Channels pulled(const physvib_renderer_settings& settings, const std::function<void(physvib_renderer)>& act) {
    const physvib_renderer renderer = test::rendererOf(settings);
    act(renderer);
    Channels all;
    std::array<float*, channels> at{};
    for (std::size_t j = 0; j < channels; ++j) all[j].resize(frames), at[j] = all[j].data();
    EXPECT_EQ(physvib_renderer_pull(renderer, at.data(), channels, frames), PHYSVIB_OK);
    EXPECT_EQ(physvib_renderer_free(renderer), PHYSVIB_OK);
    return all;
}

/// A tone from the middle of the field, from 0 s on, and another at 0.3 s; `act` comes first.
Channels played(const std::function<void(physvib_renderer)>& act) {
    const physvib_renderer_settings settings = plainSettings();
    return pulled(settings, [&](physvib_renderer renderer) {
        act(renderer);
        for (const physvib_int64 at : {0 * ms, 300 * ms}) {
            const physvib_event event =
                tone(at, 0.4 * settings.field_width_m, 0.55 * settings.field_height_m);
            EXPECT_EQ(physvib_renderer_strike(renderer, &event), PHYSVIB_OK) << physvib_error();
        }
    });
}

TEST(Arguments, GainsMutesAndLevelsActFromTheirTimeOnTheirChannelByTheirFactor) {
    const Channels plain = played([](physvib_renderer) {});
    constexpr std::size_t slack = 100; // frames: the ramp, and a limiter that looks ahead
    for (const physvib_int64 at : {100 * ms, 250 * ms})
        for (const double gain : {0.25, 2.0})
            for (int channel = 0; channel <= channels; ++channel) { // the last: all, by the level
                const bool isLevel = channel == channels;
                const Channels changed = played([=](physvib_renderer r) {
                    const int code = isLevel ? physvib_renderer_set_level(r, at, gain)
                                             : physvib_renderer_set_gain(r, at, channel, gain);
                    EXPECT_EQ(code, PHYSVIB_OK) << physvib_error();
                });
                const Channels muted = isLevel ? plain : played([=](physvib_renderer r) {
                    EXPECT_EQ(physvib_renderer_set_mute(r, at, channel, 1), PHYSVIB_OK);
                });
                const auto from = static_cast<std::size_t>(at * rate / (1000 * ms));
                for (int j = 0; j < channels; ++j)
                    for (std::size_t n = 0; n < frames; ++n) {
                        if (n >= from && n < from + slack) continue;
                        const bool isChanged = n >= from && (isLevel || j == channel);
                        const auto k = static_cast<std::size_t>(j);
                        const auto factor = isChanged ? static_cast<float>(gain) : 1.0f;
                        ASSERT_NEAR(changed[k][n], factor * plain[k][n], 1e-5f)
                            << "channel " << channel << ", gain " << gain << ", heard of " << j << " at "
                            << n;
                        if (!isLevel) ASSERT_NEAR(muted[k][n], isChanged ? 0.0f : plain[k][n], 1e-5f);
                    }
            }
}

TEST(Arguments, SilencesAndLayoutsActBetweenTheirTimes) {
    const Channels plain = played([](physvib_renderer) {});
    const auto peak = [](const Channels& all, int from, int to) {
        float most = 0.0f;
        for (const auto& channel : all)
            for (int n = from; n < to; ++n)
                most = std::max(most, std::abs(channel[static_cast<std::size_t>(n)]));
        return most;
    };
    for (const physvib_int64 until : {150 * ms, 299 * ms, 301 * ms, 2000 * ms}) {
        const Channels silenced = played(
            [=](physvib_renderer r) { EXPECT_EQ(physvib_renderer_silence(r, 100 * ms, until), PHYSVIB_OK); });
        EXPECT_EQ(peak(silenced, 0, 790), peak(plain, 0, 790)) << until;
        EXPECT_LT(peak(silenced, 1000, 2390), 1e-3f) << until;
        EXPECT_EQ(peak(silenced, 2600, frames) > 0.01f, until <= 300 * ms) << until;
    }
    for (const physvib_int64 at : {100 * ms, 299 * ms, 300 * ms, 301 * ms}) {
        const Channels moved = played([=](physvib_renderer r) {
            physvib_renderer_settings settings = plainSettings();
            settings.field_width_m *= 4.0;
            EXPECT_EQ(physvib_renderer_set_layout(r, at, &settings), PHYSVIB_OK) << physvib_error();
        });
        float apart = 0.0f;
        for (std::size_t j = 0; j < channels; ++j)
            for (std::size_t n = 0; n < frames; ++n)
                apart = std::max(apart, std::abs(moved[j][n] - plain[j][n]));
        EXPECT_EQ(apart > 1e-3f, at <= 300 * ms) << at;
    }
}

TEST(Arguments, AFieldThatIsNotGivenIsTheLayouts) {
    const auto of = [](bool isGiven) {
        physvib_renderer_settings settings = plainSettings();
        settings.field_width_m = isGiven ? settings.layout.extent_width_m : 0.0;
        settings.field_height_m = isGiven ? settings.layout.extent_height_m : 0.0;
        EXPECT_NE(settings.layout.extent_width_m, settings.layout.extent_height_m);
        const physvib_event event =
            tone(0, 0.3 * settings.layout.extent_width_m, 0.3 * settings.layout.extent_height_m);
        return pulled(settings, [&](physvib_renderer renderer) {
            EXPECT_EQ(physvib_renderer_strike(renderer, &event), PHYSVIB_OK) << physvib_error();
        });
    };
    EXPECT_EQ(of(false), of(true));
}

TEST(Arguments, OfImpactsCountEachForItselfAlone) {
    const auto impact = [](double x, double y, double strength, const char* material) {
        return pulled(plainSettings(), [=](physvib_renderer r) {
            const int code = material == nullptr ? physvib_renderer_impact(r, x, y, strength)
                                                 : physvib_renderer_impact_of(r, material, x, y, strength);
            EXPECT_EQ(code, PHYSVIB_OK) << physvib_error();
        });
    };
    const physvib_renderer_settings s = plainSettings();
    const double x = 0.25 * s.field_width_m, y = 0.25 * s.field_height_m;
    const std::vector<const char*> materials{nullptr, "steel plate", "wooden board"};
    for (const char* material : materials) {
        const Channels plain = impact(x, y, 0.5, material);
        EXPECT_NE(plain, impact(2.0 * x, y, 0.5, material));
        EXPECT_NE(plain, impact(x, 2.0 * y, 0.5, material));
        EXPECT_NE(plain, impact(x, y, 0.75, material));
    }
    EXPECT_NE(impact(x, y, 0.5, "steel plate"), impact(x, y, 0.5, "wooden board"));
}

/// The call was refused, in one line that begins so.
void expectRefused(physvib_int64 code, const std::string& expected, int wanted = PHYSVIB_ERROR_ARGUMENT) {
    const std::string said = physvib_error();
    EXPECT_EQ(code, wanted) << expected;
    EXPECT_EQ(said.substr(0, expected.size()), expected);
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
}

const double nan = std::nan("");
const std::string noEvent = "event: expected 0 to 20000 Hz, a decay of 0 to 2000 per second or a duration, ",
                  noStructure = "structure: expected one, found NULL";

TEST(Arguments, OfFilesOutOfRangeAreNamedAndNothingIsWritten) {
    const auto path = (std::filesystem::temp_directory_path() / std::to_string(::getpid())).string();
    const char* const out = path.c_str();
    auto layout = test::begun(physvib_layout_init), phone = layout;
    ASSERT_EQ(physvib_layout_preset("phone4", &phone), PHYSVIB_OK);
    const std::string pair = "layout: expected a name and a place for it, found NULL",
                      text = "layout: expected a text and a place for it, found NULL",
                      file = "layout: expected a path and a place for it, found NULL",
                      triple = "layout: expected a path, a name and a layout, found NULL";
    expectRefused(physvib_layout_preset(nullptr, &layout), pair);
    expectRefused(physvib_layout_preset("phone4", nullptr), pair);
    expectRefused(physvib_layout_preset("phone0", &layout), "layout: expected phone1 to ");
    expectRefused(physvib_layout_load(nullptr, &layout), file);
    expectRefused(physvib_layout_load(out, nullptr), file);
    expectRefused(physvib_layout_parse("{}", nullptr), text);
    expectRefused(physvib_layout_save(nullptr, "a", &phone), triple);
    expectRefused(physvib_layout_save(out, nullptr, &phone), triple);
    expectRefused(physvib_layout_save(out, "a", nullptr), triple);
    expectRefused(physvib_layout_save(out, "a", &layout), "layout: expected 1 to 64 enchanters");
    expectRefused(physvib_layout_save(out, "a\nb", &phone),
                  "layout: name: expected text without control characters");
    expectRefused(physvib_layout_load((path + "\nb").c_str(), &layout),
                  path + "\\x0ab: ", PHYSVIB_ERROR_FILE);
    for (const char* name : {static_cast<const char*>(nullptr), ""}) {
        expectRefused(physvib_part(name), "part: expected a name");
        expectRefused(physvib_sound(name), "sound: expected a name");
    }
    const physvib_event hit = tone(0, 0.1, 0.1);
    auto place = hit;
    double width = 7.0;
    for (const auto& [from, to, capacity] : {std::tuple<const char*, physvib_event*, int>{nullptr, &place, 1},
                                             {"", nullptr, 1},
                                             {"", &place, -1}}) {
        expectRefused(physvib_events_load(from, to, capacity),
                      "events: expected a path and a place for them");
        expectRefused(physvib_events_parse(from, to, capacity),
                      "events: expected a text and a place for them");
    }
    const std::string field = "events: expected a list and places for its field, found NULL",
                      list = "events: expected a path and at least one event";
    expectRefused(physvib_events_load_field(out, &width, nullptr), field);
    expectRefused(physvib_events_parse_field(nullptr, &width, &width), field);
    expectRefused(physvib_events_save(nullptr, &hit, 1), list);
    expectRefused(physvib_events_save(out, nullptr, 1), list);
    expectRefused(physvib_events_save(out, &hit, 0), list);
    expectRefused(physvib_events_save(out, &hit, 10'000'001), "events: expected at most 10000000");
    expectRefused(physvib_events_save_field(out, &hit, 1, 0.0, 1.0),
                  "field: expected 0.001 to 1e6 m, or 0 and 0");
    const std::array late{tone(2, 0.1, 0.1), tone(1, 0.1, 0.1)};
    expectRefused(physvib_events_save(out, late.data(), 2), "events: expected in the order of their times");
    struct Change {
        std::string expected;
        void (*change)(physvib_event&);
    };
    for (const auto& [expected, change] :
         {Change{noEvent, [](physvib_event& e) { e.amplitude = nan; }},
          {noEvent, [](physvib_event& e) { e.time_ns = -1; }},
          {"kind: expected PHYSVIB_HIT, PHYSVIB_ROLL or PHYSVIB_SLIDE", [](physvib_event& e) { e.kind = 3; }},
          {"impulse, mass: expected numbers", [](physvib_event& e) { e.impulse_n_s = nan; }},
          {"impulse, mass: expected numbers", [](physvib_event& e) { e.mass_kg = HUGE_VAL; }},
          {"impulse, mass: expected numbers, a mass from 0", [](physvib_event& e) { e.mass_kg = -1.0; }},
          {"part: expected 0, or a number of physvib_part()", [](physvib_event& e) { e.part = -1; }}}) {
        physvib_event changed = hit;
        change(changed);
        expectRefused(physvib_events_save(out, &changed, 1), expected);
    }
    const std::array samples{0.0F, 0.0F, 0.0F, std::nanf("")};
    expectRefused(physvib_wav_save(nullptr, samples.data(), 1, 1, rate),
                  "sound: expected a path and samples, found NULL");
    for (const auto& [count, frameCount, hz] : {std::tuple<int, physvib_int64, int>{0, 1, rate},
                                                {65, 1, rate},
                                                {1, 0, rate},
                                                {1, physvib_int64{1} << 62, rate},
                                                {1, 1, 4999}})
        expectRefused(
            physvib_wav_save(out, samples.data(), count, frameCount, hz),
            "sound: expected 1 to 64 channels, 5000 to 192000 Hz, and a frame or more, of less than 4 GB");
    expectRefused(physvib_wav_save(out, samples.data(), 2, 2, rate),
                  "sound: expected finite samples, found NaN or infinity in frame 1 of channel 1");
    EXPECT_EQ(layout.count, 0);
    EXPECT_EQ(width, 7.0);
    EXPECT_EQ(test::wordsOf(place), test::wordsOf(hit));
    EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(Arguments, OfRenderersOutOfRangeAreNamedAndChangeNothing) {
    const physvib_event hit = tone(0, 0.1, 0.1);
    float sample = 7.0F;
    const auto plain = plainSettings();
    const std::string render = "render: expected events and a place for samples";
    expectRefused(physvib_render(nullptr, nullptr, 0, 0, nullptr), noStructure);
    expectRefused(physvib_render(&plain, &hit, -1, 1, &sample), render);
    expectRefused(physvib_render(&plain, nullptr, 1, 1, &sample), render);
    expectRefused(physvib_render(&plain, &hit, 1, -1, &sample), render);
    expectRefused(physvib_render(&plain, &hit, 1, 1, nullptr), render);
    EXPECT_EQ(sample, 7.0F);
    expectRefused(physvib_renderer_create(&plain, nullptr), "renderer: expected a place for it, found NULL");
    struct Change {
        const char* expected;
        void (*change)(physvib_renderer_settings&);
    };
    for (const auto& [expected, change] :
         {Change{"rate: expected 5000 to 192000 Hz", [](auto& s) { s.rate_hz = 4999; }},
          {"channels: expected 0, or as many as", [](auto& s) { s.channels = 3; }},
          {"channels: expected 0, or as many as", [](auto& s) { s.channels = 65; }},
          {"law: expected one of PHYSVIB_LAW_...", [](auto& s) { s.law = -1; }},
          {"law: expected one of PHYSVIB_LAW_...", [](auto& s) { s.law = PHYSVIB_LAW_TRIANGLES + 1; }},
          {"exponent: expected more than 0, to 1000", [](auto& s) { s.exponent = 0.0; }},
          {"exponent: expected more than 0, to 1000", [](auto& s) { s.exponent = nan; }},
          {"field: expected 0 to 10^9 m", [](auto& s) { s.field_width_m = -1.0; }},
          {"field: expected 0 to 10^9 m", [](auto& s) { s.field_height_m = nan; }},
          {"layout: expected 1 to 64 enchanters", [](auto& s) { s.layout.count = 65; }}}) {
        auto settings = plain;
        change(settings);
        physvib_renderer none = nullptr;
        expectRefused(physvib_renderer_create(&settings, &none), expected);
        EXPECT_EQ(none, nullptr);
    }
    for (const auto& [hz, block, steps, gap] :
         {std::tuple{4999, 1, 1, 0.0}, {rate, 8193, 1, 0.0}, {rate, 1, 0, 0.0}, {rate, 1, 1, nan}})
        expectRefused(physvib_play_out_ns(hz, block, steps, gap),
                      "play-out delay: expected 5000 to 192000 Hz, ");
    const auto refused = played([&](physvib_renderer r) {
        physvib_event never = hit;
        never.frequency_hz = 0.0;
        auto larger = plain;
        larger.channels = larger.layout.count = 5;
        constexpr physvib_int64 late = 100'000'000'000'000'001;
        const std::string time = "time: expected 0 to 10^17 ns", gain = "gain: expected 0 to 10000",
                          channel = "channel: expected one of the renderer";
        expectRefused(physvib_renderer_strike(r, nullptr), "event: expected one, found NULL");
        expectRefused(physvib_renderer_strike(r, &never), noEvent);
        expectRefused(physvib_renderer_set_gain(r, -1, 0, 0.0), time);
        expectRefused(physvib_renderer_set_mute(r, late, 0, 1), time);
        expectRefused(physvib_renderer_silence(r, -1, 1), time);
        expectRefused(physvib_renderer_silence(r, 0, late), time);
        expectRefused(physvib_renderer_set_gain(r, 0, -1, 0.0), channel);
        expectRefused(physvib_renderer_set_mute(r, 0, channels, 1), channel);
        for (const double value : {-0.1, 10001.0, nan})
            expectRefused(physvib_renderer_set_level(r, 0, value), gain);
        expectRefused(physvib_renderer_set_layout(r, 0, nullptr), noStructure);
        expectRefused(physvib_renderer_set_layout(r, 0, &larger),
                      "layout: expected at most as many enchanters as channels");
        expectRefused(physvib_renderer_get_status(r, nullptr), noStructure);
        expectRefused(physvib_renderer_impact(r, 0.0, 0.0, nan), "strength: expected 0 to 1");
        expectRefused(physvib_renderer_impact_of(r, "a\nb", 0.0, 0.0, 1.0),
                      "material: expected one that vibrates (");
    });
    EXPECT_EQ(refused, played([](physvib_renderer) {}));
}

TEST(Arguments, OfPadsOutOfRangeAreNamedAndChangeNothing) {
    const physvib_event hit = tone(0, 0.1, 0.1);
    physvib_pads pads = nullptr, none = nullptr;
    ASSERT_EQ(physvib_pads_create(1, 1.0, 1.0, nullptr, &pads), PHYSVIB_OK);
    physvib_motors motors{};
    ASSERT_EQ(physvib_pads_pull(pads, 10, &motors, 1), 1);
    const std::string field = "field: expected more than 0 m, to 10^9 m",
                      pad = "pad: expected one of those created, from 0 on",
                      room = "motors: expected a place for those of each pad";
    expectRefused(physvib_pads_create(1, 1.0, 1.0, nullptr, nullptr),
                  "pads: expected a place for them, found NULL");
    for (const int count : {0, 65})
        expectRefused(physvib_pads_create(count, 1.0, 1.0, nullptr, &none), "pads: expected 1 to 64");
    expectRefused(physvib_pads_create(1, 0.0, 1.0, nullptr, &none), field);
    expectRefused(physvib_pads_create(1, 1.0, nan, nullptr, &none), field);
    EXPECT_EQ(none, nullptr);
    expectRefused(physvib_pads_strike(pads, 1, &hit), pad);
    expectRefused(physvib_pads_strike(pads, 0, nullptr), "event: expected one, found NULL");
    expectRefused(physvib_pads_send(pads, -1, nullptr, 0, 1), pad);
    expectRefused(physvib_pads_send(pads, 0, nullptr, physvib_int64{1} << 62, 1),
                  "delay: expected at most 2.5 * 10^16 ns from 0");
    expectRefused(physvib_pads_pull(pads, 10, nullptr, 1), room);
    expectRefused(physvib_pads_pull(pads, 10, &motors, 0), room);
    expectRefused(physvib_pads_pull(pads, -1, &motors, 1), "time: expected 0 to 10^17 ns");
    expectRefused(physvib_pads_pull(pads, 9, &motors, 1), "time: expected none before the last pull's",
                  PHYSVIB_ERROR_ORDER);
    expectRefused(physvib_pads_set_level(pads, nan), "gain: expected 0 to 10000");
    EXPECT_EQ(physvib_pads_pull(pads, 10, &motors, 1), 1) << "as if nothing had been";
    EXPECT_EQ(motors.low + motors.high, 0.0);
    EXPECT_EQ(physvib_pads_free(pads), PHYSVIB_OK);
}

/// What a world gives of a ball that falls on a floor, by motions alone.
struct Fall {
    std::array<double, 3> centre{0.3, 0.2, 0.0}, before{0.1, -2.0, 0.2}, spin{0.5, 1.0, 3.0},
        after{0.05, 0.5, 0.1}, spinAfter{0.2, 0.4, 1.0};
    std::array<double, 6> inverse{2.0, 3.0, 4.0, 0.1, 0.2, 0.3};
    bool isInSpace = false;
    double seconds = 0.01, gravity = 9.81, massKg = 1.0;
    std::array<double, 3> pair{222.0, 22.0, 0.5};
    int surface = 3, other = 4;
    int atOnce = 1;
};

std::string heardOf(const Fall& fall) {
    const physvib_world world = test::worldOfABall();
    for (const int i : {0, 1}) {
        auto body = test::begun(physvib_body_init);
        body.frequency_hz = 100.0 + 50.0 * i;
        body.decay_per_s = 20.0;
        body.is_camera = i;
        body.mass_kg = i;
        body.inertia_kg_m2 = 0.1 * i;
        body.surface = 3 + i;
        EXPECT_EQ(physvib_world_set_body(world, i, &body), PHYSVIB_OK) << physvib_error();
    }
    EXPECT_EQ(physvib_world_pair(world, fall.surface, fall.other, fall.pair[0], fall.pair[1], fall.pair[2]),
              PHYSVIB_OK);
    EXPECT_EQ(physvib_world_set_mass(world, 1, fall.massKg), PHYSVIB_OK);
    std::vector<physvib_event> events(100, test::sized<physvib_event>());
    std::string words;
    const auto note = [&] {
        const physvib_int64 count = physvib_world_take(world, events.data(), 100, fall.atOnce);
        for (physvib_int64 i = 0; i < count; ++i) words += test::wordsOf(events[static_cast<std::size_t>(i)]);
        words += ";" + std::to_string(physvib_world_time_ns(world));
    };
    for (int step = 0; step < 4; ++step) {
        EXPECT_EQ(physvib_world_begin_step(world, fall.seconds, fall.gravity), PHYSVIB_OK);
        if (fall.isInSpace) {
            EXPECT_EQ(physvib_world_move_in_space(world, 1, fall.centre.data(), fall.before.data(),
                                                  fall.spin.data(), fall.inverse.data()),
                      PHYSVIB_OK);
            EXPECT_EQ(physvib_world_moved_in_space(world, 1, fall.after.data(), fall.spinAfter.data()),
                      PHYSVIB_OK);
        } else {
            EXPECT_EQ(physvib_world_move(world, 1, fall.centre[0], fall.centre[1], fall.before[0],
                                         fall.before[1], fall.spin[2]),
                      PHYSVIB_OK);
            EXPECT_EQ(physvib_world_moved(world, 1, fall.after[0], fall.after[1], fall.spinAfter[2]),
                      PHYSVIB_OK);
        }
        if (step > 0) {
            physvib_contact contact = test::touching();
            contact.x_m = 0.25;
            contact.y_m = 0.05;
            contact.z_m = 0.03;
            contact.normal_x = fall.isInSpace ? 0.48 : 0.6;
            contact.normal_y = fall.isInSpace ? 0.64 : 0.8;
            contact.normal_z = fall.isInSpace ? 0.6 : 0.0;
            EXPECT_EQ(physvib_world_touch(world, &contact), PHYSVIB_OK) << physvib_error();
        }
        EXPECT_EQ(physvib_world_end_step(world), PHYSVIB_OK);
        if (step >= 1) note();
    }
    EXPECT_EQ(physvib_world_free(world), PHYSVIB_OK);
    return words;
}

TEST(Arguments, OfAWorldsCallsCountEachForItselfAlone) {
    struct Row {
        const char* name;
        bool isInSpace;
        std::function<void(Fall&)> change;
    };
    std::vector<Row> rows;
    for (const bool isInSpace : {false, true})
        for (std::size_t axis = 0; axis < (isInSpace ? 3U : 2U); ++axis) {
            rows.push_back({"centre", isInSpace, [=](Fall& f) { f.centre[axis] += 0.03; }});
            rows.push_back({"velocity", isInSpace, [=](Fall& f) { f.before[axis] *= 1.5; }});
        }
    for (std::size_t axis = 0; axis < 3; ++axis) {
        rows.push_back({"spin", true, [=](Fall& f) { f.spin[axis] *= 2.0; }});
        rows.push_back({"inverse inertia", true, [=](Fall& f) { f.inverse[axis] *= 1.5; }});
        rows.push_back({"inverse inertia", true, [=](Fall& f) { f.inverse[3 + axis] *= -1.0; }});
    }
    for (const bool isInSpace : {false, true}) {
        rows.push_back({"spin", isInSpace, [](Fall& f) { f.spin[2] *= 2.0; }});
        rows.push_back({"mass", isInSpace, [](Fall& f) { f.massKg = 2.0; }});
        rows.push_back({"seconds", isInSpace, [](Fall& f) { f.seconds = 0.02; }});
        rows.push_back({"frequency of the pair", isInSpace, [](Fall& f) { f.pair[0] = 223.0; }});
        rows.push_back({"decay of the pair", isInSpace, [](Fall& f) { f.pair[1] = 23.0; }});
        rows.push_back({"gain of the pair", isInSpace, [](Fall& f) { f.pair[2] = 0.75; }});
        rows.push_back({"surface", isInSpace, [](Fall& f) { f.surface = 5; }});
        rows.push_back({"other surface", isInSpace, [](Fall& f) { f.other = 5; }});
        rows.push_back({"at once", isInSpace, [](Fall& f) { f.atOnce = 0; }});
    }
    for (const Row& row : rows) {
        Fall plain;
        plain.isInSpace = row.isInSpace;
        Fall changed = plain;
        row.change(changed);
        EXPECT_NE(heardOf(plain), heardOf(changed))
            << row.name << (row.isInSpace ? " in space" : "") << ": its change changes nothing";
    }
}

TEST(Arguments, OfPadsCountEachForItselfAlone) {
    struct Told {
        double width = 2.0, height = 2.0, x = 0.4, level = 1.0, amplitude = 0.4;
        const char* profile = nullptr;
        int pad = 0;
        physvib_int64 at = 300 * ms;
    };
    const auto heard = [](const Told& told) {
        physvib_pads pads = nullptr;
        EXPECT_EQ(physvib_pads_create(2, told.width, told.height, told.profile, &pads), PHYSVIB_OK)
            << physvib_error();
        physvib_event event = tone(told.at, told.x, 1.0);
        event.amplitude = told.amplitude;
        event.decay_per_s = 8.0;
        EXPECT_EQ(physvib_pads_set_level(pads, told.level), PHYSVIB_OK);
        EXPECT_EQ(physvib_pads_strike(pads, told.pad, &event), PHYSVIB_OK) << physvib_error();
        std::string words;
        for (physvib_int64 now = 0; now < 800 * ms; now += 16 * ms) {
            std::array<physvib_motors, 2> motors{};
            EXPECT_EQ(physvib_pads_pull(pads, now, motors.data(), 2), 2) << physvib_error();
            for (const physvib_motors& m : motors)
                words += std::to_string(m.low) + ' ' + std::to_string(m.high) + ' ';
        }
        EXPECT_EQ(physvib_pads_free(pads), PHYSVIB_OK);
        return words;
    };
    const std::string plain = heard({});
    EXPECT_NE(plain, heard({.width = 8.0}));
    EXPECT_NE(plain, heard({.x = 1.6}));
    EXPECT_NE(plain, heard({.level = 0.5}));
    EXPECT_NE(plain, heard({.level = 0.0}));
    EXPECT_NE(plain, heard({.amplitude = 0.8}));
    EXPECT_NE(plain, heard({.profile = "pad-xbox"}));
    EXPECT_NE(plain, heard({.pad = 1}));
    EXPECT_NE(plain, heard({.at = 400 * ms}));
}

/// What a controller has no room for is lost, and is not told as sent.
TEST(Arguments, OnlyWhatFitsIsToldAsSentToAPad) {
    physvib_pads pads = nullptr;
    ASSERT_EQ(physvib_pads_create(1, 1.0, 1.0, nullptr, &pads), PHYSVIB_OK);
    const physvib_event waits = tone(900 * ms, 0.5, 0.5);
    int room = 0;
    while (physvib_pads_strike(pads, 0, &waits) == PHYSVIB_OK) ++room;
    EXPECT_EQ(room, 256);
    const physvib_world world = test::worldOfABall();
    const auto hits = [&] {
        const physvib_contact contact = test::touching(1.0);
        EXPECT_EQ(test::step(world, &contact), PHYSVIB_OK);
        test::step(world);
    };
    hits();
    EXPECT_EQ(physvib_pads_send(pads, 0, world, 500 * ms, 1), 0) << "there is no room";
    EXPECT_EQ(physvib_pads_stop(pads), PHYSVIB_OK);
    hits();
    EXPECT_EQ(physvib_pads_send(pads, 0, world, 500 * ms, 1), 1);
    physvib_world_free(world);
    physvib_pads_free(pads);
}

} // namespace physvib::arguments_test
