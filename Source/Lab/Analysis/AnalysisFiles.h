// SPDX-License-Identifier: MIT
// Helpers of the analyses: reading input files, formatting text, and writing tables.
#pragma once
#include "Io/Disk/FileLimits.h"
#include "Io/Disk/ReadFile.h"
#include "Io/Provenance.h"
#include "Io/Text/CsvTable.h"
#include "Io/Text/NumberText.h"
#include "Lab/Files/StudyCsv.h"
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

inline std::string percent(double share) { return fixedNumber(100.0 * share, 1); }

/// A printable label of any length. It is not truncated, so labels that differ only at the end stay distinct.
inline std::string wholeLabel(std::string_view label) {
    constexpr std::size_t piece = 40; // printable() truncates longer text
    std::string words;
    for (; label.size() > piece; label.remove_prefix(piece)) words += printable(label.substr(0, piece));
    return words + printable(label);
}

/// Input files of an analysis.
struct StudySources {
    std::vector<std::string> files;
    std::vector<ColumnName> columns{}; ///< column mapping for tables of another program
    /// tables in memory by name, with our columns; used instead of files
    const std::map<std::string, std::string>* made = nullptr;
    bool operator==(const StudySources&) const = default;
};

/// Reads all files, then calls `reader` once with their texts.
template <class Reader>
auto readStudyFiles(const StudySources& sources, Reader reader, std::size_t mostBytes = limits::maxTableBytes)
    -> decltype(reader(std::vector<NamedText>{})) {
    std::vector<std::string> texts(sources.files.size());
    std::vector<NamedText> files;
    for (std::size_t i = 0; i < texts.size(); ++i) {
        const std::string& path = sources.files[i];
        if (sources.made)
            if (const auto found = sources.made->find(path); found != sources.made->end()) {
                files.push_back({found->second, path});
                continue;
            }
        auto text = readFile(path, mostBytes);
        if (!text) return Failure{text.error};
        texts[i] = std::move(text.value);
        files.push_back({texts[i], path, sources.columns});
    }
    return reader(files);
}

/// CSV table for statistics packages, written cell by cell.
class ExportTable {
public:
    ExportTable(std::string_view kind, bool isSimulated, std::string_view header) {
        Provenance provenance{PHYSVIB_VERSION, {{"analysis", std::string(kind)}}};
        if (isSimulated) provenance.entries.emplace_back("observer", "simulated");
        text_ = provenanceComment(provenance);
        text_.append(header).append("\n");
    }
    ExportTable& cell(std::string_view words) {
        separate();
        appendCell(text_, words);
        return *this;
    }
    ExportTable& cell(double number) {
        separate();
        appendNumber(text_, number);
        return *this;
    }
    ExportTable& cell(std::size_t number) {
        separate();
        appendNumber(text_, number);
        return *this;
    }
    /// An empty cell for nullopt.
    ExportTable& cell(const std::optional<double>& number) {
        return number ? cell(*number) : cell(std::string_view{});
    }
    template <class... Values>
    ExportTable& cells(const Values&... values) {
        return (cell(values), ...);
    }
    /// The last cells of a row, or all.
    template <class... Values>
    void row(const Values&... values) {
        cells(values...).endRow();
    }
    void endRow() {
        text_ += '\n';
        isFirst_ = true;
    }
    const std::string& text() const { return text_; }

private:
    void separate() {
        if (!isFirst_) text_ += ',';
        isFirst_ = false;
    }
    std::string text_;
    bool isFirst_ = true;
};

} // namespace physvib
