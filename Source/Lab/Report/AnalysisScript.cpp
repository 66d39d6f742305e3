// SPDX-License-Identifier: MIT
// Writes analysis.R: a line of its origin with a hash, the functions, then one call per test.
#include "Lab/Report/AnalysisScript.h"
#include "Io/Disk/ContentHash.h"
#include "Io/Disk/Embedded.h"
#include "Io/Disk/ReadFile.h"
#include "Io/Text/CleanText.h"
#include "Io/Text/NameList.h"
#include <sstream>

namespace physvib {

const std::vector<EmbeddedFile>& embeddedScript(); // Source/Lab/Script/analysis.R

namespace {

constexpr std::string_view firstWords = "# Written by physvib, hash ";

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

std::string StudyTest::words() const {
    if (kind == Kind::choices)
        return "signed ranks of the participants' shares of an alternative against one half, " + table +
               "; Holm's correction";
    std::string all = kind == Kind::anova      ? "analysis of variance"
                      : kind == Kind::friedman ? "Friedman's test"
                      : isOfRanks              ? "pairs by signed ranks"
                                               : "pairs by t";
    all += " of " + measure + " by " + listed(within) + ", " + table;
    for (const std::string& one : where) all += " where " + one;
    if (kind == Kind::anova) return all + "; Greenhouse and Geisser's correction";
    if (kind == Kind::pairs) all += isBonferroni ? "; Bonferroni's correction" : "; Holm's correction";
    return all;
}

std::string StudyTest::call() const {
    constexpr std::string_view functions[] = {"anova.test", "friedman", "pairs.test", "choices"};
    std::string line{functions[static_cast<std::size_t>(kind)]};
    line += "(" + inR(words()) + ", " + inR(table);
    if (kind == Kind::choices) return line + ")\n";
    line += ", " + inR(measure) + ", " + vectorInR(within);
    if (!where.empty()) line += ", where = " + vectorInR(where);
    if (isOfRanks) line += ", by = \"ranks\"";
    if (isBonferroni) line += ", correction = \"bonferroni\"";
    return line + ")\n";
}

std::string analysisScript(const std::vector<StudyTest>& tests, const std::string& study) {
    std::string text{embeddedScript().front().text};
    for (const StudyTest& test : tests) text += test.call();
    text += "finish(" + inR(study) + ")\n";
    return std::string{firstWords} + contentHash(text) + ": " + cleanLine(study) + "\n" + text;
}

std::string keptScriptFault(const std::filesystem::path& path) {
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) return {};
    if (const auto text = readFile(path.string(), limits::maxTableBytes)) {
        const std::size_t end = text.value.find('\n');
        if (text.value.starts_with(firstWords) && end != std::string::npos &&
            text.value.substr(firstWords.size()).starts_with(contentHash(text.value.substr(end + 1))))
            return {};
    }
    return path.string() +
           ": expected no file, or the script as physvib wrote it; this one is somebody's work: rename it";
}

} // namespace physvib
