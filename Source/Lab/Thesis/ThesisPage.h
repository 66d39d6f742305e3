// SPDX-License-Identifier: MIT
// List of the thesis' parts with the call that reproduces each, a page on them, and the printed results.
#pragma once
#include "Lab/Report/ReportBuilder.h"
#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// Sections, equations, figures, tables or studies of the thesis that one call reproduces.
struct ThesisEntry {
    std::string sections;     ///< "Fig. 3.4, Eq. 3.1"
    std::string subject;      ///< what these sections are about
    std::string call;         ///< the call; empty: none
    std::string requirements; ///< hands, hardware or participants that it needs; empty: none
    std::string misprint;     ///< a misprint in the thesis; empty: none
    std::string difference;   ///< how PhysVib differs; empty: no difference is known
};

/// All rows, in the order of the thesis; those of studies list the remaining deviations of the version as
/// published. Created on first use; any thread.
const std::vector<ThesisEntry>& thesisEntries();

/// A page about the thesis under construction, with the files beside it.
struct ThesisPage {
    ReportPage page;
    std::map<std::string, std::string> files{}; ///< name -> bytes, without index.html

    /// Adds the table to page and files.
    void addTable(const std::string& name, const std::string& csv, std::size_t maxRows = 100) {
        files[name] = csv;
        page.addTable(csv, name, maxRows);
    }
    /// Adds charts, each also as a file NAME.svg or NAME-2.svg.
    void addFigure(const std::string& name, const std::vector<std::string>& charts,
                   const std::string& caption);
};

/// The table, drawings of chapter 3, and results computed from printed numbers. Message thread only.
ThesisPage thesisPage();

} // namespace physvib

// Printed results of the thesis' five studies, for comparison. Comments mark misprints.

namespace physvib::thesis {

/// A condition of absolute identification: 3.2.2, 4.1.2.
struct Identification {
    std::string_view study, condition; ///< names in the built-in protocols
    std::size_t stimuli = 0;
    double bits = 0.0, percentCorrect = 0.0;            ///< exact; percent 0: not printed by condition
    double bitsTolerance = 0.0, percentTolerance = 0.0; ///< one step of tolerance; 0: none
};

inline constexpr std::array identifications{
    Identification{"patterns", "PHONE-2", 28, 4.55},
    Identification{"patterns", "PHONE-3", 78, 6.03},
    Identification{"patterns", "PHONE-4", 168, 7.06},
    Identification{"patterns", "RING-2", 28, 4.55},
    Identification{"patterns", "RING-3", 78, 6.06},
    Identification{"patterns", "RING-4", 168, 6.92},
    Identification{"phantom-grids", "PHONE-3x3", 9, 1.89, 74.0, 2.76, 93.4},
    Identification{"phantom-grids", "PHONE-4x4", 16, 1.77, 45.3, 3.04, 82.3},
    Identification{"phantom-grids", "PHONE-5x5", 25, 1.76, 30.6, 3.00, 70.2},
    Identification{"phantom-grids", "RING-3x3", 9, 2.53, 88.7, 3.05, 98.4},
    Identification{"phantom-grids", "RING-4x4", 16, 2.32, 61.7, 3.50, 92.6},
    Identification{"phantom-grids", "RING-5x5", 25, 2.28, 45.1, 2.62, 83.5},
};

/// Fig. 4.9 a, row by row, 7 x 5. The figure's tables are in the order PHONE-LINEAR, PHONE-LOGARITHM,
/// RING-LINEAR, RING-LOGARITHM: their standard deviations are those that the text gives by condition; its
/// captions are not in that order.
struct Counts {
    std::string_view condition;
    double deviation = 0.0;            ///< standard deviation in the thesis
    std::size_t columns = 0, rows = 0; ///< of the merged grid
    std::array<double, 35> percent{};
};

inline constexpr std::size_t printedColumns = 7, printedRows = 5;
inline constexpr std::array counts{
    Counts{"PHONE-LINEAR", 1.32, 5, 5, {2.87, 3.18, 3.39, 3.46, 3.22, 2.62, 3.45, 0.01, 1.60,
                                        3.26, 1.42, 2.77, 0.76, 1.20, 6.51, 1.22, 3.14, 4.20,
                                        3.64, 1.74, 3.11, 3.45, 1.17, 1.95, 3.77, 3.57, 1.03,
                                        3.53, 2.84, 2.56, 3.99, 5.41, 4.15, 2.42, 3.35}},
    Counts{"PHONE-LOGARITHM", 1.97, 5, 4, {6.36, 1.78, 4.90, 0.69, 6.77, 1.46, 4.05, 3.25, 0.47,
                                           1.12, 2.19, 0.47, 1.58, 1.04, 6.23, 0.78, 2.75, 3.18,
                                           1.92, 0.74, 3.55, 2.15, 0.01, 2.59, 2.59, 3.05, 2.46,
                                           4.37, 6.15, 0.64, 4.44, 2.95, 7.29, 3.40, 2.66}},
    Counts{"RING-LINEAR", 1.33, 6, 4, {3.18, 3.88, 3.80, 3.79, 3.35, 3.97, 3.50, 2.30, 1.79, 0.54, 1.17, 0.38,
                                       1.38, 1.16, 2.77, 2.44, 3.71, 7.25, 3.23, 2.47, 2.93, 2.59, 1.56, 1.65,
                                       3.62, 3.28, 1.26, 3.32, 2.32, 2.88, 2.79, 5.02, 2.73, 3.92, 4.07}},
    Counts{"RING-LOGARITHM", 1.11, 7, 4, {3.69, 4.93, 3.10, 2.22, 1.44, 3.63, 3.60, 2.09, 2.20,
                                          1.34, 0.87, 2.53, 1.06, 1.56, 3.25, 2.52, 3.16, 6.54,
                                          2.93, 3.05, 2.90, 1.65, 1.78, 3.04, 3.44, 3.12, 2.29,
                                          2.97, 2.62, 3.56, 2.29, 3.90, 3.24, 4.05, 3.45}},
};

} // namespace physvib::thesis
