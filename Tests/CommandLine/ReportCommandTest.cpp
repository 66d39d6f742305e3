// SPDX-License-Identifier: GPL-3.0-or-later
// A study's report as researchers call it: pages that need nothing else, tables that repeat, simulated data
// that say so.
#include "Calls.h"
#include "Io/Text/NumberText.h"
#include "Lab/Files/ProtocolFile.h"
#include "System/Process.h"
#include <algorithm>
#include <cmath>
#include <cstdio>

namespace physvib::report_command_test {

class Report : public test::CommandLine {
protected:
    void simulate(const std::string& protocol, int participants) const {
        runs("study run " + protocol + " --observer simulated --participants " +
             std::to_string(participants));
    }
    std::string page(const std::string& folder = "out") const { return read(folder + "/index.html"); }
};

TEST_F(Report, EveryBuiltInStudyHasAPageThatNeedsNothingElse) {
    for (const Protocol& protocol : builtInProtocols()) {
        const std::string& name = protocol.name;
        simulate(name, 3);
        EXPECT_TRUE(runs("report " + name + "-P*.csv --out " + name).out.starts_with("SIMULATED"));
        const std::string html = page(name);
        EXPECT_TRUE(has(html, protocol.title)) << name;
        EXPECT_GE(timesIn(html, "<svg "), 1u) << name;
        EXPECT_EQ(timesIn(html, ">SIMULATED</text>"), timesIn(html, "<svg "))
            << name << ": every picture is watermarked";
        EXPECT_EQ(timesIn(html, "http"), timesIn(html, "http://www.w3.org/2000/svg") + 1)
            << name << ": no network (the other is http-equiv)";
        EXPECT_TRUE(
            hasNone(html, {"<script", "=\"nan", ">nan", " nan", "Mnan", "NaN", "-inf", "url(h", "<img"}))
            << name;
        EXPECT_TRUE(
            hasAll(html, {">Participants<", ">Left out before the analyses<", ">Procedure<",
                          ">Calls of the stimuli", ">Files, versions, seeds<", "hash of the protocol"}))
            << name;
        for (const auto& entry : std::filesystem::directory_iterator{folder_ / name})
            if (entry.path().extension() == ".csv")
                EXPECT_TRUE(has(html, entry.path().filename().string())) << entry.path();
    }
}

TEST_F(Report, TheTestsAreThoseOfTheScriptBesideIt) {
    if (!hasProgram("Rscript")) GTEST_SKIP() << "Rscript (Debian: r-base-core) is not here";
    simulate("eight-methods", 5);
    EXPECT_TRUE(has(runs("report eight-methods-P*.csv --out out").out, "out/tests.csv  6 tests by R\n"));
    for (const char* words :
         {"<h3>analysis of variance of realism by A, F, DR</h3>",
          "<h3>analysis of variance of liking by A, F, DR</h3>", "<h3>pairs by t of liking by A, F, DR</h3>",
          "<h3>levels of liking by A, F, DR</h3>"})
        EXPECT_EQ(timesIn(page(), words), 1u) << words;
    EXPECT_EQ(timesIn(page(), "<td>Holm, 3 tests over scales</td>"), 21u) << "seven effects of three scales";
    EXPECT_TRUE(has(page(), ", R version ")) << "whose figures these are";
}

TEST_F(Report, TimeOutsOfOtherProgramsAreToldAndWhoHasMoreTrialsLeavesNobodyOut) {
    std::string rows = "who,place,felt,said,late,n\n";
    for (const std::string who : {"P", "Q", "R"})
        for (const std::string place : {"wrist", "ankle"})
            for (int n = 1; n <= (who == "Q" ? 6 : 4); ++n)
                rows += who + "," + place + "," + (n % 2 == 0 ? "rise,rise" : "fall") +
                        (n % 2 == 0 ? ",false,"
                         : n == 1   ? ",null,true,"
                                    : ",rise,FALSE,") +
                        std::to_string(n) + "\n";
    write("t.csv", rows);
    runs("report t.csv --out late --columns "
         "participant=who,condition=place,stimulus=felt,response=said,ran_out=late,trial=n");
    const std::string late = read("late/index.html");
    EXPECT_TRUE(has(late, "<td>Q</td><td class=\"number\">2</td><td>ran out of time</td>"))
        << late.substr(late.find("Left out before"), 900);
    EXPECT_TRUE(hasNone(late, {"<td>no answer</td>", "fewer trials than most"}));
    EXPECT_TRUE(has(late, "28 trials without a record of device and levels"));
    if (hasProgram("Rscript")) EXPECT_TRUE(has(late, "share of trials that ran out of time by condition"));
}

TEST_F(Report, WordsInTheScriptAreTheSameInEveryLocale) {
    std::string rows = "participant,condition,a\\b sch\xc3\xb6n\n";
    for (const char* who : {"P", "Q"})
        for (const char* pair : {"wood", "steel"}) rows += std::string(who) + ",pair=" + pair + ",7\n";
    write("t.csv", rows);
    runs("report t.csv --out out");
    const std::string script = read("out/analysis.R");
    EXPECT_TRUE(has(script, R"(c("a\\b sch\U{f6}n"))")) << script.substr(script.size() - 600);
    EXPECT_TRUE(std::ranges::all_of(script, [](char c) { return static_cast<unsigned char>(c) < 0x80; }));
}

TEST_F(Report, GroupsOfATableAreCountedAndAnswersThatAreNoneToo) {
    write("t.csv", "participant,task,condition,stimulus,value\nA,estimate,x,1,2\nA,estimate,y,1,2\n");
    runs("report t.csv --out sorted");
    EXPECT_FALSE(has(read("sorted/index.html"), "Orders of the conditions")) << "nothing counts trials";
    // Practice is no trial that counts, answered or not; who has no whole row is named; of two levels of
    // pairs.
    std::string rows = "p,g,when,c,likes\n";
    for (const char* who : {"P,x", "Q,", "R,y", "S,y"})
        for (const char* when : {",practice,", ",test,", ",test,"})
            for (const char* what : {"calm,", "wild,"})
                rows += std::string{who} + when + what +
                        (who[0] == 'P' && (when[1] == 'p' || what[0] == 'w') ? "null\n" : "40\n");
    write("t.csv", rows + "T,y,test,,10\n");
    runs("report t.csv --out likes --columns participant=p,group=g,phase=when,condition=c,likes=likes");
    const std::string likes = read("likes/index.html");
    EXPECT_TRUE(hasAll(read("likes/participants.csv"), {"\nP,,,4,2,2,", "\nQ,,,4,2,0,", "\nT,,,0,0,0,"}));
    EXPECT_TRUE(hasAll(likes, {"<td>participants</td><td></td><td class=\"number\">5</td>",
                               "<td>group</td><td>y</td><td class=\"number\">2",
                               "<td>group</td><td>not known</td><td class=\"number\">1",
                               "<td>nothing in a named column</td>",
                               "<td>T</td><td class=\"number\">0</td><td>fewer trials than most (4)</td>",
                               "<td>P</td><td class=\"number\">2</td><td>no answer</td>"}))
        << likes.substr(likes.find("Participants<"), 3000);
    EXPECT_EQ(timesIn(likes, "fewer trials than most"), 1u);
    write("people.csv", "participant,excluded\nP,went home\n");
    runs("report t.csv --out without --people people.csv --columns "
         "participant=p,group=g,phase=when,condition=c,likes=likes");
    const auto rowOf = [this](const char* table) {
        const std::string left = read(table);
        const auto end = left.find("nothing in a named column");
        return left.substr(left.rfind('\n', end), end - left.rfind('\n', end));
    };
    EXPECT_EQ(rowOf("without/left-out.csv"), rowOf("likes/left-out.csv")) << "P's go with P";
    EXPECT_TRUE(hasAll(read("likes/ratings.csv"), {"condition=calm group=not known,likes,2,1,40",
                                                   "condition=calm group=x,likes,2,1,40"}));
    write("t.csv", "participant,group,ease,fun\nA,x,4,1\nA,x,4,\nB,x,5,2\nB,x,6,4\nC,y,1,\nD,y,2,3\n");
    runs("report t.csv --out ease");
    const std::string ease = read("ease/index.html");
    EXPECT_TRUE(has(read("ease/ratings.csv"), "group=x,ease,4,2,4.75,") &&
                has(read("ease/ratings.csv"), "group=x,fun,3,2,2,") &&
                has(read("ease/ratings.csv"), "group=y,fun,1,1,3,"))
        << read("ease/ratings.csv");
    EXPECT_TRUE(has(ease, "participant C: 1 trial without a score of fun"));
}

TEST_F(Report, NamesAreAsTheyAreWrittenAndOneScoreHasNoSpread) {
    std::string rows = "participant,condition,stimulus,rough\n";
    for (const char* who : {"A", "B"})
        for (const char* where : {"Gl\xc3\xa4tte", "\xec\x86\x90"})
            for (const char* what : {"soft", "hard"})
                rows += std::string{who} + "," + where + "," + what + ",40\n";
    write("t.csv", rows + "A,tin,soft,44\n");
    runs("report t.csv --out out");
    EXPECT_TRUE(has(
        page(), "<td>condition=Gl\xc3\xa4tte stimulus=soft</td><td>rough</td><td class=\"number\">2</td>"));
    EXPECT_FALSE(has(page(), "\\x"));
    EXPECT_TRUE(has(read("out/ratings.csv"), "condition=tin stimulus=soft,rough,1,1,44,44,,\n"));
}

TEST_F(Report, PlacesBeyondTheEdgesHaveErrorsAndWhoIsInTwoGroupsIsNamed) {
    std::string rows = "who,team,tx,ty,px,py\n";
    for (const char* who : {"A,g", "B,h", "C,g"})
        for (const char* at : {"100,50,", "100,90,", "700,50,", "700,90,"})
            for (const char* touch : {"400,60\n", "450,70\n"}) rows += std::string{who} + "," + at + touch;
    rows.replace(rows.rfind("C,g"), 3, "C,h");
    write("t.csv", rows);
    const std::string columns =
        "report t.csv --out out --columns participant=who,group=team,target_x=tx,target_y=ty,x=px,y=py";
    runs(columns);
    EXPECT_TRUE(has(page(), "24 of 24 places outside 0 to 1: no territories and grids"));
    EXPECT_TRUE(has(page(), "<td>distance from the target</td>") && has(page(), "<h2>Perceived places"));
    EXPECT_FALSE(has(page(), "expected a number from 0 to 1"));
    EXPECT_FALSE(has(page(), "not analysed beside answers")) << "true places are none";
    EXPECT_TRUE(has(page(), "<td>group</td><td>in several (C)</td><td class=\"number\">1</td>"));
    runs("report t.csv --out out --columns "
         "participant=who,target_x=tx:0:800,target_y=ty:0:100,x=px:0:800,y=py:0:100");
    EXPECT_FALSE(has(page(), "outside 0 to 1") || has(page(), "<td>group</td>"));
    runs("report t.csv --out out --columns "
         "participant=who,target_x=tx:0:710,target_y=ty:0:95,x=px:0:420,y=py:0:100");
    EXPECT_TRUE(has(page(), "12 of 24 places beyond the named edges: no"));
    EXPECT_TRUE(has(page(), "Places are shares of the named edges") && !has(page(), "table's units"));
    // shares are not compared with what is in the table's units
    runs("report t.csv --out mixed --columns "
         "participant=who,target_x=tx,target_y=ty,x=px:0:420,y=py:0:100");
    EXPECT_TRUE(has(read("mixed/index.html"), "expected a range of both x and target_x"));
    for (const char* page : {"mixed/index.html", "mixed/tests.csv"})
        EXPECT_FALSE(has(read(page), "distance from the target")) << page;
}

TEST_F(Report, APlanHasTheExclusionsAndCorrections) {
    const std::string grids = call("study plan phantom-grids --participants 4 --out plan.txt").out;
    std::filesystem::remove(folder_ / "analysis.R");
    EXPECT_TRUE(has(grids, "\nMeasures, of each participant\n- percent correct; information transfer"));
    const std::string steps = call("study plan level-steps --participants 4 --out plan.txt").out;
    for (const char* words : {"fewer than two reversals", "at an end of the levels"}) {
        EXPECT_TRUE(has(steps, words));
        EXPECT_FALSE(has(grids, words));
    }
    std::filesystem::remove(folder_ / "analysis.R");
    const std::string shares = call("study plan model-or-sound --participants 4 --out plan.txt").out;
    for (const std::string& plan : {grids, shares})
        EXPECT_TRUE(has(plan, "- trials that did not leave as planned, ran out of time or have no answer"));
    if (!hasProgram("Rscript")) return;
    EXPECT_TRUE(has(grids, "- analysis of variance: Greenhouse-Geisser\n") &&
                has(grids, "- pairs by t: Holm\n"))
        << grids;
    EXPECT_TRUE(has(shares, "- shares: Holm\n") && has(shares, "- pairs by ranks: Holm\n")) << shares;
    EXPECT_FALSE(has(shares, "Greenhouse") || has(shares, "over scales") || has(grids, "against chance"))
        << shares;
}

TEST_F(Report, ANotebookOfTheTestsIsWrittenOnRequestAndStaysOnceEdited) {
    simulate("eight-methods", 2);
    const std::string make = "report eight-methods-P*.csv --out out";
    runs(make);
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out/analysis.qmd"));
    for (int times = 0; times < 2; ++times) runs(make + " --notebook");
    const std::string notebook = read("out/analysis.qmd");
    EXPECT_TRUE(notebook.starts_with("---\n# Written by physvib, hash ")) << notebook.substr(0, 80);
    write("out/analysis.qmd", notebook + "mine\n");
    EXPECT_TRUE(has(call(make + " --notebook").err, "out/analysis.qmd: expected no file"));
    runs(make);
    EXPECT_EQ(read("out/analysis.qmd"), notebook + "mine\n");
}

TEST_F(Report, AScriptThatSomebodyEditedStays) {
    simulate("eight-methods", 2);
    const std::string make = "report eight-methods-P*.csv --out out";
    runs(make);
    runs(make);
    const std::string edited = read("out/analysis.R") + "cat(1)\n";
    write("out/analysis.R", edited);
    const auto outcome = call(make);
    EXPECT_EQ(outcome.exitCode, 1);
    EXPECT_TRUE(has(outcome.err, "out/analysis.R: expected no file, or the script as physvib wrote it"));
    EXPECT_EQ(read("out/analysis.R"), edited);
    write("analysis.R", "my own\n");
    EXPECT_EQ(call("study plan eight-methods --participants 4 --out plan.txt").exitCode, 1);
    EXPECT_EQ(read("analysis.R"), "my own\n");
    EXPECT_FALSE(std::filesystem::exists(folder_ / "plan.txt"));
}

TEST_F(Report, TheSameTrialsGiveTheSameBytes) {
    simulate("model-or-sound", 2);
    runs("report model-or-sound-P01.csv model-or-sound-P02.csv --out a");
    runs("report model-or-sound-P01.csv model-or-sound-P02.csv --out b");
    for (const auto& entry : std::filesystem::directory_iterator{folder_ / "a"}) {
        const std::string name = entry.path().filename().string();
        EXPECT_EQ(read("a/" + name), read("b/" + name)) << name;
    }
}

TEST_F(Report, WordsOfFilesAreOnlyWords) {
    write("t.csv", "participant,condition,stimulus,response\n<script>alert(1)</script>,\"<img src=x "
                   "onerror=alert(1)>\",<b>,<b>\n"
                   "<script>alert(1)</script>,\"<img src=x onerror=alert(1)>\",c,<b>\nQ,\"<img src=x "
                   "onerror=alert(1)>\",<b>,<b>\nQ,\"<img src=x onerror=alert(1)>\",c,c\n");
    runs("report t.csv --out out");
    const std::string html = page();
    EXPECT_TRUE(has(html, "&lt;script&gt;"));
    EXPECT_TRUE(hasNone(html, {"<script", "<img", "<b>c", "<td><b>"}));
    EXPECT_FALSE(has(html, "SIMULATED")) << "nothing says that these were simulated";
}

// Of magnitudes that equal their levels the mean law goes through the mean of the middle one, which all have.
TEST_F(Report, AMeanPowerLawIsInTheUnitsOfItsPointsWhoeverHasWhichLevels) {
    write("m.csv", "participant,stimulus,value\nA,1,1\nA,10,10\nB,1,1\nB,10,10\nC,10,10\nC,100,100\n");
    runs("report m.csv --out m");
    const std::string html = read("m/index.html");
    const auto law = html.find("<path d=\"M");
    ASSERT_NE(law, std::string::npos);
    double x0 = 0.0, y0 = 0.0, x1 = 0.0, y1 = 0.0;
    ASSERT_EQ(std::sscanf(html.c_str() + law, "<path d=\"M%lf %lfL%lf %lf", &x0, &y0, &x1, &y1), 4);
    int found = 0;
    for (auto at = html.find("translate("); at != std::string::npos; at = html.find("translate(", at + 1)) {
        double x = 0.0, y = 0.0;
        if (std::sscanf(html.c_str() + at, "translate(%lf %lf)", &x, &y) != 2) continue;
        if (std::abs(x - 0.5 * (x0 + x1)) > 0.02) continue;
        EXPECT_NEAR(y, 0.5 * (y0 + y1), 0.02);
        ++found;
    }
    EXPECT_EQ(found, 1);
}

TEST_F(Report, OtherProgramsTablesAreReadByTheirNames) {
    std::string text = "sound,key_resp.keys,subject,\n,,1,\n";
    for (int p = 1; p <= 4; ++p)
        for (int t = 0; t < 10; ++t)
            text += std::string(t % 2 ? "hi" : "lo") + (t % 3 || p % 2 ? ",hi," : ",lo,") +
                    std::to_string(p) + ",\n";
    write("p.csv", text);
    const std::string columns = " --columns participant=subject,stimulus=sound,response=key_resp.keys";
    runs("report p.csv --out out" + columns);
    EXPECT_TRUE(has(page(), "<td>nothing in a named column</td><td>these rows</td>"));
    EXPECT_FALSE(has(read("out/trials.csv"), "key_resp"));
    EXPECT_TRUE(has(test::squeezed(runs("analyse confusion p.csv" + columns).out), " 2 40 50 50 4 50 "));
    refuses("analyse confusion p.csv --columns response", 2, "--columns: expected NAME=COLUMN", 2);
    refuses("analyse confusion p.csv --columns response=keys", 1, "p.csv: expected a column keys, found none",
            2);
}

/// Three people who say at seven speeds whether something was faster, more surely the later they took part.
std::string fasterTable(double unit) {
    std::string text = "who,masker,speed,faster\n";
    for (const char* who : {"a", "b", "c"})
        for (int level = 1; level <= 7; ++level)
            for (int k = 0; k < 10; ++k)
                text += std::string{who} + ",none," + numberText(unit * level) +
                        (k < level * (5 + who[0] % 3) / 4 ? ",1\n" : ",0\n");
    return text;
}

TEST_F(Report, AnswersAtLevelsOfOtherProgramsGetFunctionsInTheirOwnWords) {
    write("f.csv", fasterTable(1.0));
    const std::string columns = " --columns participant=who,condition=masker,level_db=speed,correct=faster";
    runs("report f.csv --out out --guess 0" + columns);
    const std::string html = page();
    EXPECT_TRUE(hasAll(html, {"Share of answers \u201cfaster\u201d by speed.",
                              "lapse rate up to 2 % at both ends", "<h2>Answers by level"}));
    EXPECT_TRUE(hasNone(html, {"Orders of the conditions", "level (dB)", "<td>training</td>", "own level"}));
    const auto analysed = call("analyse psychometric f.csv --guess 0 --lapse 0" + columns);
    EXPECT_TRUE(has(html, "<td>none</td><td>50 % point</td>") &&
                has(test::squeezed(analysed.out), "none 50 % point 3 "))
        << analysed.err;
    EXPECT_TRUE(has(read("out/analysis.R"), "half = \"50 % point\""));
}

TEST_F(Report, OfOtherProgramsTablesItTellsWhatIsNotAnsweredNotNamedAndGrouped) {
    write("f.csv", fasterTable(1.0) + "a,none,4,None\na,,,\n");
    EXPECT_TRUE(has(call("report f.csv --out out --guess 0 --columns "
                         "participant=who,level_db=speed,correct=faster")
                        .err,
                    "that --columns does not name: masker"));
    EXPECT_TRUE(has(page(), "<td>no answer</td><td>these trials</td>"));
    std::string ratings = "who,team,glove,ease\n";
    for (const char* who : {"a,x", "b,x", "c,y", "d,y"})
        ratings += std::string{who} + ",on,40\n" + who + ",off,50\n";
    write("r.csv", ratings);
    call("report r.csv --out out --columns participant=who,group=team,condition=glove,ease=ease");
    EXPECT_TRUE(hasAll(read("out/ratings.csv"),
                       {"condition=on group=y,ease,2,2,40", "condition=off group=x,ease,2,2,50"}));
    std::string one; // stimulus is no factor
    for (std::size_t at = 0, end; (end = ratings.find('\n', at)) != ratings.npos; at = end + 1)
        one += ratings.substr(at, end - at) + (at == 0 ? ",what\n" : ",cube\n");
    write("r.csv", one);
    call("report r.csv --out one --columns "
         "participant=who,group=team,condition=glove,stimulus=what,ease=ease");
    EXPECT_TRUE(has(read("one/ratings.csv"), "condition=on group=y,ease,2,2,40"));
}

TEST_F(Report, SmallLevelsKeepTheirDigitsAndFewPeopleTheirInterval) {
    write("f.csv", fasterTable(0.001));
    const auto outcome = runs("analyse psychometric f.csv --guess 0 --lapse 0 --shape normal --export t.csv "
                              "--columns participant=who,level_db=speed,correct=faster");
    EXPECT_TRUE(has(test::squeezed(outcome.out), "50 % point 3 0.00"));
    EXPECT_FALSE(has(outcome.out, " 0.00 ") || has(outcome.out, "e+")) << outcome.out;
    EXPECT_TRUE(has(read("t.csv"), ",0,0,")) << "neither guesses nor lapses";
}

TEST_F(Report, PeopleOfWhomNothingIsKnownCount) {
    simulate("level-steps", 3);
    write("people.csv", "participant,age,sex,excluded,group\nP01,20,female,NA,NA\nP02,NA,NA,,g\n"); // of R's
    runs("report level-steps-P*.csv --out out --people people.csv");
    EXPECT_TRUE(
        hasAll(page(), {"<td>age, mean (years)</td><td class=\"number\">20</td><td class=\"number\">1</td>",
                        "<td>sex</td><td>not known</td><td class=\"number\">2</td>",
                        "<td>group</td><td>not known</td><td class=\"number\">2</td>", "<p>none</p>"}))
        << "; staircases end where they end";
}

TEST_F(Report, WhoStoppedBeforeTheEndIsNamed) {
    for (const auto& [name, missing] :
         {std::pair<std::string, int>{"level-steps", 4}, {"level-quest", 4}, {"magnitudes", 1}}) {
        simulate(name, 3);
        std::string text = read(name + "-P02.csv");
        for (int line = 0; line < missing; ++line) text.erase(text.rfind('\n', text.size() - 2) + 1);
        write(name + "-P02.csv", text);
        runs("report " + name + "-P*.csv --out " + name);
        const std::string html = page(name);
        EXPECT_EQ(timesIn(html, "<td>not finished</td>"), 1u) << name;
        EXPECT_EQ(has(html, "<td>not finished</td><td>threshold</td>"), name != "magnitudes") << name;
        EXPECT_EQ(has(html, "<td>not finished</td><td>tests that need what is lacking</td>"),
                  name == "magnitudes")
            << name;
        EXPECT_TRUE(has(read(name + "/analysis.R"), ", within = TRUE)\n")) << "as the protocol has it";
    }
}

TEST_F(Report, LevelsThatAnswersChoseTellNoSlope) {
    simulate("level-steps", 3);
    runs("report level-steps-P*.csv --out out");
    EXPECT_TRUE(has(page(), "Thresholds"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out/psychometric.csv")) << "thresholds.csv has them";
    EXPECT_TRUE(hasNone(page(), {"<td>JND</td>", "Thin lines", "functions"}));
    write("f.csv", fasterTable(1.0));
    const auto told = call("analyse psychometric f.csv --guess 0 --columns "
                           "participant=who,condition=masker,level_db=speed,correct=faster");
    EXPECT_TRUE(has(test::squeezed(told.out), "none JND "))
        << "levels that the experimenter chose: " << told.err;
}

TEST_F(Report, WhatWasDoneIsComparedWithThePlan) {
    if (!hasProgram("Rscript")) GTEST_SKIP() << "Rscript (Debian: r-base-core) is not here";
    for (const std::string name : {"phantom-grids", "eight-methods", "magnitudes"}) {
        const auto planned = runs("study plan " + name + " --participants 4 --out plan.txt");
        const std::string hash = planned.out.substr(planned.out.rfind(' ') + 1, 16);
        EXPECT_TRUE(has(planned.out, "\nplan.txt  hash " + hash + "\n"));
        simulate(name, 4);
        const std::string files = "report " + name + "-P*.csv --plan plan.txt --out ";
        runs(files + name);
        const std::string done = page(name).substr(page(name).find("Planned and done"));
        EXPECT_TRUE(has(done, "<td>hash of the plan</td><td>" + hash)) << hash << done.substr(0, 600);
        EXPECT_EQ(read("analysis.R"), read(name + "/analysis.R")) << "planned and run are one script";
        EXPECT_TRUE(has(done, "<td>yes</td><td>yes</td>") && !has(done, "<td>no</td>")) << name << done;
    }
    runs("report magnitudes-P01.csv magnitudes-P02.csv magnitudes-P03.csv --plan plan.txt --out fewer");
    EXPECT_TRUE(
        has(page("fewer"), "<td>participants</td><td class=\"number\">4</td><td class=\"number\">3</td>"));
    std::string plan = read("plan.txt");
    const auto test = plan.find("- test: Friedman");
    ASSERT_NE(test, std::string::npos) << plan;
    write("plan.txt", plan.substr(0, test) + "- test: other" + plan.substr(test + 16));
    runs("report magnitudes-P*.csv --plan plan.txt --out other");
    const std::string other = page("other").substr(page("other").find("Planned and done"));
    EXPECT_TRUE(has(other, "<td>yes</td><td>no</td>") && has(other, "<td>no</td><td>yes</td>")) << other;
    refuses("report magnitudes-P01.csv --plan magnitudes-P01.csv --out none", 1,
            "expected a plan of `physvib study plan`", 19);
}

TEST_F(Report, PeopleInTwoTablesAreNamed) {
    const auto table = [&](const char* name, int first, int last) {
        std::string text = "participant,stimulus,response\n";
        for (int p = first; p <= last; ++p)
            text += std::to_string(p) + ",hi,hi\n" + std::to_string(p) + (p % 2 ? ",lo,hi\n" : ",lo,lo\n");
        write(name, text);
    };
    table("a.csv", 1, 3), table("b.csv", 3, 4), table("c.csv", 5, 6);
    const std::string note = "count as one person each; if they are not, give them different codes: "
                             "3 in a.csv, b.csv";
    const std::string lines[] = {"report a.csv b.csv c.csv --out out", "analyse confusion a.csv b.csv c.csv"};
    for (const std::string& line : lines) EXPECT_TRUE(has(call(line).err, note)) << line;
    EXPECT_TRUE(hasAll(page(), {note, "<td>participants</td><td></td><td class=\"number\">6</td>"}));
    EXPECT_FALSE(has(call("report b.csv c.csv --out out").err, "count as one person"));
    EXPECT_FALSE(has(page(), "count as one person"));
}

TEST_F(Report, ASecondTrialFileOfAParticipantIsRefused) {
    simulate("level-steps", 2);
    simulate("level-quest", 1);
    std::filesystem::create_directory(folder_ / "other");
    write("other/level-steps-P01.csv", read("level-steps-P01.csv"));
    const std::string files = "level-steps-P02.csv level-steps-P01.csv other/level-steps-P01.csv";
    const std::string why = "other/level-steps-P01.csv: expected trials of somebody else than "
                            "level-steps-P01.csv, found participant P01 in both";
    refuses("report " + files + " --out out", 1, why, 4);
    refuses("analyse levels " + files, 1, why, 4);
    runs("analyse levels level-steps-P01.csv level-quest-P01.csv");
}

TEST_F(Report, TrialsCanBeABidsDatasetAsWell) {
    simulate("eight-methods", 2);
    runs("report eight-methods-P*.csv --out out --bids");
    EXPECT_EQ(timesIn(read("out/bids/sub-P02/beh/sub-P02_task-eightmethods_beh.tsv"), "\n"), 97u)
        << "a header, 16 trials of training, 80";
    EXPECT_TRUE(has(read("out/bids/dataset_description.json"), "SIMULATED"));
    write("t.csv", "stimulus,response\na,a\nb,b\n");
    refuses("report t.csv --out none --bids", 1, "t.csv: --bids: expected a column participant", 4);
}

TEST_F(Report, FitsHavePictures) {
    simulate("level-steps", 1);
    refuses("analyse psychometric level-steps-P01.csv", 1,
            "file has trials that `physvib analyse levels` reads", 1);
    std::string rows = "participant,observer,level_db,correct\n";
    for (int n = 0; n < 80; ++n)
        rows += "P,simulated," + std::to_string(n % 4) + (n % 4 > 1 || n % 8 == 1 ? ",1\n" : ",0\n");
    write("t.csv", rows);
    runs("analyse psychometric t.csv --guess 0 --picture p.svg");
    EXPECT_TRUE(read("p.svg").starts_with("<svg xmlns="));
    EXPECT_EQ(timesIn(read("p.svg"), ">SIMULATED<"), 1u);
    EXPECT_TRUE(has(read("p.svg"), "mean 50 % point"));
}

TEST_F(Report, RefusalsLeaveNothing) {
    simulate("magnitudes", 1);
    simulate("level-steps", 1);
    refuses("report magnitudes-P01.csv level-steps-P01.csv --out out", 1,
            "level-steps-P01.csv:1: expected trials of the protocol \"magnitudes\"", 2);
    refuses("report nothing.csv --out out", 1, "nothing.csv", 2);
    refuses("report magnitudes-P01.csv --out magnitudes-P01.csv/x", 1, "expected a folder", 2);
    refuses("report magnitudes-P01.csv", 2, "--out", 2);
    std::filesystem::create_directory(folder_ / "in");
    std::filesystem::copy(folder_ / "magnitudes-P01.csv", folder_ / "in/trials.csv");
    refuses("report in/trials.csv --out in", 2, "trials.csv", 3);
    EXPECT_EQ(read("in/trials.csv"), read("magnitudes-P01.csv"));
}

} // namespace physvib::report_command_test
