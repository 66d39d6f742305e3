// SPDX-License-Identifier: MIT
// Every field of every structure that a program fills changes what comes out, for itself alone: one that is
// not read, or read from another field, fails here. A field that is new in the header and not in these tables
// fails as well.
#include "Support/SizedEvents.h"
#include "TestPlaces.h"
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <iterator>
#include <physvib/physvib.h>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace physvib::fields_test {

/// What a world is told: its settings, three bodies, and a contact in each of 30 steps.
struct Told {
    physvib_world_settings settings;
    std::array<physvib_body, 3> bodies; ///< a floor, a ball and a second ball
    physvib_contact contact;            ///< of floor and ball
    double fallMetresPerSecond = 0.0;   ///< of the ball, told by move; 0: no motions are told
    double afterMetresPerSecond = 0.0;  ///< the same after the solver, told by moved
    int steps = 30;
    int firstStep = 0; ///< of the contact
    bool removes = false;
    int pointIdLater = PHYSVIB_POINT_NONE; ///< of a second point from step 15 on
};

Told floorAndBalls() {
    Told told{test::begun(physvib_world_settings_init),
              {test::begun(physvib_body_init), test::feltBall(1.0), test::feltBall(2.0)},
              test::touching(0.6)};
    told.bodies[0].frequency_hz = 150.0;
    told.bodies[0].decay_per_s = 20.0;
    told.bodies[1].frequency_hz = 210.0;
    told.bodies[2].frequency_hz = 220.0;
    told.contact.x_m = 0.3;
    told.contact.y_m = 0.1;
    return told;
}

std::vector<physvib_event> eventsOf(const Told& told) {
    physvib_world world = nullptr;
    EXPECT_EQ(physvib_world_create(&told.settings, &world), PHYSVIB_OK) << physvib_error();
    for (int i = 0; i < 3; ++i)
        EXPECT_EQ(physvib_world_set_body(world, i, &told.bodies[static_cast<std::size_t>(i)]), PHYSVIB_OK)
            << physvib_error();
    EXPECT_EQ(physvib_world_pair(world, 3, 4, 333.0, 33.0, 1.0), PHYSVIB_OK);
    for (int step = 0; step < told.steps; ++step) {
        EXPECT_EQ(physvib_world_begin_step(world, 0.01, 9.81), PHYSVIB_OK);
        if (told.fallMetresPerSecond != 0.0) {
            physvib_world_move(world, 1, 0.35, 0.2, 0.0,
                               step == told.firstStep ? -told.fallMetresPerSecond : 0.0, 3.0);
            physvib_world_moved(world, 1, 0.0, step == told.firstStep ? told.afterMetresPerSecond : 0.0, 3.0);
        }
        if (step >= told.firstStep) {
            EXPECT_EQ(physvib_world_touch(world, &told.contact), PHYSVIB_OK) << physvib_error();
            if (told.pointIdLater != PHYSVIB_POINT_NONE && step >= 15) {
                physvib_contact other = told.contact;
                other.point_id =
                    told.contact.point_id == PHYSVIB_POINT_NONE ? PHYSVIB_POINT_NONE : told.pointIdLater;
                other.x_m += 0.2;
                EXPECT_EQ(physvib_world_touch(world, &other), PHYSVIB_OK) << physvib_error();
            }
        }
        EXPECT_EQ(physvib_world_end_step(world), PHYSVIB_OK);
    }
    if (told.removes) physvib_world_remove_body(world, 1);
    std::vector<physvib_event> events(5000, test::sized<physvib_event>());
    const physvib_int64 count = physvib_world_take(world, events.data(), 5000, 1);
    events.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
    EXPECT_EQ(physvib_world_free(world), PHYSVIB_OK);
    return events;
}

std::string heardOf(const Told& told) {
    std::string words;
    for (const physvib_event& event : eventsOf(told)) words += test::wordsOf(event);
    return words;
}

/// A field's name (more than one row may have it), the situation in which it counts, and its change.
struct Row {
    std::string field;
    std::function<void(Told&)> situation, change;
};

void plain(Told&) {}
void untold(Told& t) { // no impulse: what follows from speed
    t.contact.impulse_n_s = PHYSVIB_UNKNOWN;
    t.contact.approach_m_per_s = 2.0;
}
void overGrains(Told& t) {
    t.bodies[0].grain_m = 0.002;
    t.bodies[0].is_ridged = 1;
    t.bodies[1].grain_m = 0.003;
    t.bodies[1].is_ridged = 1;
    t.contact.approach_m_per_s = 0.0;
    t.contact.impulse_n_s = 0.1;
    t.contact.along_a_m_per_s = 0.4;
    t.contact.along_b_m_per_s = 0.3;
}
void falling(Told& t) {
    untold(t);
    t.contact.approach_m_per_s = PHYSVIB_UNKNOWN;
    t.fallMetresPerSecond = 2.0;
}
void soft(Told& t) {
    t.contact.impulse_n_s = 4.0;
    t.contact.approach_m_per_s = 1.0;
    t.contact.is_soft = PHYSVIB_SOFT;
}
void points(Told& t) {
    t.contact.point_id = 0;
    t.contact.approach_m_per_s = 1.0;
    t.pointIdLater = 1;
}

std::vector<Row> contactRows() {
    return {
        {"a", plain, [](Told& t) { t.contact.a = 2; }},
        {"b", plain, [](Told& t) { t.contact.b = 2; }},
        {"x_m", plain, [](Told& t) { t.contact.x_m = 0.4; }},
        {"y_m", plain, [](Told& t) { t.contact.y_m = 0.2; }},
        {"z_m", plain, [](Told& t) { t.contact.z_m = 0.2; }},
        {"normal_x", falling, [](Told& t) { t.contact.normal_x = 0.6, t.contact.normal_y = 0.8; }},
        {"normal_y", falling, [](Told& t) { t.contact.normal_y = -1.0; }},
        {"normal_z", falling, [](Told& t) { t.contact.normal_y = 0.8, t.contact.normal_z = 0.6; }},
        {"impulse_n_s", plain, [](Told& t) { t.contact.impulse_n_s = 0.7; }},
        {"tangential_n_s", plain, [](Told& t) { t.contact.tangential_n_s = 0.5; }},
        {"friction_x_n_s", plain, [](Told& t) { t.contact.friction_x_n_s = 0.5; }},
        {"friction_y_n_s", [](Told& t) { t.contact.normal_x = 1.0, t.contact.normal_y = 0.0; },
         [](Told& t) { t.contact.friction_y_n_s = 0.5; }},
        {"friction_z_n_s", plain, [](Told& t) { t.contact.friction_z_n_s = 0.5; }},
        {"approach_m_per_s", untold, [](Told& t) { t.contact.approach_m_per_s = 3.0; }},
        {"restitution", untold, [](Told& t) { t.contact.restitution = 0.5; }},
        {"effective_mass_kg", untold, [](Told& t) { t.contact.effective_mass_kg = 0.3; }},
        {"fraction", plain, [](Told& t) { t.contact.fraction = 0.75; }},
        {"gap_m", [](Told& t) { untold(t), t.firstStep = 10; }, [](Told& t) { t.contact.gap_m = -0.005; }},
        {"gap_fraction",
         [](Told& t) { untold(t), t.firstStep = 10, t.contact.gap_m = -0.005, t.contact.gap_fraction = 0.5; },
         [](Told& t) { t.contact.gap_fraction = 1.0; }},
        {"along_a_m_per_s", overGrains, [](Told& t) { t.contact.along_a_m_per_s = 0.5; }},
        {"along_b_m_per_s", overGrains, [](Told& t) { t.contact.along_b_m_per_s = 0.2; }},
        {"is_soft", [](Told& t) { soft(t), t.contact.is_soft = 0; },
         [](Told& t) { t.contact.is_soft = PHYSVIB_SOFT; }},
        {"is_soft", soft, [](Told& t) { t.contact.is_soft = PHYSVIB_SOFT_WHOLE; }},
        {"point_id", points, [](Told& t) { t.contact.point_id = PHYSVIB_POINT_NONE; }},
        {"point_id", points, [](Told& t) { t.pointIdLater = 0; }},
        {"is_impulse_of_pair", points, [](Told& t) { t.contact.is_impulse_of_pair = 1; }},
    };
}

template <int Body>
std::function<void(Told&)> on(void (*change)(physvib_body&)) {
    return [change](Told& t) { change(t.bodies[Body]); };
}

std::vector<Row> bodyRows() {
    return {
        {"is_camera", plain, on<1>([](physvib_body& b) { b.is_camera = 0; })},
        {"voice", plain, on<1>([](physvib_body& b) { b.voice = PHYSVIB_VOICE_OTHER; })},
        {"voice", on<1>([](physvib_body& b) { b.voice = PHYSVIB_VOICE_OTHER; }),
         on<1>([](physvib_body& b) { b.voice = PHYSVIB_VOICE_BOTH; })},
        {"surface", on<0>([](physvib_body& b) { b.surface = 3; }),
         on<1>([](physvib_body& b) { b.surface = 4; })},
        {"mass_kg", plain, on<1>([](physvib_body& b) { b.mass_kg = 1.5; })},
        {"inertia_kg_m2", falling, on<1>([](physvib_body& b) { b.inertia_kg_m2 = 0.01; })},
        {"gravity_scale", [](Told& t) { t.contact.impulse_n_s = 0.25; },
         on<1>([](physvib_body& b) { b.gravity_scale = 3.0; })},
        {"frequency_hz", plain, on<1>([](physvib_body& b) { b.frequency_hz = 300.0; })},
        {"decay_per_s", plain, on<1>([](physvib_body& b) { b.decay_per_s = 31.0; })},
        {"static_mass_kg",
         [](Told& t) {
             t.bodies[0].is_camera = 1;
             t.bodies[0].static_mass_kg = 1.0;
         },
         on<0>([](physvib_body& b) { b.static_mass_kg = 2.0; })},
        {"gain", plain, on<1>([](physvib_body& b) { b.gain = 0.5; })},
        {"hand_mass_kg", plain, on<1>([](physvib_body& b) { b.hand_mass_kg = 5.0; })},
        {"overtone_hz", plain,
         on<1>([](physvib_body& b) { b.overtone_hz[0] = 400.0, b.overtone_decay_per_s[0] = 10.0; })},
        {"overtone_hz", plain,
         on<1>([](physvib_body& b) { b.overtone_hz[2] = 400.0, b.overtone_decay_per_s[2] = 10.0; })},
        {"overtone_decay_per_s",
         on<1>([](physvib_body& b) { b.overtone_hz[1] = 400.0, b.overtone_decay_per_s[1] = 10.0; }),
         on<1>([](physvib_body& b) { b.overtone_decay_per_s[1] = 11.0; })},
        {"overtone_amplitude",
         on<1>([](physvib_body& b) { b.overtone_hz[1] = 400.0, b.overtone_decay_per_s[1] = 10.0; }),
         on<1>([](physvib_body& b) { b.overtone_amplitude[1] = 0.5; })},
        {"grain_m", overGrains, on<0>([](physvib_body& b) { b.grain_m = 0.004; })},
        {"roughness", overGrains, on<0>([](physvib_body& b) { b.roughness = 0.5; })},
        {"rolling", [](Told& t) { overGrains(t), t.contact.along_b_m_per_s = 0.4; },
         on<0>([](physvib_body& b) { b.rolling = 0.7; })},
        {"is_ridged", overGrains, on<0>([](physvib_body& b) { b.is_ridged = 0; })},
        {"part", plain, on<1>([](physvib_body& b) { b.part = physvib_part("thumb"); })},
    };
}

std::vector<Row> settingsRows() {
    return {
        {"is_muted", plain, [](Told& t) { t.settings.is_muted = 1; }},
        {"hits_per_step", plain, [](Told& t) { t.settings.hits_per_step = 0; }},
        {"at_body", [](Told& t) { t.fallMetresPerSecond = 1.0; }, [](Told& t) { t.settings.at_body = 1; }},
        {"drops_hits_of_removed", [](Told& t) { t.firstStep = 29, t.removes = true; },
         [](Told& t) { t.settings.drops_hits_of_removed = 1; }},
        {"field_width_m", plain, [](Told& t) { t.settings.field_width_m = 2.0; }},
        {"field_x_m", plain, [](Told& t) { t.settings.field_x_m = 0.1; }},
        {"field_y_m", plain, [](Told& t) { t.settings.field_y_m = 0.1; }},
        {"field_radians", plain, [](Told& t) { t.settings.field_radians = 0.5; }},
        {"normalisation_s_per_m", plain, [](Told& t) { t.settings.normalisation_s_per_m = 0.2; }},
        {"hand_mass_kg", plain, [](Told& t) { t.settings.hand_mass_kg = 9.0; }},
        {"drive_gain", plain, [](Told& t) { t.settings.drive_gain = 2.0; }},
        {"threshold_m_per_s", plain, [](Told& t) { t.settings.threshold_m_per_s = 2.0; }},
        {"full_scale_impulse_n_s", plain, [](Told& t) { t.settings.full_scale_impulse_n_s = 2.0; }},
        {"full_scale_impulse_n_s", plain,
         [](Told& t) { t.settings.full_scale_impulse_n_s = PHYSVIB_AUTOMATIC; }},
        {"settling_s", plain, [](Told& t) { t.settings.settling_s = 0.1; }},
    };
}

/// Names of the fields of a structure of physvib.h, in its order.
std::vector<std::string> fieldsOf(const std::string& structure) {
    std::ifstream file(PHYSVIB_SOURCE_DIR "/Source/Api/C/physvib.h");
    std::string text{std::istreambuf_iterator<char>(file), {}};
    for (std::size_t at = 0; (at = text.find("/*", at)) != std::string::npos;)
        text.erase(at, text.find("*/", at) + 2 - at);
    const std::size_t begin = text.find("typedef struct " + structure + " {");
    EXPECT_NE(begin, std::string::npos) << structure;
    std::string body = text.substr(begin, text.find('}', begin) - begin);
    std::vector<std::string> names;
    const std::regex declaration(R"((\w+)(?:\[\w+\])?;)");
    for (std::sregex_iterator it(body.begin(), body.end(), declaration), end; it != end; ++it)
        names.push_back((*it)[1]);
    return names;
}

/// Without `size`, spare room, and `others`, which their own test has.
template <class AnyRow>
void expectAllFieldsIn(const std::string& structure, const std::vector<AnyRow>& rows,
                       const std::set<std::string>& others = {}) {
    std::set<std::string> inTable;
    for (const AnyRow& row : rows) inTable.insert(row.field);
    for (const std::string& field : fieldsOf(structure))
        if (field != "size" && field != "unused" && !others.contains(field)) {
            EXPECT_TRUE(inTable.contains(field)) << structure << "." << field << ": in no row of this test";
        }
}

void expectEachCounts(const std::string& structure, const std::vector<Row>& rows,
                      const std::set<std::string>& others = {}) {
    expectAllFieldsIn(structure, rows, others);
    for (const Row& row : rows) {
        Told before = floorAndBalls();
        row.situation(before);
        Told after = before;
        row.change(after);
        EXPECT_NE(heardOf(before), heardOf(after))
            << structure << "." << row.field << ": its change changes nothing";
    }
}

TEST(Fields, EachOfAWorldsStructuresChangesWhatComesOut) {
    expectEachCounts("physvib_contact", contactRows());
    expectEachCounts("physvib_body", bodyRows(), {"device"}); // of physvib_world_device()
    expectEachCounts("physvib_world_settings", settingsRows());
}

/// A change alone may go the wrong way: where a place is follows from its definition.
TEST(Fields, AFieldThatIsMovedAndTurnedHasItsPlacesInItsOwnAxes) {
    Told told = floorAndBalls();
    told.settings.field_x_m = 0.1;
    told.settings.field_y_m = -0.2;
    told.settings.field_radians = 0.5; // counter-clockwise
    const std::vector<physvib_event> events = eventsOf(told);
    ASSERT_FALSE(events.empty());
    const double dx = told.contact.x_m - 0.1, dy = told.contact.y_m + 0.2;
    EXPECT_NEAR(events[0].x_m, std::cos(0.5) * dx + std::sin(0.5) * dy, 1.0e-6);
    EXPECT_NEAR(events[0].y_m, -std::sin(0.5) * dx + std::cos(0.5) * dy, 1.0e-6);
}

/// How fast grains pass is the speed along the surface that has them, whichever of the two it is.
TEST(Fields, SpeedsAlongTheTwoSurfacesAreEachOfTheirOwn) {
    for (const bool isFloors : {true, false}) {
        Told told = floorAndBalls();
        physvib_body& grained = told.bodies[isFloors ? 0 : 1];
        grained.grain_m = 0.002;
        grained.is_ridged = 1;
        told.contact.impulse_n_s = 0.1;
        told.contact.approach_m_per_s = 0.0;
        told.contact.along_a_m_per_s = isFloors ? 0.4 : 0.0;
        told.contact.along_b_m_per_s = isFloors ? 0.0 : 0.4;
        // 200 a second, of which the first step has none
        EXPECT_NEAR(static_cast<double>(eventsOf(told).size()), 0.29 * 200.0, 3.0)
            << (isFloors ? "floor" : "ball");
    }
}

std::string renderedOf(const physvib_renderer_settings& settings, const physvib_event& event) {
    const std::size_t channels =
        static_cast<std::size_t>(settings.channels > 0 ? settings.channels : settings.layout.count);
    std::vector<float> samples(channels * 4800);
    const int result = physvib_render(&settings, &event, 1, 4800, samples.data());
    std::string words = std::to_string(result) + " " + std::to_string(channels) + " " +
                        std::to_string(settings.rate_hz) + "\n";
    return words + std::string(reinterpret_cast<const char*>(samples.data()), samples.size() * sizeof(float));
}

struct RenderRow {
    std::string field;
    std::function<void(physvib_renderer_settings&, physvib_event&)> change;
};

void expectEachIsRendered(const std::string& structure, const std::set<std::string>& others,
                          const std::vector<RenderRow>& rows) {
    expectAllFieldsIn(structure, rows, others);
    for (const RenderRow& row : rows) {
        auto settings = test::begun(physvib_renderer_settings_init);
        settings.layout.part[1] = physvib_part("thumb");
        settings.exponent = 2.0; // with 1, what travels has a law of its own
        settings.law = PHYSVIB_LAW_ENERGY;
        physvib_event event = test::hitAt(1'000'000, 0.9);
        event.x_m = 0.01;
        event.y_m = 0.02;
        if (row.field == "kind") settings.exponent = 1.0, settings.law = PHYSVIB_LAW_LINEAR;
        if (row.field == "z_m" || row.field == "layout.z_m") {
            settings.law = PHYSVIB_LAW_DISTANCE;
            settings.layout.z_m[0] = 0.03;
        }
        if (row.field == "limiter") event.amplitude = 3.0;
        const std::string before = renderedOf(settings, event);
        row.change(settings, event);
        EXPECT_NE(before, renderedOf(settings, event))
            << structure << "." << row.field << ": its change changes nothing";
    }
}

TEST(Fields, EachOfAnEventIsRendered) {
    using S = physvib_renderer_settings;
    using E = physvib_event;
    // Impulse, mass, source, partner and sound are kept in lists; samples do not need them.
    expectEachIsRendered("physvib_event", {"impulse_n_s", "mass_kg", "fixture", "other", "sound"},
                         {{"time_ns", [](S&, E& e) { e.time_ns += 100'000; }},
                          {"duration_ns", [](S&, E& e) { e.duration_ns = 20'000'000; }},
                          {"frequency_hz", [](S&, E& e) { e.frequency_hz = 201.0; }},
                          {"decay_per_s", [](S&, E& e) { e.decay_per_s = 31.0; }},
                          {"amplitude", [](S&, E& e) { e.amplitude = 0.8; }},
                          {"x_m", [](S&, E& e) { e.x_m = 0.02; }},
                          {"y_m", [](S&, E& e) { e.y_m = 0.03; }},
                          {"z_m", [](S&, E& e) { e.z_m = 0.03; }},
                          {"kind", [](S&, E& e) { e.kind = PHYSVIB_ROLL; }},
                          {"part", [](S&, E& e) { e.part = physvib_part("thumb"); }}});
}

TEST(Fields, EachOfARenderersSettingsAndOfALayoutIsRendered) {
    using S = physvib_renderer_settings;
    using E = physvib_event;
    expectEachIsRendered("physvib_renderer_settings", {"layout"},
                         {{"rate_hz", [](S& s, E&) { s.rate_hz = 44100; }},
                          {"channels", [](S& s, E&) { s.channels = 6; }},
                          {"law", [](S& s, E&) { s.law = PHYSVIB_LAW_LOG; }},
                          {"limiter", [](S& s, E&) { s.limiter = 0; }},
                          {"exponent", [](S& s, E&) { s.exponent = 1.5; }},
                          {"field_width_m", [](S& s, E&) { s.field_width_m = 0.5; }},
                          {"field_height_m", [](S& s, E&) { s.field_height_m = 0.5; }}});
    expectEachIsRendered("physvib_layout", {},
                         {{"extent_width_m", [](S& s, E&) { s.layout.extent_width_m *= 2.0; }},
                          {"extent_height_m", [](S& s, E&) { s.layout.extent_height_m *= 2.0; }},
                          {"x_m", [](S& s, E&) { s.layout.x_m[0] += 0.01; }},
                          {"x_m", [](S& s, E&) { s.layout.x_m[3] -= 0.01; }},
                          {"y_m", [](S& s, E&) { s.layout.y_m[0] += 0.01; }},
                          {"z_m", [](S& s, E&) { s.law = PHYSVIB_LAW_DISTANCE, s.layout.z_m[0] = 0.05; }},
                          {"part", [](S& s, E& e) { s.layout.part[2] = e.part = physvib_part("thumb"); }},
                          {"count", [](S& s, E&) { s.layout.count = 2; }}});
}

TEST(Fields, WhatAListKeepsIsKept) {
    physvib_event event = test::hitAt(0);
    event.fixture = event.other = 0;
    const std::string path = testing::TempDir() + "physvib-fields.csv";
    const auto again = [&](const physvib_event& one) {
        EXPECT_EQ(physvib_events_save(path.c_str(), &one, 1), PHYSVIB_OK) << physvib_error();
        auto read = test::sized<physvib_event>();
        EXPECT_EQ(physvib_events_load(path.c_str(), &read, 1), 1) << physvib_error();
        return test::wordsOf(read);
    };
    const std::vector<void (*)(physvib_event&)> changes{
        [](physvib_event& e) { e.impulse_n_s = 0.25; },
        [](physvib_event& e) { e.mass_kg = 0.5; },
        [](physvib_event& e) { e.fixture = 7; },
        [](physvib_event& e) { e.other = 9; },
        [](physvib_event& e) { e.kind = PHYSVIB_SLIDE; },
        [](physvib_event& e) { e.z_m = 0.125; },
        [](physvib_event& e) { e.duration_ns = 1'000'000; },
        [](physvib_event& e) { e.time_ns = 17; },
        [](physvib_event& e) { e.part = physvib_part("left elbow"); }};
    for (std::size_t i = 0; i < changes.size(); ++i) {
        physvib_event one = event;
        changes[i](one);
        EXPECT_EQ(again(one), test::wordsOf(one)) << "change " << i;
    }
    std::remove(path.c_str());
}

} // namespace physvib::fields_test
