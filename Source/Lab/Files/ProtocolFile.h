// SPDX-License-Identifier: MIT
// Study protocols as JSON files, the built-in protocols with their versions as published, and CSV files of
// levels that protocols refer to.
#pragma once
#include "Core/Limits.h"
#include "Io/Provenance.h"
#include "Io/Result.h"
#include "Lab/Files/StudyTables.h"
#include "Lab/Study/Protocol.h"
#include "Lab/Study/Stimulus.h"
#include "Lab/Study/ThesisDeviations.h"
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {
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
std::vector<ThesisDeviation> deviationsOf(const Protocol& protocol);

/// Resolves a path in a protocol: the file in the protocol's folder if it exists, else the path itself.
/// Message thread only.
std::string besideProtocol(const std::string& folder, const std::string& path);

/// Empty, or an error if the file found by besideProtocol() is behind a link that leads out of the folder.
/// Message thread only.
std::string linkFault(const std::string& folder, const std::string& path);

/// One of knownProtocols() by name, else that of a file, whose folder becomes `folder`. Message thread only.
Result<Protocol> findProtocol(const std::string& nameOrPath);

// Versions NAME-thesis of the built-in protocols, with all applicable changes of ThesisDeviations.h, so that
// they run as published.

/// One version per built-in protocol with an applicable change, as listed. Created on first use; any thread.
const std::vector<Protocol>& thesisVersions();

// CSV files of stimulus levels that experts adjusted, used by another study.

/// Parses the columns condition, stimulus, alternative, level_db; otherwise one line that names file, line
/// and column. Any thread.
inline Result<std::vector<StimulusLevel>> readStimulusLevels(std::string_view text, std::string_view name) {
    std::vector<StimulusLevel> levels;
    try {
        const detail::StudyRows rows{text, name};
        const auto condition = rows.required("condition"), stimulus = rows.required("stimulus"),
                   alternative = rows.required("alternative"), level = rows.required("level_db");
        for (const CsvRow& row : rows.table().rows) {
            StimulusLevel next{rows.text(row, condition), rows.text(row, stimulus),
                               rows.text(row, alternative),
                               rows.number(row, level, -limits::maxLevelDb, limits::maxLevelDb)};
            if (levelOf(levels, next.condition, next.stimulus) != nullptr)
                throw detail::StudyFault{
                    rows.table().fault(row, stimulus, "each stimulus of a condition once")};
            levels.push_back(std::move(next));
        }
    } catch (const detail::StudyFault& fault) {
        return Failure{fault.message};
    }
    return levels;
}

/// `levels` as CSV, with number of participants and standard deviation. Any thread.
inline std::string stimulusLevelsCsv(const std::vector<StimulusLevel>& levels, const Provenance& provenance) {
    std::string text = provenanceComment(provenance) +
                       "condition,stimulus,alternative,level_db,participants,standard_deviation\n";
    for (const StimulusLevel& level : levels) {
        for (const std::string* cell : {&level.condition, &level.stimulus, &level.alternative}) {
            appendCell(text, *cell);
            text += ',';
        }
        appendNumber(text, level.levelDb);
        text += ',';
        appendNumber(text, level.participants);
        text += ',';
        appendNumber(text, level.deviationDb);
        text += '\n';
    }
    return text;
}

} // namespace physvib
