// SPDX-License-Identifier: MIT
// Counts in words: `--explain` promises these lines.
#include "Contacts/ContactCounts.h"
#include "Api/Godot/Explanation.h"
#include "Core/PhantomPanner.h"
#include "TestPlaces.h"
#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <regex>
#include <set>
#include <vector>

namespace physvib::contact_counts_test {

ContactCounts tenContacts() {
    ContactCounts counts;
    counts.contacts = 10;
    counts.steps = 20;
    counts.hasSources = true;
    counts.thresholdMetresPerSecond = 0.15;
    return counts;
}

void addEvent(ContactCounts& counts, double x, double y = 0.5) { counts.addEvents({1, x, y, x, y}); }

void expectSays(const std::string& text, const std::string& words) {
    EXPECT_NE(text.find(words), std::string::npos) << text;
}

TEST(ContactCounts, AreTheLinesThatArePromised) {
    ContactCounts counts = tenContacts();
    counts.belowThreshold = 3;
    counts.withoutSource = 2;
    counts.unplayable = 1;
    counts.muted = 4;
    counts.dropped = 5;
    counts.handedOn = 7;
    counts.events = 6;
    const std::string text = describe(counts);
    const std::string lines = "contacts 10\nbelow the threshold of 0.15 m/s: 3\nno haptic source: "
                              "2\nunplayable: 1\nmuted: 4\ndropped: 5\nhanded on by movable sources: "
                              "7\nevents: 6\n";
    ASSERT_GT(text.size(), lines.size());
    EXPECT_EQ(text.substr(text.size() - lines.size()), lines);
}

TEST(ContactCounts, NameTheMostFrequentReason) {
    const auto reason = [](std::uint64_t ContactCounts::*most) {
        ContactCounts counts = tenContacts();
        counts.belowThreshold = counts.unplayable = counts.muted = counts.dropped = 1;
        counts.*most = 7;
        return explain(counts);
    };
    expectSays(reason(&ContactCounts::belowThreshold), "slower than the threshold of 0.15 m/s");
    expectSays(reason(&ContactCounts::unplayable), "set frequency_hz and decay_per_s");
    expectSays(reason(&ContactCounts::muted), "muted");
    expectSays(reason(&ContactCounts::dropped), "left out");
    expectSays(reason(&ContactCounts::events), "7 events were made");
    expectSays(explain({}), "No step");
    ContactCounts unfelt = tenContacts();
    unfelt.hasSources = false;
    expectSays(explain(unfelt), "haptic source: set is_camera");
    expectSays(replaceNames(explain(unfelt), Names::cpp), "haptic source: set isCamera");
    expectSays(replaceNames(explain(unfelt), Names::scene), "haptic source: set camera");
    expectSays(replaceNames(explain(unfelt), Names::mixer), "with Select, tick 'haptic source' of");
}

TEST(ContactCounts, NameTheOptionOfTheCommandLine) {
    EXPECT_EQ(replaceNames("set field_width_m and field_height_m of the renderer", Names::scene),
              "set the field (--field) of the renderer");
    EXPECT_EQ(replaceNames("set field_width_m", Names::cpp), "set fieldWidthMetres");
}

TEST(ContactCounts, ExplainWhatCameSince) {
    ContactCounts ever = tenContacts(), since;
    addEvent(ever, 0.5, 0.5);
    EXPECT_EQ(explain(since, ever).find("Nothing was stepped since the last explanation; before: 1 event"),
              0u)
        << explain(since, ever);
    since.steps = 3;
    since.hasSources = true;
    since.longestStepSeconds = 0.01;
    EXPECT_EQ(explain(since, ever).find("No contact has begun in 3 steps"), 0u) << explain(since, ever);
    since.note(EngineNote::asleep, 4);
    since.note(EngineNote::asleep, 5);
    expectSays(explain(since, ever), "body 5 (and 1 other source) is asleep");
}

// A device that was opened without a field spans centimetres: what a world of metres makes lies outside.
TEST(ContactCounts, NameWhereEventsLieWhichTheFieldMustSpan) {
    ContactCounts counts = tenContacts(), other = tenContacts();
    counts.fieldWidthMetres = 20.0;
    addEvent(counts, 3.0, 0.5);
    addEvent(counts, 19.8, 0.25);
    expectSays(explain(counts), "2 events were made, at x 3 to 19.8 m, y 0.25 to 0.5 m: nothing is "
                                "wrong in this world. What plays it was not looked at: the field of the "
                                "renderer or device must span these places");
    other.fieldWidthMetres = 200.0;
    addEvent(other, -1.0, 9.0);
    EXPECT_EQ((counts += tenContacts()).events, 2u);
    counts += other;
    EXPECT_EQ(counts.events, 3u);
    expectSays(explain(counts), "at x -1 to 19.8 m, y 0.25 to 9 m");
    counts.events = ~std::uint64_t{0};
    counts.minX = counts.minY = -1.23456e-100;
    counts.maxX = counts.maxY = -1.23456e-101;
    EXPECT_LT(explain(counts).size(), 512u) << "as physvib.h promises";
}

// What lies a little outside is played by the actuators at the edge; a row plays whatever height.
TEST(ContactCounts, NameAFieldThatLeavesSomeOut) {
    const auto reason = [](const char* name, double toX, double toY) {
        ActuatorLayout layout;
        EXPECT_TRUE(layoutPreset(name, layout));
        const PhantomPanner panner{layout, PanningLaw::linear, 1.0, 1.0, 1.0};
        OutputFacts output;
        output.panner = &panner;
        ContactCounts counts = tenContacts();
        addEvent(counts, 0.2, 0.5);
        addEvent(counts, toX, toY);
        return outputReason(counts, output);
    };
    EXPECT_EQ(reason("phone4", 0.9, 0.5), "");
    EXPECT_EQ(reason("phone4", 1.5, 0.5), "") << "a phantom at the edge";
    EXPECT_EQ(reason("phone2", 0.9, 4.0), "") << "its row has no height";
    for (const auto& [toX, toY] : {std::pair{2.4, 0.5}, {-1.4, 0.5}, {0.9, 2.4}})
        expectSays(reason("phone4", toX, toY),
                   "Events lie outside the renderer's field of 1 x 1 m; they span");
    expectSays(reason("phone4", 2.4, 0.5), "x 0.2 to 2.4 m, y 0.5 to 0.5 m");
    expectSays(reason("phone2", 2.4, 0.5), "Events lie outside");
}

TEST(ContactCounts, OfTwoPeriodsAreSumsAndMaximaAndWhatHoldsNow) {
    using C = ContactCounts;
    constexpr std::array sums{&C::contacts,  &C::belowThreshold, &C::withoutSource, &C::unplayable,
                              &C::muted,     &C::settling,       &C::dropped,       &C::handedOn,
                              &C::steps,     &C::zeroSteps,      &C::outsideSteps,  &C::unknownBodies,
                              &C::immovable, &C::parting,        &C::motionless};
    constexpr std::array maxima{&C::longestStepSeconds, &C::strongestBelowMetresPerSecond,
                                &C::fastestPartingMetresPerSecond, &C::fastestApproachMetresPerSecond};
    constexpr std::array present{&C::thresholdMetresPerSecond, &C::gravityMetresPerSecond2,
                                 &C::configuredThresholdMetresPerSecond, &C::fieldWidthMetres};
    constexpr std::array states{&C::hasSources, &C::mayBePushed, &C::isMuted};
    for (const unsigned later : {1U, 1000U}) { // than the first, which has 30 and more: less and more
        ContactCounts both, second;
        for (unsigned i = 0; i < sums.size(); ++i) both.*sums[i] = 30 + i, second.*sums[i] = later * (i + 1);
        for (unsigned i = 0; i < 4; ++i) {
            both.*maxima[i] = both.*present[i] = 30 + i;
            second.*maxima[i] = second.*present[i] = later + i;
        }
        for (const auto state : states) both.*state = later == 1, second.*state = later != 1;
        both.unknownBody = 3, second.unknownBody = 4;
        both.note(EngineNote::sensor, 5), second.note(EngineNote::asleep, 6);
        both += second;
        for (unsigned i = 0; i < sums.size(); ++i) EXPECT_EQ(both.*sums[i], 30 + i + later * (i + 1)) << i;
        for (unsigned i = 0; i < 4; ++i) {
            EXPECT_EQ(both.*maxima[i], std::max(30U, later) + i) << i;
            EXPECT_EQ(both.*present[i], later + i) << i;
        }
        for (const auto state : states) EXPECT_EQ(both.*state, later != 1);
        EXPECT_EQ(both.notes[0].count, 0U);
        EXPECT_EQ(both.notes[3].body, 6);
        EXPECT_EQ(both.unknownBody, 4);
        EXPECT_EQ((both += {}).unknownBody, 4) << "the last there was";
    }
}

// Whatever the reason is, the addon for Godot explains it with names that Godot's inspector and manual have.

using Texts = std::set<std::string>;

std::string read(const std::filesystem::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

void collect(const std::string& text, const std::regex& pattern, Texts& all, int group = 0) {
    for (std::sregex_iterator each(text.begin(), text.end(), pattern), end; each != end; ++each)
        all.insert((*each)[group]);
}

Texts namesOf(const std::string& text) {
    static const std::regex name("[A-Za-z0-9]*(_[A-Za-z0-9]+)+");
    Texts all;
    collect(text, name, all);
    return all;
}

/// What is well, but for one thing.
template <class Change>
ContactCounts but(Change change) {
    ContactCounts counts = tenContacts();
    counts.longestStepSeconds = 0.01;
    counts.gravityMetresPerSecond2 = 9.81;
    counts.configuredThresholdMetresPerSecond = 0.15;
    counts.fieldWidthMetres = 1.0;
    change(counts);
    return counts;
}

std::vector<ContactCounts> allReasons() {
    using C = ContactCounts;
    return {
        but([](C& c) { c.steps = 0; }),
        but([](C& c) { c.steps = 0, c.outsideSteps = 1; }),
        but([](C& c) { c.contacts = 0, c.zeroSteps = c.steps; }),
        but([](C& c) { c.contacts = 0; }),
        but([](C& c) { c.contacts = 0, c.longestStepSeconds = 0.1; }),
        but([](C& c) { c.unknownBodies = 20; }),
        but([](C& c) { c.hasSources = false; }),
        but([](C& c) { c.withoutSource = c.contacts; }),
        but([](C&) {}),
        but([](C& c) { c.muted = 1; }),
        but([](C& c) { c.muted = 1, c.isMuted = true; }),
        but([](C& c) { c.settling = 1; }),
        but([](C& c) { c.unplayable = 1; }),
        but([](C& c) { c.dropped = 1; }),
        but([](C& c) { c.belowThreshold = 1; }),
        but([](C& c) { c.belowThreshold = 1, c.thresholdMetresPerSecond = 0.3; }),
        but([](C& c) { c.belowThreshold = 1, c.thresholdMetresPerSecond = 0.3, c.longestStepSeconds = 0.1; }),
        but([](C& c) { c.belowThreshold = c.immovable = 1; }),
        but([](C& c) { c.belowThreshold = c.motionless = 1; }),
        but([](C& c) { c.belowThreshold = c.parting = 1; }),
        but([](C& c) { c.belowThreshold = 1, c.gravityMetresPerSecond2 = 981.0; }),
        but([](C& c) { addEvent(c, 400.0); }),
        but([](C& c) { addEvent(c, 3.0); }),
        but([](C& c) { addEvent(c, 3.0), c.fieldWidthMetres = 2.0; }),
        but([](C& c) { addEvent(c, 0.5), c.longestStepSeconds = 0.1; }),
        but([](C& c) { addEvent(c, 0.5), c.fastestApproachMetresPerSecond = 100.0; }),
        but([](C& c) { addEvent(c, 0.5); }),
    };
}

TEST(GodotsWords, HaveNoNameOfC) {
    const std::filesystem::path root = PHYSVIB_SOURCE_DIR;
    Texts godots{"physics_ticks_per_second", "time_scale", "_physics_process"};
    for (const auto& file : std::filesystem::directory_iterator(root / "Source" / "Api" / "Godot" / "addons" /
                                                                "physvib" / "doc_classes"))
        collect(read(file.path()), std::regex("<member name=\"(\\w+)\""), godots, 1);
    ASSERT_GT(godots.size(), 20u);

    Texts said;
    OutputFacts outputs[3];
    outputs[1].isMissing = true;
    outputs[2].isSilent = true;
    for (const ContactCounts& reason : allReasons())
        for (const OutputFacts& output : outputs) {
            const std::string inC = explain(reason, reason, &output), inGodot = godot::translateForGodot(inC);
            said.merge(namesOf(inC));
            for (const std::string& name : namesOf(inGodot)) EXPECT_TRUE(godots.contains(name)) << inGodot;
            for (const char* word : {"haptic source", "renderer", "physvib", "layout"})
                EXPECT_EQ(inGodot.find(word), std::string::npos) << inGodot;
            if (inC.find("device") != inC.npos || inC.find("Silence") != inC.npos) EXPECT_NE(inC, inGodot);
        }

    // A reason that is new is fed here, too.
    Texts literals, names;
    collect(read(root / "Source" / "Contacts" / "Explain.cpp"), std::regex("\"[^\"\n]*\""), literals);
    for (const std::string& literal : literals) names.merge(namesOf(literal));
    ASSERT_GT(names.size(), 10u);
    for (const std::string& name : names) EXPECT_TRUE(said.contains(name)) << name;
}

} // namespace physvib::contact_counts_test
