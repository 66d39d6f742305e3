// SPDX-License-Identifier: GPL-3.0-or-later
// The table of parameters: ids are promises, values survive both mappings, words are read back.
#include "HostParameter.h"
#include "MidiMap.h"
#include "TestPlaces.h"
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <set>

namespace physvib::parameters_test {

TEST(Parameters, IdsArePromises) { // a change here breaks every saved session of every host
    std::vector<std::string_view> ids;
    for (const auto& row : allParameters()) ids.push_back(row.id);
    const std::vector<std::string_view> promised{
        "level",    "law",      "exponent",       "gravity", "tilt",      "material",    "strike_level",
        "strike_x", "strike_y", "bypass",         "beats",   "music",     "music_sides", "timing",
        "decay",    "release",  "velocity_curve", "hold",    "placement", "bend_range",  "note_material"};
    EXPECT_EQ(ids, promised);
}

// Hosts keep what they automate from 0 to 1: a choice that moves becomes another one in every project. How
// choices can still be added: decision 34.
TEST(Parameters, PlacesOfChoicesArePromises) {
    struct Places {
        Parameter which;
        std::vector<std::string_view> words; // at 0, 1, 2, ...; empty: none of these
        double of;                           // that many make 1
    };
    for (const auto& [which, words, of] : std::initializer_list<Places>{
             {Parameter::law, {"linear", "log", "log-outer", "energy"}, 3.0},
             {Parameter::law, {"", "neighbours", "", "auto", "", "distance"}, 6.0},
             {Parameter::law, {"", "triangles"}, 12.0},
             {Parameter::material, {"as the scene", "1", "2", "3", "4", "5", "6", "7", "8"}, 8.0},
             {Parameter::bypass, {"off", "on"}, 1.0},
             {Parameter::hold, {"as the preset", "off", "on"}, 2.0},
             {Parameter::placement, {"as the preset", "octave", "actuators", "middle"}, 3.0},
             {Parameter::bendRange,
              {"as the preset", "moves the place", "1 semitone", "2 semitones", "5 semitones", "7 semitones",
               "12 semitones", "24 semitones", "48 semitones"},
              8.0}})
        for (int i = 0; const auto word : words)
            if (const int place = i++; !word.empty())
                EXPECT_DOUBLE_EQ(normalised(rowOf(which), valueFromText(rowOf(which), word)), place / of)
                    << word;
}

// Else a session of an older version would not sound as it did.
TEST(Parameters, TheInstrumentsKnobsBeginAsThePresetToTheBit) {
    for (const auto which : parameterTable::instrumentGroup) {
        const auto& row = rowOf(which);
        const HostParameter parameter{row};
        EXPECT_EQ(parameter.value(), row.choices.empty() ? 1.0 : 0.0) << row.id;
        EXPECT_EQ(denormalised(row, static_cast<float>(normalised(row, row.initial))), parameter.value());
    }
    EXPECT_EQ(noteKnobsFrom([](Parameter which) { return rowOf(which).initial; }), NoteKnobs{});
}

TEST(Parameters, EveryLawHasItsPlace) {
    const auto& row = rowOf(Parameter::law);
    for (const auto& one : panningLaws) {
        const double value = valueFromText(row, one.name);
        EXPECT_EQ(valueText(row, value), one.name);
        EXPECT_EQ(lawFromValue(denormalised(row, static_cast<float>(normalised(row, value)))), one.law)
            << one.name;
    }
}

TEST(Parameters, RowsAreInRangeAndNamed) {
    std::set<std::string_view> ids;
    for (const auto& row : allParameters()) {
        EXPECT_TRUE(ids.insert(row.id).second) << row.id;
        EXPECT_FALSE(row.name.empty() || row.help.empty()) << row.id;
        EXPECT_LT(row.minimum, row.maximum) << row.id;
        EXPECT_TRUE(row.initial >= row.minimum && row.initial <= row.maximum) << row.id;
        EXPECT_GE(row.version, 1) << row.id;
        if (!row.choices.empty())
            EXPECT_EQ(std::fmod(static_cast<double>(row.choices.size()) - 1, row.maximum - row.minimum), 0.0)
                << row.id;
    }
}

// VST3 asks for 8 letters, control surfaces show as few as 4.
TEST(Parameters, ShortNamesDiffer) {
    for (const int letters : {4, 6, 8, 128}) {
        std::set<juce::String> names;
        for (const auto& row : allParameters()) {
            const auto name = HostParameter{row}.getName(letters);
            EXPECT_TRUE(names.insert(name).second) << letters << ' ' << name;
            EXPECT_LE(name.length(), letters) << name;
        }
    }
    EXPECT_EQ(HostParameter{rowOf(Parameter::strikeX)}.getName(128), "Strike shift x");
}

TEST(Parameters, ValuesSurviveTheHostsScaleAndTheirText) {
    for (const auto& row : allParameters())
        for (int i = 0; i <= 8; ++i) {
            const double value = denormalised(row, i / 8.0);
            EXPECT_NEAR(denormalised(row, normalised(row, value)), value, 1e-9) << row.id;
            const auto text = valueText(row, value);
            if (row.choices.empty())
                EXPECT_NEAR(valueFromText(row, text), value, 0.051) << row.id << ' ' << text;
            else
                EXPECT_EQ(valueText(row, valueFromText(row, text)), text) << row.id;
        }
}

TEST(Parameters, OutOfRangeIsClampedAndNonsenseIsTheDefault) {
    const auto& level = rowOf(Parameter::level);
    EXPECT_EQ(normalised(level, 99), 1.0);
    EXPECT_EQ(denormalised(level, -3), level.minimum);
    EXPECT_EQ(valueFromText(level, "loud"), level.initial);
    EXPECT_EQ(valueFromText(level, "nan"), level.initial);
    EXPECT_EQ(valueFromText(rowOf(Parameter::law), "square"), 0.0);
    EXPECT_EQ(valueText(level, -60), "-inf dB");
    EXPECT_EQ(gainFromLevelDb(valueFromText(level, "-inf dB")), 0.0);
    EXPECT_EQ(gainFromLevelDb(0), 1.0);
}

TEST(Parameters, TheTableInTheDocsIsThisOne) {
    std::ifstream file{PHYSVIB_SOURCE_DIR "/Docs/plugin-reference.md"};
    const std::string docs{std::istreambuf_iterator<char>{file}, {}};
    for (const auto& row : allParameters()) {
        std::string range;
        for (const auto word : row.choices) range += (range.empty() ? "" : ", ") + std::string{word};
        if (&row == &rowOf(Parameter::law)) range = "a [law](panning.md#laws)"; // they stand there
        if (row.choices.empty()) range = valueText(row, row.minimum) + " to " + valueText(row, row.maximum);
        const auto line = "| `" + std::string{row.id} + "` | " + std::string{row.name} + " | " + range +
                          " (" + valueText(row, row.initial) + ") | " + std::string{row.help} + " |\n";
        EXPECT_NE(docs.find(line), std::string::npos) << line;
    }
}

} // namespace physvib::parameters_test
