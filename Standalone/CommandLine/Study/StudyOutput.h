// SPDX-License-Identifier: GPL-3.0-or-later
// What the study commands share: files in, warnings, tables and pictures out.
#pragma once
#include "CommandLine/ExitCode.h"
#include "Files/Disk/AtomicFile.h"
#include "Files/Text/CsvTable.h"
#include "Files/Disk/FileLimits.h"
#include "Files/Text/NumberText.h"
#include "Files/Provenance.h"
#include "Files/Disk/ReadFile.h"
#include "Files/StudyCsv.h"
#include "Pictures/StudyPictures.h"
#include <functional>
#include <iostream>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

inline std::string percent(double share) { return fixedNumber(100.0 * share, 1); }

inline std::string chanceWords(double p) { return p < 0.001 ? "p < 0.001" : "p = " + fixedNumber(p, 3); }

inline void warn(const std::string& words) { tell("warning: " + words); }

/// What an analysis reads.
struct StudySources {
    std::vector<std::string> files;
    std::vector<ColumnName> columns{};                          ///< of another program's tables
    const std::map<std::string, std::string>* made = nullptr;   ///< tables by their names that are not on the disk (yet); they have our columns
};

/// Reads every file and gives the texts to `reader` at once.
template <class Reader>
auto readStudyFiles(const StudySources& sources, Reader reader, std::size_t mostBytes = limits::maxTableBytes) -> decltype(reader(std::vector<NamedText>{})) {
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

/// Says in which files a result is a simulated observer's; no person's figures may be mistaken for it.
inline void tellIfSimulated(bool isSimulated) {
    if (isSimulated) std::cout << "SIMULATED: a simulated observer answered, not a person\n";
}

/// A file to write: its bytes are made only if it is wanted.
struct StudyFile {
    std::string path; ///< empty: not wanted
    std::function<std::string()> bytes;
    StudyFile(std::string where, std::function<std::string()> make)
        : path{std::move(where)}, bytes{std::move(make)} {}
    StudyFile(std::string where, std::string text)
        : path{std::move(where)}, bytes{[text = std::move(text)] { return text; }} {}
};

/// Writes all of them, or none; the code to leave with.
int writeStudyFiles(const std::vector<StudyFile>& files);

/// What stands around a picture of these files' results.
PictureWords pictureWords(const std::vector<std::string>& files, bool isSimulated);

/// A table that grows cell by cell, for statistics packages.
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
