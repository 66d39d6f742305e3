// SPDX-License-Identifier: MIT
// Study protocols as JSON files; the built-in protocols, their deviations from the thesis and their versions
// as published; and CSV files of levels that protocols refer to.
#pragma once
#include "Core/Limits.h"
#include "Io/Provenance.h"
#include "Io/Result.h"
#include "Lab/Files/StudyTables.h"
#include "Lab/Study/Protocol.h"
#include "Lab/Study/StimulusJob.h"
#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

// Table of deviations of the built-in protocols from the thesis' studies, and the change that removes each.
// `study check`, the report and Docs/studies-thesis.md use it (Tests/Docs compares the page).

/// A change of a protocol that removes a deviation.
enum class ThesisEdit {
    none,          ///< no automatic change exists
    noBreakBefore, ///< removes breaks before sessions
    noGroups,      ///< removes condition groups
    addToCalls,    ///< adds the words of `change` between addedWordsPrefix and addedWordsSuffix
    matchPeaks     ///< matches recordings by their peak, not their strength over 0.25 s
};

/// Property of a hit, pulse or phantom that a deviation changes; Tests/Thesis checks that no other changes.
enum class HitProperty { none, amplitude, duration, frequency, decay, gains, limiter, guard };

/// A deviation of a built-in protocol from the thesis.
struct ThesisDeviation {
    std::string_view protocol;   ///< name of the protocol
    std::string_view section;    ///< section of the thesis
    std::string_view inThesis;   ///< procedure in the thesis
    std::string_view inProtocol; ///< procedure in the protocol
    std::string_view change;     ///< change that makes it run as published; empty: not possible
    ThesisEdit edit = ThesisEdit::none;
    HitProperty property = HitProperty::none;
};

/// Suffix of the names of versions as published.
inline constexpr std::string_view thesisSuffix = "-thesis";

/// Text around the words in `change` that ThesisEdit::addToCalls adds.
inline constexpr std::string_view addedWordsPrefix = "add ", addedWordsSuffix = " to the call";

inline constexpr std::array thesisDeviations{
    ThesisDeviation{"patterns", "3.2.1", "2 minutes of rest after each main session",
                    "2 minutes before each main session as well", "remove break_before_s",
                    ThesisEdit::noBreakBefore},
    ThesisDeviation{"patterns", "3.2.1", "answers on a tablet's touch screen",
                    "on the mixer's screen, by mouse or touch", ""},
    ThesisDeviation{"phantom-grids", "4.1.1", "orders of all six conditions by Latin squares",
                    "the conditions of PHONE and of RING stay together: with 18 participants places are "
                    "balanced, 24 of 30 successions occur",
                    "remove group of each condition", ThesisEdit::noGroups},
    ThesisDeviation{"phantom-grids", "4.1.1", "answers on a tablet's touch screen",
                    "on the mixer's screen, by mouse or touch", ""},
    ThesisDeviation{"phantom-places", "4.2.1", "orders of all four conditions by Latin squares",
                    "the conditions of PHONE and of RING stay together: with 16 participants places are "
                    "balanced, 8 of 12 successions occur",
                    "remove group of each condition", ThesisEdit::noGroups},
    ThesisDeviation{"phantom-places", "4.2.1", "answers on a tablet's touch screen",
                    "on the mixer's screen, by mouse or touch", ""},
    ThesisDeviation{"phantom-places", "4.2.1", "Eq. 4.3, which diverges as printed",
                    "the law log, a reconstruction that falls from 1 to 0", "", ThesisEdit::none,
                    HitProperty::gains},
    ThesisDeviation{"model-or-sound", "5.2.1", "three experts match the levels before the study",
                    "each participant matches them",
                    "levels_file of three experts in place of levels_from and the session matching"},
    ThesisDeviation{"model-or-sound", "5.2.1", "impulses are taken when a contact is released (Eq. 5.2)",
                    "impacts are rendered when a contact begins, with the solver's impulse",
                    "add --timing release to the call", ThesisEdit::addToCalls},
    ThesisDeviation{"model-or-sound", "5.2.1", "a decay ends where it has fallen to a tenth (Eq. 5.5)",
                    "a decay rings out", "add --gamma 0.1 to the call", ThesisEdit::addToCalls},
    ThesisDeviation{"model-or-sound", "5.2.1", "three downloaded contact sounds, one per pair",
                    "synthetic contacts; give your own by --sound or sounds", "sounds of your own"},
    ThesisDeviation{"model-or-sound", "5.2.1", "the normalised recording times A_i",
                    "a recording is as strong as the mode over 0.25 s", "--sound-match peak in the call",
                    ThesisEdit::matchPeaks},
    ThesisDeviation{
        "model-or-sound", "5.2.1", "levels and actuator as built there",
        "the recorded contact at -8 dB and the model at -2 dB or less of their calls' own levels, "
        "which differ by fall, so that no stimulus needs the limiter",
        "a layout of your actuator, and its levels", ThesisEdit::none, HitProperty::amplitude},
    ThesisDeviation{"model-or-sound", "5.2.1",
                    "amplitudes by Eq. 5.4 and 5.7, of a screen as wide as the plate (58 mm, 2.9 m)",
                    "1.5 times as strong, by a field of 8 m and a drive_gain of 4.1",
                    "add --set screen=2.9 --set drive_gain=1 to the call", ThesisEdit::addToCalls,
                    HitProperty::amplitude},
    ThesisDeviation{"eight-methods", "5.3.1", "impulses are taken when a contact is released (Eq. 5.2)",
                    "impacts are rendered when a contact begins, with the solver's impulse",
                    "add --timing release to the call", ThesisEdit::addToCalls},
    ThesisDeviation{"eight-methods", "5.3.1", "a decay ends where it has fallen to a tenth (Eq. 5.5)",
                    "a decay rings out", "add --gamma 0.1 to the call", ThesisEdit::addToCalls},
    ThesisDeviation{
        "eight-methods", "5.3.1",
        "A=F: each collision has 1.5 g; what sounds together is added, and normalised beyond full scale",
        "1.5 g is the peak of all that sound together: a hit is weaker while others sound, down to 0",
        "add --fixed-level each to the call", ThesisEdit::addToCalls},
    ThesisDeviation{"eight-methods", "5.3.1", "amplitudes by Eq. 5.4 and 5.7",
                    "1.6 times as strong, by drive_gain of the scene box-study",
                    "add --set drive_gain=1 to the call", ThesisEdit::addToCalls, HitProperty::amplitude},
    ThesisDeviation{
        "eight-methods", "5.3.1", "what is added is normalised block by block (5.1.3)",
        "one smooth limiter: hits of AF with --fixed-level each ask for up to 8.5 g together, of the "
        "layout's 2 g; 41 % of hits are weakened, at most to 24 %",
        "add --limiter blocks to the call", ThesisEdit::addToCalls, HitProperty::limiter},
    ThesisDeviation{
        "eight-methods", "5.3.1", "AF-FV-DRF and AF-FV-DRV of rubber: 80 Hz, whose hits have a mean",
        "half a sine over each hit takes its mean off: 0.42 g at 25 Hz, peak 1.92 g for 1.50 g; 0.07 g at "
        "7 Hz, peak 1.34 g for 1.35 g; rms 0.3 and 0.0 dB more",
        "", ThesisEdit::none, HitProperty::guard},
    ThesisDeviation{"eight-methods", "5.3.1", "walls of 0.02 m",
                    "walls of 0.3 m outside the same field, through which nothing is pressed",
                    "--set walls=0.02 in the call"},
    ThesisDeviation{"eight-methods", "5.3.1", "no rest is mentioned between training and main session",
                    "2 minutes before the main session", "remove break_before_s", ThesisEdit::noBreakBefore},
    ThesisDeviation{"eight-methods", "5.3.1",
                    "drags by touch, tilts by the phone's sensor, answers on a second phone; scales as "
                    "defined there",
                    "drags by mouse or touch, tilts by keys or a phone over OSC, answers in a window; scales "
                    "in our words",
                    ""},
};

/// Version of the format that is written, and the newest that can be read.
constexpr int protocolFormatVersion = 1;
constexpr const char* protocolVersionField = "physvib_protocol";

/// Parses a valid protocol; otherwise one line `name: sessions[1].repetitions: expected 1 to 1000, found 0`.
/// Any thread.
Result<Protocol> readProtocol(std::string_view text, std::string_view name);

/// Reads a file with readProtocol(). Message thread only.
Result<Protocol> loadProtocol(const std::filesystem::path& path);

/// `protocol` as JSON; readProtocol() restores it to the bit. Any thread.
std::string protocolJson(const Protocol& protocol);

/// The JSON schema (draft 2020-12) of protocol files, made from the table of their fields. Any thread.
std::string protocolSchema();

/// Hash of all fields as 16 hexadecimal digits. Any thread.
std::string protocolHash(const Protocol& protocol);

/// Built-in protocols in listing order. Created on first use; any thread.
const std::vector<Protocol>& builtInProtocols();

/// Built-in protocols, then their versions as published. Created on first use; any thread.
const std::vector<Protocol>& knownProtocols();

/// Deviations from the thesis' study; empty if the protocol is not one of knownProtocols() or has been
/// changed. Any thread (allocates).
std::vector<ThesisDeviation> findDeviations(const Protocol& protocol);

/// Resolves a path in a protocol: the file in the protocol's folder if it exists, else the path itself.
/// Message thread only.
std::string resolveProtocolPath(const std::string& folder, const std::string& path);

/// Empty, or an error if the file found by resolveProtocolPath() is behind a link that leads out of the
/// folder. Message thread only.
std::string linkError(const std::string& folder, const std::string& path);

/// One of knownProtocols() by name, else that of a file, whose folder becomes `folder`. Message thread only.
Result<Protocol> findProtocol(const std::string& nameOrPath);

// Versions NAME-thesis of the built-in protocols, with all applicable changes of thesisDeviations, so that
// they run as published.

/// One version per built-in protocol with an applicable change, as listed. Created on first use; any thread.
const std::vector<Protocol>& thesisVersions();

// CSV files of stimulus levels that experts adjusted, used by another study. The columns condition, stimulus,
// alternative and level_db are read.

/// `levels` as CSV, with number of participants and standard deviation. Any thread.
inline std::string stimulusLevelsCsv(const std::vector<StimulusLevel>& levels, const Provenance& provenance) {
    std::string text = provenanceComment(provenance) +
                       "condition,stimulus,alternative,level_db,participants,standard_deviation\n";
    for (const StimulusLevel& level : levels)
        text +=
            csvLine(std::array{level.condition, level.stimulus, level.alternative, numberText(level.levelDb),
                               std::to_string(level.participants), numberText(level.deviationDb)});
    return text;
}

} // namespace physvib
