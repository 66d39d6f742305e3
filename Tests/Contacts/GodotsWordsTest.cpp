// SPDX-License-Identifier: MIT
// Whatever the reason is, the addon for Godot explains it with names that Godot's inspector and manual have.
#include "Api/Godot/Explanation.h"
#include "Contacts/ContactCounts.h"
#include "TestPlaces.h"
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <regex>
#include <set>
#include <vector>

namespace physvib {
namespace {

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
    ContactCounts counts;
    counts.contacts = 10;
    counts.steps = 20;
    counts.hasSources = true;
    counts.longestStepSeconds = 0.01;
    counts.gravityMetresPerSecond2 = 9.81;
    counts.thresholdMetresPerSecond = counts.wantedThreshold = 0.15;
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
        but([](C& c) {
            c.made({1, 400.0, 0.5, 400.0, 0.5});
        }),
        but([](C& c) {
            c.made({1, 3.0, 0.5, 3.0, 0.5});
        }),
        but([](C& c) {
            c.made({1, 3.0, 0.5, 3.0, 0.5}), c.fieldWidthMetres = 2.0;
        }),
        but([](C& c) {
            c.made({1, 0.5, 0.5, 0.5, 0.5}), c.longestStepSeconds = 0.1;
        }),
        but([](C& c) {
            c.made({1, 0.5, 0.5, 0.5, 0.5}), c.fastestApproach = 100.0;
        }),
        but([](C& c) {
            c.made({1, 0.5, 0.5, 0.5, 0.5});
        }),
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
            const std::string inC = explain(reason, reason, &output), inGodot = godot::inGodotsWords(inC);
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

} // namespace
} // namespace physvib
