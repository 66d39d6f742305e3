// SPDX-License-Identifier: GPL-3.0-or-later
// Every sentence of the methods section comes from a field: each is planted into trials and looked for on the page, and is not there without it.
#include "Calls.h"
#include <sstream>

namespace physvib {
namespace {

class ReportFields : public test::CommandLine {
protected:
    /// Trials of so many simulated participants as if they were people's, felt with that apparatus.
    void plant(const std::string& protocol, int participants, const std::string& apparatus) const {
        ASSERT_EQ(call("study run " + protocol + " --observer simulated --participants " + std::to_string(participants)).exitCode, 0);
        for (int number = 1; number <= participants; ++number) {
            const std::string name = protocol + "-P0" + std::to_string(number) + ".csv";
            std::istringstream lines{read(name)};
            std::string text;
            for (std::string line; std::getline(lines, line);) {
                if (line.ends_with(",,,,")) line.replace(line.size() - 4, 4, apparatus + ",1.0"); // limiter_db, master_db, noise_db, device, version
                for (std::size_t at = line.find("simulated"); at != std::string::npos; at = line.find("simulated")) line.replace(at, 9, "person");
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
    static bool has(const std::string& text, const std::string& what) { return text.find(what) != std::string::npos; }
};

TEST_F(ReportFields, EveryPlantedFieldHasItsSentence) {
    plant("phantom-grids", 4, "0,-3,-30,JACK:system");
    write("people.csv", "participant,age,sex,handedness,excluded\nP01,21,female,right,\nP02,25,male,left,\nP03,26,female,right,\nP04,60,male,right,took off the headphones\n");
    const std::string call = "report phantom-grids-P01.csv phantom-grids-P02.csv phantom-grids-P03.csv phantom-grids-P04.csv --out out";
    const std::string bare = page(call), whole = page(call + " --people people.csv --ethics 'Approved by the board, no. 7.' --consent 'All signed.'");
    const std::string planted[] = {
        "Age: mean 24.0 years, standard deviation 2.6, 21 to 26 (3 of 3 known).",
        "Sex: 2 female, 1 male.",
        "Handedness: 1 left, 2 right.",
        "participant P04 is excluded, with all trials: took off the headphones",
        "Ethics: Approved by the board, no. 7.",
        "Consent: All signed.",
    };
    for (const std::string& sentence : planted) {
        EXPECT_TRUE(has(whole, sentence)) << sentence;
        EXPECT_FALSE(has(bare, sentence)) << sentence;
    }
    for (const char* missing : {"to be filled in: age, sex and handedness", "to be filled in: approval by an ethics board", "to be filled in: consent"}) {
        EXPECT_TRUE(has(bare, missing)) << missing;
        EXPECT_FALSE(has(whole, missing)) << missing;
    }
    EXPECT_FALSE(has(read("out/trials.csv"), "\nP04,")) << "excluded from every analysis";
    EXPECT_TRUE(has(read("out/participants.csv"), "excluded")) << read("out/participants.csv");
    EXPECT_TRUE(has(read("out/orders.csv"), "P01,1,")) << read("out/orders.csv");
    EXPECT_TRUE(has(whole, " of 30 successions of two conditions occurred."));
    EXPECT_TRUE(has(whole, "4.1.1: orders of all six conditions by Latin squares; here: "));
    EXPECT_TRUE(has(whole, "Assumptions: by Shapiro and Wilk&#39;s test") || has(whole, "Assumptions: by Shapiro and Wilk's test"));
    EXPECT_TRUE(has(whole, "Power of the design as it was run"));
    EXPECT_TRUE(has(whole, "with Bonferroni&#39;s correction for 15 pairs of conditions") || has(whole, "with Bonferroni's correction for 15 pairs of conditions"));
}

TEST_F(ReportFields, TheApparatusIsWhatTheRowsSay) {
    plant("level-steps", 1, "0.5,-3,-30,JACK:system");
    const std::string noisy = page("report level-steps-P01.csv --out out");
    EXPECT_TRUE(has(noisy, "trials were felt through the device JACK:system at a master level of -3 dB, with pink noise of -30 dB of full scale (root mean square); the limiter lowered "));
    EXPECT_TRUE(has(noisy, "of them, by at most 0.5 dB."));
    std::string rows = read("level-steps-P01.csv");
    for (std::size_t at = rows.find(",-30,JACK"); at != std::string::npos; at = rows.find(",-30,JACK")) rows.replace(at, 9, ",off,JACK");
    write("level-steps-P01.csv", rows);
    const std::string silent = page("report level-steps-P01.csv --out out");
    EXPECT_TRUE(has(silent, "-3 dB, without pink noise; the limiter lowered "));
    EXPECT_FALSE(has(silent, "with pink noise of")) << "the protocol asks for it, and nobody heard it";
}

TEST_F(ReportFields, ConditionsAreNamedInFull) {
    plant("eight-methods", 3, "0,0,off,JACK:system");
    const std::string html = page("report eight-methods-P01.csv eight-methods-P02.csv eight-methods-P03.csv --out out");
    EXPECT_TRUE(has(html, "AF-FV-DRF: amplitude fixed, frequency varied, decay fixed"));
    EXPECT_FALSE(has(html, "205 Hz, 1 g"));
    EXPECT_TRUE(has(html, "5.3.1: a decay ends where it has fallen to a tenth (Eq. 5.5); here: a decay rings out"));
}

TEST_F(ReportFields, BadTablesOfPeopleAreOneLine) {
    plant("level-steps", 1, "0,0,off,none");
    const auto refusesPeople = [&](const std::string& people, const std::string& words) {
        write("people.csv", people);
        refuses("report level-steps-P01.csv --out out --people people.csv", 1, words, 2);
    };
    refusesPeople("participant,shoes\nP01,43\n", "people.csv: expected the columns participant, age, sex, handedness, excluded, found \"shoes\"");
    refusesPeople("participant,age\nP01,old\n", "people.csv:2: column age: expected years from 0 to 130, found \"old\"");
    refusesPeople("participant,age\nP01,20\nP01,21\n", "people.csv:3: column participant: expected a code of its own for each participant");
    refusesPeople("age\n20\n", "people.csv: expected a column participant, found none");
    refusesPeople("participant,excluded\nP01,too late\n", "expected a participant who is not excluded, found none");
}

} // namespace
} // namespace physvib
