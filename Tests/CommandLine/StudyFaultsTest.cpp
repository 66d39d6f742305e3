// SPDX-License-Identifier: GPL-3.0-or-later
// Faults planted into the built-in protocols, one at a time: each is refused by `study run` and by `study
// check`, with place and expectation.
#include "Calls.h"

namespace physvib {
namespace {

struct PlantedFault {
    const char *protocol, *from, *to; ///< the first `from` becomes `to`
    const char* words;                ///< of the line that refuses it
};

constexpr PlantedFault plantedFaults[] = {
    {"phantom-grids", "\"sessions\": [", "\"sessions\": ", "mine.json: line "},
    {"phantom-grids", "\"repetitions\": 10", "\"repeats\": 10",
     "mine.json: sessions[1]: unknown field \"repeats\""},
    {"phantom-grids", "\"repetitions\": 10", "\"repetitions\": 0",
     "mine.json: sessions[1].repetitions: expected 1 to 1000, found 0"},
    {"phantom-grids", "\"repetitions\": 10", "\"task\": \"guess\"",
     "mine.json: sessions[1].task: expected one of explore, identify, locate"},
    {"phantom-grids", "\"RING-3x3\"", "\"PHONE-3x3\"",
     "mine.json: conditions: expected a name of its own for each"},
    {"phantom-grids", "\"layout\": \"ring4\"", "\"layout\": \"rings\"", "mine.json: condition RING-3x3: "},
    {"phantom-grids", "\"columns\": 3", "\"columns\": 3, \"level_g\": 5",
     "mine.json: condition PHONE-3x3, 1,1: "},
    {"phantom-grids", "\"repetitions\": 10", "\"task\": \"choose\"",
     "mine.json: sessions[1].alternatives: expected two or more, found 0"},
    {"patterns", "\"break_before_s\"", "\"task\": \"locate\", \"break_before_s\"",
     "mine.json: conditions[0].stimuli: expected a grid, which the task locate needs"},
    {"patterns", "\"enchanters\": 2", "\"enchanters\": 3",
     "mine.json: condition PHONE-2: expected as many enchanters as the layout has (2), found 3"},
    {"model-or-sound", "\"start_db\": -8", "\"start_db\": 8",
     "mine.json: sessions[0].adjustment: expected least_db <= start_db <= most_db"},
    {"model-or-sound", "\"levels_from\": \"matching\"", "\"levels_from\": \"matches\"",
     "mine.json: sessions[1].levels_from: expected an earlier session of the task adjust"},
    {"model-or-sound", "\"rubber-concrete\"", "\"glass-glass\"", "mine.json: condition drop: call: "},
    {"model-or-sound", "--seconds 4", "--seconds 4 --out x.wav", "mine.json: conditions[0].call: "},
    {"model-or-sound", "\"synthetic-1\"", "\"nobody.wav\"", "nobody.wav"},
    {"model-or-sound", "\"level_db\": -8", "\"level_db\": 8", "mine.json: condition drop, pair="},
    {"model-or-sound", "--method {alternative}", "--method {alternativ}", "mine.json: conditions[0].call: "},
    {"eight-methods", "--layout study1", "--layout phone1",
     "mine.json: condition box: call: --layout: expected the condition's own layout, study1, found phone1"},
    {"model-or-sound", "\"layout\": \"study1\"", "\"layout\": \"phone4\"",
     "mine.json: condition drop: call: --layout: expected the condition's own layout, phone4, found study1"},
    {"magnitudes", "\"stimuli\"", "\"layout\": \"phone1\", \"stimuli\"",
     "mine.json: condition PHONE: call: --layout: expected the condition's own layout, phone1, found phone4"},
    {"eight-methods", "\"least_s\": 10", "\"least_s\": -10", "mine.json: sessions[0].least_s: expected "},
    {"level-steps", "\"choose\"", "\"estimate\"", "mine.json: sessions[0]."},
};

class StudyFaults : public test::CommandLine {};

TEST_F(StudyFaults, EveryPlantedFaultIsRefusedWithItsPlaceBeforeAnythingIsAsked) {
    for (const PlantedFault& fault : plantedFaults) {
        std::string text = call(std::string{"study show "} + fault.protocol).out;
        const std::size_t at = text.find(fault.from);
        ASSERT_NE(at, std::string::npos) << fault.protocol << ": " << fault.from;
        write("mine.json", text.replace(at, std::string_view{fault.from}.size(), fault.to));
        refuses("study run mine.json --observer simulated --out rows", 1, fault.words, 1);
        const auto checked = call("study check mine.json");
        EXPECT_EQ(checked.exitCode, 1) << fault.from << " -> " << fault.to;
        std::string place = fault.words; // the check's page names the file once
        if (place.starts_with("mine.json: ")) place.erase(0, 11);
        EXPECT_NE((checked.out + checked.err).find(place), std::string::npos)
            << place << "\nsaid: " << checked.out.substr(0, 500) << checked.err;
    }
}

} // namespace
} // namespace physvib
