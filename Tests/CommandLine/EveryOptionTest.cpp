// SPDX-License-Identifier: GPL-3.0-or-later
// Every option of `render` counts for itself alone: it changes what is written, in the file that it is about;
// and those that must change no sample do not.
#include "Calls.h"
#include <algorithm>

namespace physvib::test {
namespace {

class EveryOption : public CommandLine {
protected:
    /// What a call leaves: samples without the head, which tells options; lists without their first line.
    std::string left(const std::string& arguments, const std::string& file) const {
        for (const std::string& name : files())
            if (name.starts_with("out.")) std::filesystem::remove(folder_ / name);
        const Outcome outcome = call("render " + arguments);
        EXPECT_EQ(outcome.exitCode, 0) << arguments << "\n" << outcome.err;
        if (file == "said") return outcome.out;
        const std::string text = read(file);
        EXPECT_NE(text, "") << arguments;
        if (file.ends_with(".wav")) return text.substr(std::min(text.size(), text.find("data", 12)));
        return text.substr(text.find('\n') + 1);
    }
};

TEST_F(EveryOption, OfARenderCountsOrIsPromisedNotTo) {
    struct Row {
        std::string option, value, base, file;
        bool counts = true;
    };
    write("loud.csv", "time_s,frequency_hz,decay_per_s,amplitude,x_m,y_m\n0.02,60,10,0.9,0.5,0.5\n"
                      "0.05,200,30,0.9,0.3,0.8\n0.1,300,30,0.7,1.6,0.1\n");
    const std::string scene = "shake-the-box --seconds 0.9 --rate 8000 --out out.wav ",
                      list = "--from-events loud.csv --field 2,1 --seconds 0.3 --rate 8000 --out out.wav ",
                      events = scene + "--events out.csv ";
    const std::vector<Row> rows{
        {"--seconds", "1", "shake-the-box --rate 8000 --out out.wav ", "out.wav"},
        {"--seed", "2", scene, "out.wav"},
        {"--layout", "phone2", scene, "out.wav"},
        {"--field", "3,3", "--from-events loud.csv --seconds 0.3 --rate 8000 --out out.wav ", "out.wav"},
        {"--law", "energy", list, "out.wav"},
        {"--exponent", "2", list + "--law linear ", "out.wav"},
        {"--limiter", "off", list + "--level-db 30 ", "out.wav"},
        {"--steps-per-second", "200", scene, "out.wav"},
        {"--location", "fixture", events, "out.csv"},
        {"--timing", "release", events, "out.csv"},
        {"--method", "AF-FV-DRV", list, "out.wav"},
        {"--method", "AV-FF-DRV", list, "out.wav"},
        {"--fixed-level", "each", scene + "--method AF-FF-DRV ", "out.wav"},
        {"--method", "AV-FV-DRF", list, "out.wav"},
        {"--level-db", "-3", list, "out.wav"},
        {"--gamma", "0.5", list, "out.wav"},
        {"--perceived-level", "on", list, "out.wav"},
        {"--marker-of", "messages", scene + "--marker out.marks.wav ", "out.marks.wav"},
        {"--rate", "16000", "--from-events loud.csv --field 2,1 --seconds 0.3 --out out.wav ", "out.wav"},
        {"--threshold", "0.02", list + "--pattern out.pattern.csv ", "out.pattern.csv"},
        {"--contact-sound-db", "-6", scene + "--contact-sound out.sound.wav ", "out.sound.wav"},
        {"--explain", " ", scene, "said"},
        {"--block", "64", scene, "out.wav", false},
        {"--block", "1", list, "out.wav", false},
        {"--patience", "100", scene, "out.wav", false},
        {"--events", "out.csv", scene, "out.wav", false},
        {"--picture", "out.png", list, "out.wav", false},
        {"--pattern", "out.pattern.csv", list, "out.wav", false},
        {"--contact-sound", "out.sound.wav", scene, "out.wav", false},
        {"--contact-sound-channels", "2", scene + "--contact-sound out.sound.wav ", "out.sound.wav"},
        {"--marker", "out.marks.wav", scene, "out.wav", false},
    };
    for (const Row& row : rows) {
        const std::string before = left(row.base, row.file),
                          after = left(row.base + row.option + " " + row.value, row.file);
        EXPECT_EQ(before != after, row.counts) << row.option << " " << row.value << " with " << row.base;
    }
}

} // namespace
} // namespace physvib::test
