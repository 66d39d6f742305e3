// SPDX-License-Identifier: MIT
// The thesis beside PhysVib: where each part of it is, and what it prints beside what follows from it.
#pragma once
#include "Lab/Report/ReportPage.h"
#include <map>
#include <string>
#include <vector>

namespace physvib {

/// Sections, equations, figures, tables or studies of the thesis that one call reproduces.
struct ThesisRow {
    std::string at;       ///< "Fig. 3.4, Eq. 3.1"
    std::string what;     ///< in a few words
    std::string run;      ///< the call; empty: none
    std::string needs;    ///< what no program has: hands, hardware, participants; empty: nothing
    std::string misprint; ///< what the print cannot mean; empty: nothing
    std::string differs;  ///< how PhysVib does it otherwise; empty: no difference is known
};

/// All rows, in the order of the thesis; those of studies tell the deviations that their version as published
/// has left. Made on first use; any thread.
const std::vector<ThesisRow>& thesisRows();

/// at,what,run,needs,misprint,differs. Any thread (allocates).
std::string thesisRowsCsv();

/// A page about the thesis under construction, with the files beside it.
struct ThesisPage {
    ReportPage page;
    std::map<std::string, std::string> files{}; ///< name -> bytes, without index.html

    /// Adds the table to page and files.
    void addTable(const std::string& name, const std::string& csv, std::size_t mostRows = 100) {
        files[name] = csv;
        page.table(csv, name, mostRows);
    }
    /// Adds charts, each also as a file NAME.svg or NAME-2.svg.
    void addFigure(const std::string& name, const std::vector<std::string>& charts,
                   const std::string& caption);
};

/// The table, drawings of chapter 3, and what is reckoned from printed numbers. M only.
ThesisPage thesisPage();

} // namespace physvib
