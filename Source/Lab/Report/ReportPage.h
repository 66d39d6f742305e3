// SPDX-License-Identifier: MIT
// A page of HTML that needs nothing but itself: no network, no script; A4 when printed. What comes from files
// is escaped here.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

class ReportPage {
public:
    /// `mark`: stands below the title, if not empty.
    ReportPage(std::string title, bool isSimulated, std::string mark = {});

    void heading(std::string_view words);
    void subheading(std::string_view words);
    void paragraph(std::string_view words);
    void notes(const std::vector<std::string>& lines); ///< one box
    /// a warning, or what is not there and why
    void note(std::string_view words) { notes({std::string(words)}); }
    void lines(std::string_view words); ///< as `analyse` prints them
    void call(std::string_view words);  ///< of the program
    void list(const std::vector<std::string>& items);
    /// CSV text, comments and all; at most so many rows, and where the others are. Folded: shown by a click,
    /// and never in print.
    void table(std::string_view csv, std::string_view file, std::size_t mostRows = 60, bool isFolded = false);
    /// Charts beside each other, one caption.
    void figure(const std::vector<std::string>& svgs, std::string_view caption);
    void link(std::string_view file, std::string_view words);

    /// The whole file.
    std::string html() const;

private:
    void element(std::string_view tag, std::string_view words);
    std::string title_, mark_, body_;
    bool isSimulated_;
    int figures_ = 0;
};

} // namespace physvib
