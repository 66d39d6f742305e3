// SPDX-License-Identifier: MIT
// An HTML page without network access or scripts, for screen and A4. Text from files is escaped here.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

class ReportPage {
public:
    /// `mark` is shown below the title if it is not empty.
    ReportPage(std::string title, bool isSimulated, std::string mark = {});

    void heading(std::string_view words);
    void subheading(std::string_view words);
    void paragraph(std::string_view words);
    void notes(const std::vector<std::string>& lines); ///< in one box
    /// A warning, or why something is missing.
    void note(std::string_view words) { notes({std::string(words)}); }
    void lines(std::string_view words); ///< preformatted text, as `analyse` prints it
    void list(const std::vector<std::string>& items);
    /// A table from CSV text with comments, of at most `mostRows` rows and the columns that have a value. A
    /// folded table opens on a click and is not printed.
    void table(std::string_view csv, std::string_view file, std::size_t mostRows = 60, bool isFolded = false);
    /// Charts side by side with one caption.
    void figure(const std::vector<std::string>& svgs, std::string_view caption);

    /// The complete file.
    std::string html() const;

private:
    void element(std::string_view tag, std::string_view words);
    std::string title_, mark_, body_;
    bool isSimulated_;
    int figures_ = 0;
};

} // namespace physvib
