// SPDX-License-Identifier: MIT
// Every argument of every call that a program makes in play counts, for itself alone; and a change of the
// renderer is what it says: from its time on, of its channel, by its factor, and nothing else.
#include "Support/SizedEvents.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <physvib/physvib.h>
#include <string>
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
