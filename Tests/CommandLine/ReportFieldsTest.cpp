// SPDX-License-Identifier: GPL-3.0-or-later
// Every fact of the methods section comes from a field: each is planted into trials and looked for on the
// page, and is not there without it.
#include "Calls.h"
#include <sstream>

namespace physvib {
namespace {

class ReportFields : public test::CommandLine {
protected:
    /// Trials of so many simulated participants as if they were people's, felt with that apparatus.
    void plant(const std::string& protocol, int participants, const std::string& apparatus,
               const std::string& file = {}) const {
        ASSERT_EQ(call("study run " + (file.empty() ? protocol : file) +
                       " --observer simulated --participants " + std::to_string(participants))
                      .exitCode,
                  0);
        for (int number = 1; number <= participants; ++number) {
            const std::string name =
                protocol + (number < 10 ? "-P0" : "-P") + std::to_string(number) + ".csv";
            std::istringstream lines{read(name)};
            std::string text;
            for (std::string line; std::getline(lines, line);) {
                // limiter_db, master_db, noise_db, device, version, left, again
                if (line.ends_with(",,,,,,")) line.replace(line.size() - 6, 6, apparatus + ",1.0,1,0");
                for (std::size_t at = line.find("simulated"); at != std::string::npos;
                     at = line.find("simulated"))
                    line.replace(at, 9, "person");
                text += line + "\n";
            }
            write(name, text);
        }
    }
    std::string page(const std::string& call) const {
        std::filesystem::remove_all(folder_ / "out");
        const auto outcome = this->call(call);
        EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
        return read("out/index.html");
    }
    static bool has(const std::string& text, const std::string& what) {
        return text.find(what) != std::string::npos;
    }
};

TEST_F(ReportFields, EveryPlantedFieldHasItsSentence) {
    plant("phantom-grids", 4, "0,-3,-30,JACK:system");
    write("people.csv", "participant,age,sex,handedness,excluded,group\nP01,21,female,right,,a\nP02,25,male,"
                        "left,,b\nP03,26,female,right,,b\nP04,60,male,right,took off the headphones,a\n");
    const std::string call = "report phantom-grids-P01.csv phantom-grids-P02.csv phantom-grids-P03.csv "
                             "phantom-grids-P04.csv --out out";
    const std::string
        bare = page(call),
        whole = page(call +
                     " --people people.csv --ethics 'Approved by the board, no. 7.' --consent 'All signed.'");
    const auto cells = [](std::initializer_list<const char*> all) {
        std::string row;
        for (const std::string one : all)
            row += (one.find_first_not_of("0123456789.") == one.npos && !one.empty() ? "<td class=\"number\">"
                                                                                     : "<td>") +
                   one + "</td>";
        return row;
    };
    const std::string planted[] = {
        cells({"age, mean (years)", "24", "3"}),
        cells({"age, SD (years)", "2.6", "3"}),
        cells({"age, least (years)", "21", "3"}),
        cells({"age, most (years)", "26", "3"}),
        cells({"sex", "female", "2"}),
        cells({"handedness", "right", "2"}),
        cells({"group", "b", "2"}),
        cells({"participants who are not excluded", "", "3"}),
        cells({"took off the headphones", "all trials"}),
        cells({"ethics", "Approved by the board, no. 7.", ""}),
        cells({"consent", "All signed.", ""}),
    };
    for (const std::string& sentence : planted) {
        EXPECT_TRUE(has(whole, sentence)) << sentence << whole.substr(whole.find("<h2>Participants"), 2500);
        EXPECT_FALSE(has(bare, sentence)) << sentence;
    }
    EXPECT_TRUE(has(bare, cells({"ethics", "not stated", ""})) &&
                has(bare, cells({"consent", "not stated", ""})));
    EXPECT_FALSE(has(read("out/trials.csv"), "\nP04,")) << "excluded from every analysis";
    EXPECT_TRUE(has(read("out/participants.csv"), "excluded")) << read("out/participants.csv");
    EXPECT_TRUE(has(read("out/participants.csv"), ",,b\nP03")) << "which analysis.R compares";
    EXPECT_TRUE(has(read("out/orders.csv"), "P01,1,")) << read("out/orders.csv");
    EXPECT_TRUE(has(whole, "<th>place 6</th>"));
}

TEST_F(ReportFields, LevelsStandByStimulusAndPart) {
    ASSERT_EQ(call("study run model-or-sound --observer simulated").exitCode, 0);
    std::istringstream lines{read("model-or-sound-P01.csv")};
    std::string text;
    for (std::string line; std::getline(lines, line);) {
        // peak_g, rms_g, a8_m_per_s2
        if (line.ends_with(",,,,,,,,,,"))
            line.replace(line.size() - 10, 3,
                         line.find("height=3") < line.size() ? ",0.5|0.3,0.2|0.1," : ",0.4|0.3,0.2|0.1,");
        text += line + "\n";
    }
    write("model-or-sound-P01.csv", text);
    const std::string whole = page("report model-or-sound-P01.csv --out out"),
                      table = read("out/levels-by-stimulus.csv");
    EXPECT_TRUE(has(table, "drop,main,pair=wood-wood size=small height=3,AV-FV-DRV,peak_g,4,0.3,")) << table;
    EXPECT_TRUE(has(table, "drop,main,pair=wood-wood size=small height=1,SV,peak_g,4,0.3,"));
    EXPECT_TRUE(has(whole, "<li>study1: 2 g, assumed</li>"));
    EXPECT_FALSE(has(whole, "the peak of what was felt"));
}

TEST_F(ReportFields, PeopleOfOneNumberAreNamed) {
    for (const char* code : {"A", "B"})
        ASSERT_EQ(
            call(std::string{"study run magnitudes --observer simulated --number 1 --participant "} + code)
                .exitCode,
            0);
    ASSERT_EQ(call("study run magnitudes --observer simulated --number 2 --participant C").exitCode, 0);
    EXPECT_TRUE(has(page("report magnitudes-A.csv magnitudes-B.csv --out out"),
                    "participants A, B have the same number, 1"));
    EXPECT_FALSE(has(page("report magnitudes-A.csv magnitudes-C.csv --out out"), "have the same number"));
}

TEST_F(ReportFields, TheNoiseOfTheRoomIsToldWhereThereWasAny) {
    plant("level-steps", 1, "0,0,-30,JACK:system");
    EXPECT_TRUE(has(page("report level-steps-P01.csv --out out"), "noise at the ear</td><td>not stated"));
    const std::string told = page("report level-steps-P01.csv --out out --noise 'Pink, 62 dB(A).'");
    EXPECT_TRUE(has(told, "noise at the ear</td><td>Pink, 62 dB(A)."));
    std::string rows = read("level-steps-P01.csv");
    for (std::size_t at = rows.find(",-30,JACK"); at != std::string::npos; at = rows.find(",-30,JACK"))
        rows.replace(at, 9, ",off,JACK");
    write("level-steps-P01.csv", rows);
    refuses("report level-steps-P01.csv --out out --noise 'Pink, 62 dB(A).'", 1,
            "level-steps-P01.csv: --noise: expected trials with pink noise, found none", 2);
}

TEST_F(ReportFields, BadTablesOfPeopleAreOneLine) {
    plant("level-steps", 1, "0,0,off,none");
    const auto refusesPeople = [&](const std::string& people, const std::string& words) {
        write("people.csv", people);
        refuses("report level-steps-P01.csv --out out --people people.csv", 1, words, 2);
    };
    refusesPeople("participant,shoes\nP01,43\n", "people.csv: expected the columns participant, age, sex, "
                                                 "handedness, group, excluded, found \"shoes\"");
    refusesPeople("participant,age\nP01,old\n",
                  "people.csv:2: column age: expected years from 0 to 130, found \"old\"");
    refusesPeople("participant,age\nP01,20\nP01,21\n",
                  "people.csv:3: column participant: expected a code of its own for each participant");
    refusesPeople("age\n20\n", "people.csv: expected a column participant, found none");
    refusesPeople("participant,excluded\nP01,too late\n",
                  "expected a participant who is not excluded, found none");
}

} // namespace
} // namespace physvib
