// SPDX-License-Identifier: MIT
// Trials and percent counts from CSV: what counts, what is left out, what is refused.
#include "Lab/Files/StudyCsv.h"
#include "Lab/Files/StudyTables.h"
#include "Support/Has.h"
#include "Support/Studies.h"
#include <gtest/gtest.h>

namespace physvib::study_csv_test {

TEST(StudyCsv, TrialsByCondition) {
    const auto data =
        readOne(readIdentification, "condition,stimulus,response,extra\nA,x,y,1\nB,x,x,2\nA,y,y,3\n");
    ASSERT_TRUE(data) << data.error;
    ASSERT_EQ(data.value.groups.size(), 2u);
    EXPECT_EQ(data.value.groups[0].name, "A");
    EXPECT_EQ(data.value.groups[0].trials, (std::vector<IdentificationTrial>{{"x", "y"}, {"y", "y"}}));
    EXPECT_FALSE(data.value.isSimulated);
}

TEST(StudyCsv, TrialsWithoutAResponseAreLeftOutAndTold) {
    const auto data = readOne(readIdentification, "stimulus,response\nx,x\ny,\nz,\n");
    ASSERT_TRUE(data) << data.error;
    EXPECT_EQ(data.value.groups.front().trials.size(), 1u);
    EXPECT_EQ(data.value.warnings, std::vector<std::string>{"f.csv: 2 trials without a response left out"});
    EXPECT_EQ(readOne(readIdentification, "stimulus,response\ny,\n").error,
              "f.csv: expected trials of this kind, found none");
}

TEST(StudyCsv, TrainingAndOtherTasksDoNotCount) {
    EXPECT_EQ(readOne(readIdentification, "phase,stimulus,response,ran_out\ntraining,x,,1\nmain,x,,1\nmain,x,"
                                          "y,0\ntraining,x,,1\n")
                  .value.warnings,
              std::vector<std::string>{"f.csv: left out: 1 trial ran out of time, without an answer"});
    const auto data = readOne(readIdentification,
                              "observer,phase,task,stimulus,response\nsimulated-PHONE,training,identify,x,"
                              "y\nsimulated-PHONE,main,identify,x,x\nsimulated-PHONE,main,rate,x,\n");
    ASSERT_TRUE(data) << data.error;
    EXPECT_EQ(data.value.groups.front().trials.size(), 1u);
    EXPECT_TRUE(data.value.isSimulated);
}

TEST(StudyCsv, ResponsesOutsideTheFieldAreRefused) {
    const std::string head = "condition,target_column,target_row,x,y\n";
    ASSERT_TRUE(readOne(readLocations, head + "A,7,5,0,1\n"));
    EXPECT_EQ(readOne(readLocations, head + "A,1,1,0.5,0.5\nA,1,1,1.5,0.5\n").error,
              "f.csv:3: column x: expected a number from 0 to 1, found \"1.5\"");
    EXPECT_EQ(readOne(readLocations, head + "A,1,1,0.5,nan\n").error,
              "f.csv:2: column y: expected a number from 0 to 1, found \"\"")
        << "no answer";
    EXPECT_EQ(readOne(readLocations, head + "A,0,1,0.5,0.5\n").error,
              "f.csv:2: column target_column: expected a whole number from 1 to 16, found \"0\"");
    EXPECT_EQ(readOne(readLocations, "condition,x\nA,1\n").error,
              "f.csv: expected a column target_column, found none");
}

TEST(StudyCsv, RatingsAreTheColumnsThatNoTrialFileHas) {
    const auto ratings = readOne(
        readRatings, "participant,condition,realism,liking,age\nP1,AV-FV-DRV,70,80.5,31\nP1,b,7,8,31\n");
    ASSERT_TRUE(ratings) << ratings.error;
    EXPECT_EQ(ratings.value.warnings.front(),
              "f.csv: column age has one value of each participant: a fact of people, no scale");
    const auto alike = readOne(
        readRatings, "participant,condition,realism,calm\nP1,a,70,50\nP1,b,7,50\nP2,a,6,50\nP2,b,5,50\n");
    EXPECT_EQ(alike.value.scales, (std::vector<std::string>{"realism", "calm"})) << "of all people one score";
    EXPECT_EQ(ratings.value.scales, (std::vector<std::string>{"realism", "liking"}));
    EXPECT_EQ(ratings.value.groups.front().trials.front().scores, (std::vector<double>{70, 80.5}));
    const auto once = readOne(readRatings, "condition,group,stimulus,load\nbare,a,,3\nglove,b,,4\n");
    EXPECT_EQ(once.value.groups.front().trials.front().condition, "condition=bare group=a");
    EXPECT_EQ(readOne(readRatings, "condition,realism\nA,101\n").error,
              "f.csv:2: column realism: expected a number from 0 to 100, found \"101\"");
    EXPECT_EQ(readOne(readRatings, "condition\nA\n").error,
              "f.csv: expected a column per rating scale, found none");
}

TEST(StudyCsv, ChoicesByConditionOrStimulus) {
    const auto data = readOne(readChoices, "participant,condition,choice\nP1,wood,RM\nP2,steel,SV\n");
    ASSERT_TRUE(data) << data.error;
    EXPECT_EQ(data.value.groups.front().trials[1].condition, "steel");
    EXPECT_EQ(readOne(readChoices, "condition,choice\nwood,\n").error,
              "f.csv:2: column choice: expected a label, found \"\"");
    EXPECT_EQ(readOne(readChoices, "condition,choice\nh\xf6lzern,a\n").error,
              "f.csv: expected UTF-8, found Latin-1 or the like: save it as CSV UTF-8");
}

TEST(StudyCsv, ConditionsAndStimuliAreToldApart) {
    const auto names = [](const char* rows) {
        std::vector<std::string> names;
        const auto data = readOne(readChoices, std::string{"condition,stimulus,choice\n"} + rows);
        for (const auto& trial : data.value.groups.front().trials) names.push_back(trial.condition);
        return names;
    };
    EXPECT_EQ(names("low,s,a\nhigh,s,a\n"), (std::vector<std::string>{"low", "high"}));
    EXPECT_EQ(names("low,s,a\nlow,t,a\n"), (std::vector<std::string>{"s", "t"}));
    EXPECT_EQ(names("low,s,a\nhigh,t,a\n"),
              (std::vector<std::string>{"condition=low stimulus=s", "condition=high stimulus=t"}));
    EXPECT_EQ(names("low,g=1 l=2,a\nhigh,g=2 l=2,a\n").front(), "condition=low g=1 l=2");
}

TEST(StudyCsv, OtherProgramsWordsForNothingAndForRight) {
    const auto answers = [](const std::string& rows) {
        return readOne(
            [](auto files) {
                return readLevelAnswers(files, {"level_db", "correct", false});
            },
            "participant,level_db,correct\n" + rows);
    };
    const auto data = answers("NA,1,true\nNA,2,FALSE\n01,2,1.0\n01,1,null\n01,1,NA\n");
    ASSERT_TRUE(data) << data.error;
    const auto& trials = data.value.groups.front().trials;
    ASSERT_EQ(trials.size(), 3u) << "null and NA are no answers";
    EXPECT_EQ(trials[0].participant, "NA") << "a code";
    EXPECT_EQ(trials[0].answer + trials[1].answer + 10 * trials[2].answer, 11.0);
    const auto named = [](const std::string& rows) {
        return readOne(readIdentification, "participant,stimulus,response,group\n" + rows).value;
    };
    const auto labels = named("P,null,null,None\nP,a,null,NA\nP,a,NA,g\n");
    EXPECT_EQ(labels.groups.front().trials.size(), 2u) << "a stimulus has that name";
    EXPECT_TRUE(labels.warnings.at(1).starts_with("stimuli are named null: that is an answer here"))
        << labels.warnings.at(1);
    EXPECT_EQ(named("P,b,b,g\nP,a,null,g\n").groups.front().trials.size(), 1u);
    EXPECT_TRUE(ExcludedRows{}.isMissingAnswer("group", "NA") &&
                !ExcludedRows{}.isMissingAnswer("group", "None"));
    const std::string head =
        "# physvib 1 protocol=p participant=P\nparticipant,condition,session,trial,choice\n";
    EXPECT_EQ(readOne(readChoices, head + "P,c,s,1,null\n").value.groups.front().trials.front().choice,
              "null")
        << "in our own files it is a label";
    EXPECT_EQ(readOne(readChoices, head + "P,c,s,1,a\nP,c,s,2,a\nP,c,s,1,a\n").error,
              "f.csv:5: column trial: expected each trial once, not as in line 3, found \"1\"");
}

TEST(StudyCsv, OtherProgramsRowsThatAreThereTwiceAreRefusedAndPracticeIsTraining) {
    const auto read = [](const std::string& rows, const std::vector<ColumnName>& names = {}) {
        const std::string text = "participant,stimulus,response,rt,n,phase\n" + rows;
        const NamedText files[] = {{text, "f.csv", names}, {text, "g.csv", names}};
        const auto data = readIdentification({files, 1}), both = readIdentification(files);
        EXPECT_FALSE(both) << "the same table twice";
        return data ? std::to_string(data.value.groups.front().trials.size()) : data.error;
    };
    EXPECT_EQ(read("P,a,a,0.643,1,\nP,b,a,0.501,2,\nP,a,a,0.643,1,\n"),
              "f.csv:4: column rt: expected each row once, found \"0.643\"");
    EXPECT_EQ(read("P,a,a,0.643,,\nP,a,a,0.642,,\nP,a,a,0.643,,\n"), "3") << "answers may be alike";
    std::vector<ColumnName> names{{"trial", "n"}};
    for (const char* name : {"participant", "stimulus", "response"}) names.push_back({name, name});
    EXPECT_TRUE(has(read("P,a,a,1,1,\nP,b,a,2,1,\n", names), "trial: expected each trial once"));
    EXPECT_EQ(read("P,a,a,1,1,Practice\nP,b,a,2,1,warm-up\nP,b,a,2,1,before\n"), "1");
}

TEST(StudyCsv, SessionsOfOneKindArePartedWhoeverDidBoth) {
    const std::string head =
                          "participant,condition,session,task,stimulus,choice,value,parts,correct,level_db\n",
                      one = head + "P,low,a,adjust,s,,3,,,\nP,low,c,choose,s,x,,x|y|z,,\n",
                      two = head + "Q,low,b,adjust,s,,9,,,\nQ,low,d,choose,s,v,,v|w,,\n";
    const NamedText files[] = {{one, "P.csv"}, {two, "Q.csv"}};
    std::string told;
    for (const LevelSummary& s : summariseLevels(readLevels(files).value.groups.front().trials))
        told += s.condition + " " + std::to_string(static_cast<int>(s.estimate)) + ", ";
    for (const ChoiceSummary& s : summariseSessions(readChoices(files).value, summariseChoices))
        told += s.condition + " " + std::to_string(s.shares.size()) + ", ";
    EXPECT_EQ(told, "low in a 3, low in b 9, all in c 3, all in d 2, ");
    EXPECT_EQ(readOne(readLevels, one).value.groups.front().trials.front().condition, "low");
    EXPECT_TRUE(readOne(readLevels, "participant,stimulus,value\nP,1,2\nP,1,\n")) << "no answer";
}

TEST(StudyCsv, TrainingIsNoThreshold) {
    const std::string head = "participant,condition,session,phase,task,stimulus,level_db,correct,value\n";
    const auto trials = [&](const std::string& rows) {
        return readOne(readLevels, head + rows).value.groups.front().trials;
    };
    EXPECT_EQ(trials("P,c,t,training,choose,s,9,1,\nP,c,m,main,choose,s,1,1,\n").size(), 1u);
    EXPECT_EQ(trials("P,c,o,main,rate,,,,\nP,c,m,main,estimate,s,,,3\n").size(), 1u) << "of no stimulus";
    EXPECT_EQ(trials("P,c,t,training,adjust,s,,,9\nP,c,m,main,adjust,s,,,1\n").front().value, 1.0);
    EXPECT_EQ(trials("P,c,t,training,adjust,s,,,9\nP,c,m,main,choose,s,1,1,\n").size(), 2u)
        << "matched for it";
}

TEST(StudyCsv, PercentCountsAreReadBackAsWritten) {
    const std::vector<PercentCounts> counts{{"A, linear", 2, 2, {12.5, 1.0 / 3.0, 0.0, 50.0}},
                                            {"B", 1, 2, {99.0, 1.0}}};
    const std::string text = percentCountsCsv(counts, {"0", {{"observer", "simulated"}}});
    const auto data = readOne(readPercentCounts, text);
    ASSERT_TRUE(data) << data.error;
    ASSERT_EQ(data.value.groups.size(), 2u);
    EXPECT_EQ(data.value.groups[0].trials.front(), counts[0]);
    EXPECT_EQ(data.value.groups[1].trials.front(), counts[1]);
    EXPECT_TRUE(data.value.isSimulated);
}

TEST(StudyCsv, BadPercentCountsAreNamed) {
    EXPECT_EQ(readOne(readPercentCounts, "condition,row,c1\nA,1,5\nA,3,5\n").error,
              "f.csv:3: column row: expected row 2 of the condition, found \"3\"");
    EXPECT_EQ(readOne(readPercentCounts, "condition,row,c1\nA,1,-5\n").error,
              "f.csv:2: column c1: expected a number from 0 to 100, found \"-5\"");
    EXPECT_EQ(readOne(readPercentCounts, "condition,row\nA,1\n").error,
              "f.csv: expected a column c1, found none");
}

TEST(StudyCsv, LabelsAndConditionsAreBounded) {
    std::string labels = "stimulus,response\n", conditions = "condition,stimulus,response\n";
    for (int i = 0; i < 5000; ++i) {
        labels += "s" + std::to_string(i) + ",a\n";
        conditions += "c" + std::to_string(i) + ",a,a\n";
    }
    EXPECT_EQ(readOne(readIdentification, labels).error,
              "f.csv: expected at most 2048 different stimuli and responses, found more");
    EXPECT_EQ(readOne(readIdentification, conditions).error,
              "f.csv: expected at most 4096 conditions, found more");
}

TEST(StudyCsv, TrialsThatDidNotLeaveAreLeftOutAndTold) {
    const auto choices = [](const char* rows) {
        return readOne(readChoices,
                       std::string{"participant,condition,choice,render,peak_g,device,left\n"} + rows);
    };
    const auto told = choices("P1,c,a,x,0.1|0.1,JACK:s,1\nP1,c,b,x,0|0,JACK:s,0\nP1,c,b,x,0|0,JACK:s,1\n");
    ASSERT_TRUE(told) << told.error;
    EXPECT_EQ(told.value.groups.front().trials.size(), 2u) << "left says more than a peak";
    EXPECT_EQ(told.value.warnings,
              std::vector<std::string>{
                  "f.csv: 1 trial did not leave as planned (column left, or a peak of 0 g) and is left out"});
    const auto older = choices("P1,c,a,x ; y,0.1|0.1,JACK:s,\nP1,c,b,x ; y,0.1|0,JACK:s,\n"
                               "P1,c,a,x --level-db -80 ; y,0|0.1,JACK:s,\nP1,c,a,x,0,None:no device,\n"
                               "P1,c,a,x,,,\n");
    ASSERT_TRUE(older) << older.error;
    EXPECT_EQ(older.value.groups.front().trials.size(), 4u)
        << "silence that was asked for, rehearsals and other programs' trials stay";
    EXPECT_TRUE(has(choices("P1,c,b,x,0|0,JACK:s,0\n").error, "expected trials of this kind, found none"));
}

// Tables of experiment programs under our columns' names.

const std::string psychopy = "sound,key_resp.keys,key_resp.rt,participant,expInfo,\n"
                             "A,A,0.4,7,x,\n"
                             ",,,7,x,\n"
                             "B,A,0.6,7,x,\n";

template <class Read>
auto as(Read read, std::string_view text, const std::vector<std::string>& words = {}) {
    const auto columns = parseColumnNames(words).value;
    const NamedText file{text, "t.csv", columns};
    return read(std::span{&file, 1});
}

TEST(ColumnNames, ATableOfPsychoPyIsReadByTheNamesThatItHas) {
    const auto read = as(readIdentification, psychopy,
                         {"stimulus=sound", "response=key_resp.keys", "participant=participant"});
    ASSERT_TRUE(read) << read.error;
    EXPECT_EQ(read.value.groups.front().trials,
              (std::vector<IdentificationTrial>{{"A", "A", "7"}, {"B", "A", "7"}}));
    EXPECT_EQ(read.value.warnings,
              std::vector<std::string>{"t.csv: rows left out, with nothing in one of the named columns: 1"});
    EXPECT_EQ(as(readIdentification, psychopy).error, "t.csv: expected a column stimulus, found none");
}

TEST(ColumnNames, OnlyNamedColumnsCountAndFaultsNameTheLine) {
    const auto ratings =
        as(readRatings, psychopy, {"stimulus=sound", "realism=key_resp.rt", "participant=participant"});
    ASSERT_TRUE(ratings) << ratings.error;
    EXPECT_EQ(ratings.value.scales, std::vector<std::string>{"realism"});
    EXPECT_EQ(as(readRatings, psychopy, {"stimulus=sound", "realism=key_resp.keys"}).error,
              "t.csv:2: column realism: expected a number from 0 to 100, found \"A\"");
    EXPECT_EQ(as(readRatings, psychopy, {"stimulus=picture"}).error,
              "t.csv: expected a column picture, found none");
}

TEST(ColumnNames, TruePlacesInPixelsBecomeRowsAndColumns) {
    const std::string text =
        "who,true_x,true_y,touch_x,touch_y\nP,100,50,123,0\nP,500,50,615,635\nP,100,350,1230,127\n";
    // y upwards
    const auto read =
        as(readLocations, text,
           {"participant=who", "target_x=true_x", "target_y=true_y", "x=touch_x:0:1230", "y=touch_y:635:0"});
    ASSERT_TRUE(read) << read.error;
    const auto& trials = read.value.groups.front().trials;
    ASSERT_EQ(trials.size(), 3u);
    EXPECT_TRUE(trials[1].targetColumn == 2 && trials[1].targetRow == 1);
    EXPECT_TRUE(trials[2].targetColumn == 1 && trials[2].targetRow == 2);
    EXPECT_NEAR(trials[0].x, 0.1, 1e-9);
    EXPECT_NEAR(trials[0].y, 1.0, 1e-9);
    EXPECT_NEAR(trials[2].y, 0.8, 1e-9);
    EXPECT_EQ(
        as(readLocations, text, {"target_x=true_x", "target_y=true_y", "x=touch_x:0:1000", "y=touch_y:0:635"})
            .error,
        "t.csv:4: column x: expected a number from 0 to 1, found \"1.23\"");
    EXPECT_EQ(
        as(readLocations, text, {"target_x=who", "target_y=true_y", "x=touch_x:0:1230", "y=touch_y:0:635"})
            .error,
        "t.csv:2: column target_x: expected a number, found \"P\"");
}

TEST(ColumnNames, ASimulationStaysMarked) {
    const std::string text = "s,r,observer\nA,A,simulated\n";
    EXPECT_TRUE(as(readIdentification, text, {"stimulus=s", "response=r"}).value.isSimulated);
}

TEST(ColumnNames, WordsThatNameNothingAreRefused) {
    EXPECT_EQ(parseColumnNames(std::vector<std::string>{"response"}).error,
              "expected NAME=COLUMN of the table, e.g. response=key_resp.keys, found \"response\"");
    EXPECT_EQ(parseColumnNames(std::vector<std::string>{"a=b", "a=c"}).error,
              "expected each name once, found \"a\" twice");
    EXPECT_EQ(parseColumnNames(std::vector<std::string>{"a=b=c"}).value.front().theirs, "b=c");
    EXPECT_EQ(parseColumnNames(std::vector<std::string>{"a=b:c:1"}).value.front().theirs, "b:c:1")
        << "no two numbers: a name with colons";
    EXPECT_EQ(parseColumnNames(std::vector<std::string>{"a=b:0:1"}).value.front().theirs, "b");
}

} // namespace physvib::study_csv_test
