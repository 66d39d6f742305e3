// SPDX-License-Identifier: MIT
// Writes analysis.R: a line of its origin with a hash, the functions, one call; and the notebook.
#include "Lab/Report/AnalysisScript.h"
#include "Io/Disk/ContentHash.h"
#include "Io/Disk/Embedded.h"
#include "Io/Disk/ReadFile.h"
#include "Io/Text/CleanText.h"
#include "Io/Text/CsvTable.h"
#include <algorithm>
#include <sstream>

namespace physvib {

const std::vector<EmbeddedFile>& embeddedScript(); // Source/Lab/Script

namespace {

constexpr std::string_view firstWords = "# Written by physvib, hash ", notebookHead = "---\n";

std::string embedded(std::string_view name) {
    return std::string{std::ranges::find(embeddedScript(), name, &EmbeddedFile::name)->text};
}

std::string withOrigin(const std::string& study, const std::string& text) {
    return std::string{firstWords} + contentHash(text) + ": " + cleanLine(study) + "\n" + text;
}

/// A quoted R string, in ASCII: other characters are read as their bytes where the locale is C.
std::string inR(const std::string& words) {
    std::ostringstream out;
    out << '"' << std::hex;
    const std::string line = cleanLine(words);
    for (std::string_view rest = line; !rest.empty();) {
        const auto [code, bytes] = firstCharacter(rest);
        if (code >= 0x80)
            out << "\\U{" << code << '}';
        else
            out << (code == '"' || code == '\\' ? "\\" : "") << rest.front();
        rest.remove_prefix(bytes);
    }
    return out.str() + '"';
}

std::string vectorInR(const std::vector<std::string>& words) {
    std::string out = "c(";
    for (const std::string& word : words) out.append(out.size() > 2 ? ", " : "").append(inR(word));
    return out + ")";
}

} // namespace

std::string analysisScript(const std::string& study, const std::vector<std::string>& scales,
                           const std::vector<std::string>& points, const std::string& half, bool isWithin) {
    std::string text = embedded(analysisScriptName);
    text += "study(" + inR(study) + ", " + vectorInR(scales) +
            (points.empty() ? "" : ", " + vectorInR(points)) + (half.empty() ? "" : ", half = " + inR(half)) +
            (isWithin ? ", within = TRUE)\n" : ")\n");
    return withOrigin(study, text);
}

std::string analysisNotebook(const std::string& study) {
    return std::string{notebookHead} + withOrigin(study, embedded(notebookName));
}

std::vector<std::string> testsIn(const std::string& table) {
    std::vector<std::string> tests;
    const auto read = readCsvTable(table, testsTable);
    const auto test = read.value.column("test"), kind = read.value.column("kind");
    for (const CsvRow& row : read.value.rows)
        if (test && kind && row.cells[*kind] == "test" &&
            std::ranges::find(tests, row.cells[*test]) == tests.end())
            tests.push_back(row.cells[*test]);
    return tests;
}

std::string keptScriptFault(const std::filesystem::path& path) {
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) return {};
    if (const auto text = readFile(path.string(), limits::maxTableBytes)) {
        std::string_view all = text.value;
        if (all.starts_with(notebookHead)) all.remove_prefix(notebookHead.size());
        const std::string_view first = takeUntil('\n', all);
        if (first.starts_with(firstWords) &&
            first.substr(firstWords.size()).starts_with(contentHash(std::string{all})))
            return {};
    }
    return path.string() +
           ": expected no file, or the script as physvib wrote it; this one is somebody's work: rename it";
}

} // namespace physvib
