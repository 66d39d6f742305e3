// SPDX-License-Identifier: GPL-3.0-or-later
// Every sentence of the methods section comes from a field: each is planted into trials and looked for on the
// page, and is not there without it.
#include "Calls.h"
#include "Lab/Files/ProtocolFile.h"
#include "Lab/Report/ProtocolWords.h"
#include <algorithm>
#include <regex>
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
    /// What stands on the page from there to there: paragraphs, notes and items of lists, as one reads them.
    static std::vector<std::string> sentencesOf(const std::string& html, const std::string& from,
                                                const std::string& to) {
        std::string part = html.substr(html.find(from), html.find(to) - html.find(from));
        for (const auto& [code, sign] : {std::pair{"&#39;", "'"},
                                         {"&quot;", "\""},
                                         {"&lt;", "<"},
                                         {"&gt;", ">"},
                                         {"&amp;", "&"},
                                         {"<br>\n", "</p><p>"}})
            for (std::size_t at = 0; (at = part.find(code, at)) != std::string::npos;
                 at += std::string_view{sign}.size())
                part.replace(at, std::string_view{code}.size(), sign);
        static const std::regex sentence{"<(?:p|li)(?: class=\"note\")?>([^\n]*?)</(?:p|li)>"};
        std::vector<std::string> found;
        for (std::sregex_iterator at{part.begin(), part.end(), sentence}, end; at != end; ++at)
            found.push_back((*at)[1]);
        return found;
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
    const std::string planted[] = {
        "Age: mean 24.0 years, standard deviation 2.6, 21 to 26 (3 of 3 known).",
        "Sex: 2 female, 1 male.",
        "Handedness: 1 left, 2 right.",
        "Groups: 1 a, 2 b.",
        "participant P04 is excluded, with all trials: took off the headphones",
        "Ethics: Approved by the board, no. 7.",
        "Consent: All signed.",
    };
    for (const std::string& sentence : planted) {
        EXPECT_TRUE(has(whole, sentence)) << sentence;
        EXPECT_FALSE(has(bare, sentence)) << sentence;
    }
    for (const char* missing : {"to be filled in: age, sex and handedness",
                                "to be filled in: approval by an ethics board", "to be filled in: consent"}) {
        EXPECT_TRUE(has(bare, missing)) << missing;
        EXPECT_FALSE(has(whole, missing)) << missing;
    }
    EXPECT_FALSE(has(read("out/trials.csv"), "\nP04,")) << "excluded from every analysis";
    EXPECT_TRUE(has(read("out/participants.csv"), "excluded")) << read("out/participants.csv");
    EXPECT_TRUE(has(read("out/participants.csv"), ",,b\nP03")) << "which analysis.R compares";
    EXPECT_TRUE(has(read("out/orders.csv"), "P01,1,")) << read("out/orders.csv");
    EXPECT_TRUE(has(whole, " of 30 successions of two conditions occurred."));
    EXPECT_TRUE(has(whole, "4.1.1: orders of all six conditions by Latin squares; here: "));
}

TEST_F(ReportFields, LevelsStandByStimulusAndPartAndAreToldAsAssumed) {
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
    EXPECT_TRUE(has(
        whole,
        "Levels in g are samples as the program counted them when they left, times the full scale that the "
        "layout states (study1: 2 g, assumed, as it names no actuator profile)"));
    EXPECT_TRUE(has(whole, "no accelerometer measured them"));
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

/// Methods as rows and facts can tell them; the protocol's own sentences come on top.
const char* const rowSentences[] = {
    R"(\d+ participants? in \d+ files?(; the table below is of all, everything else of the \d+ who are not excluded)?\.)",
    R"(Age: mean [0-9.]+ years, standard deviation [0-9.]+, \d+ to \d+ \(\d+ of \d+ known\)\.)",
    R"((Sex|Handedness): [^.]+\.)",
    R"(Ethics: Approved by the board, no\. 7\.)",
    R"(Consent: All signed\.)",
    R"(Noise: 62 dB\(A\) at the ear\.)",
    R"(to be filled in: (age, sex and handedness of the participants \(--people\)|approval by an ethics board \(--ethics\)|consent of the participants \(--consent\)|the noise as the participants heard it, e\.g\. its level in dB\(A\) \(--noise\)))",
    R"(one participant: intervals and tests over participants are not possible, and nothing here says anything about other people)",
    R"(participant P04 is excluded, with all trials: took off the headphones)",
    R"(Nobody and no main trial is left out before the analyses, each of which names whom it leaves out\.)",
    R"(Trainings are left out of all analyses\.)",
    R"(A condition was at one place of the order \d+( to \d+)? times; \d+ of 30 successions of two conditions occurred\.)",
    R"(Device, master level in dB, root mean square of the pink noise in dB of full scale \(off: there was none\), version of the program, and by how much the limiter lowered what was felt\.)",
    R"(\d+ trials left through the device JACK:system, every part within 1 dB of its plan, at a master level of -3 dB, with pink noise of -30 dB of full scale \(root mean square\); the limiter lowered none of them\.)",
    R"(Each of these calls of physvib renders a stimulus again; one of each condition and session, all \d+ in stimuli\.csv:)",
    R"(\d+ participants? without a file of times: nothing is known of dates, breaks and outputs)",
    R"(Every trial had the level of its call; nobody measured what was felt\.)",
};

TEST_F(ReportFields, NoSentenceOfTheMethodsStandsThereWithoutAField) {
    std::string text = call("study show phantom-grids").out;
    for (const auto& [from, to] : {std::pair{"\"repetitions\": 10", "\"repetitions\": 1"},
                                   {"\"name\": \"phantom-grids\"", "\"name\": \"grids\""}})
        text.replace(text.find(from), std::string_view{from}.size(), to);
    write("grids.json", text);
    plant("grids", 12, "0,-3,-30,JACK:system", "grids.json");
    write("people.csv", "participant,age,sex,handedness,excluded\nP01,21,female,right,\nP02,25,male,left,"
                        "\nP03,26,female,right,\nP04,60,male,right,took off the headphones\n");
    const auto protocol = readProtocol(text, "grids.json");
    ASSERT_TRUE(protocol) << protocol.error;
    std::vector<std::string> own = protocolSentences(protocol.value);
    for (const ConditionPlan& condition : protocol.value.conditions) own.push_back(conditionWords(condition));
    for (const SessionPlan& session : protocol.value.sessions)
        own.push_back(sessionWords(session, protocol.value));
    const std::string facts = " --protocol grids.json --ethics 'Approved by the board, no. 7.' --consent "
                              "'All signed.' --noise '62 dB(A) at the ear.'";
    for (const std::string& call : {"report grids-P*.csv --out out --people people.csv" + facts,
                                    std::string{"report grids-P*.csv --out out --protocol grids.json"},
                                    "report grids-P01.csv --out out" + facts}) {
        const auto sentences = sentencesOf(page(call), "<h2>Participants", "<h2>Identification");
        EXPECT_GE(sentences.size(), own.size() + 6u) << call;
        if (call.find("--people") != std::string::npos)
            EXPECT_TRUE(has(read("out/index.html"), ">11 participants without a file of times"));
        for (const std::string& sentence : sentences) {
            const bool isRows = std::ranges::any_of(rowSentences, [&](const char* words) {
                return std::regex_match(sentence, std::regex{words});
            });
            const bool isLack = sentence.starts_with("nothing is known of participant P") &&
                                call.find("--people") != std::string::npos;
            EXPECT_TRUE(isRows || isLack || std::ranges::find(own, sentence) != own.end())
                << call << ": from no field: " << sentence;
        }
        for (const std::string& sentence : own)
            EXPECT_NE(std::ranges::find(sentences, sentence), sentences.end()) << sentence;
    }
}

TEST_F(ReportFields, TheNoiseOfTheRoomIsToldWhereThereWasAny) {
    plant("level-steps", 1, "0,0,-30,JACK:system");
    EXPECT_TRUE(has(page("report level-steps-P01.csv --out out"),
                    "to be filled in: the noise as the participants heard it"));
    const std::string told = page("report level-steps-P01.csv --out out --noise 'Pink, 62 dB(A).'");
    EXPECT_TRUE(has(told, "Noise: Pink, 62 dB(A)."));
    EXPECT_FALSE(has(told, "to be filled in: the noise"));
    std::string rows = read("level-steps-P01.csv");
    for (std::size_t at = rows.find(",-30,JACK"); at != std::string::npos; at = rows.find(",-30,JACK"))
        rows.replace(at, 9, ",off,JACK");
    write("level-steps-P01.csv", rows);
    EXPECT_FALSE(has(page("report level-steps-P01.csv --out out"), "to be filled in: the noise"));
    refuses("report level-steps-P01.csv --out out --noise 'Pink, 62 dB(A).'", 1,
            "level-steps-P01.csv: --noise: expected trials with pink noise, found none", 2);
}

TEST_F(ReportFields, ConditionsAreNamedInFull) {
    plant("eight-methods", 3, "0,0,off,JACK:system");
    const std::string html =
        page("report eight-methods-P01.csv eight-methods-P02.csv eight-methods-P03.csv --out out");
    EXPECT_TRUE(has(html, "AF-FV-DRF: amplitude fixed, frequency varied, decay fixed"));
    EXPECT_FALSE(has(html, "205 Hz, 1 g"));
    EXPECT_TRUE(
        has(html, "5.3.1: a decay ends where it has fallen to a tenth (Eq. 5.5); here: a decay rings out"));
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
