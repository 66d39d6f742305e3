// SPDX-License-Identifier: MIT
// Minimal XML pull parser that delivers the texts of innermost elements, in memory bounded by the file. It
// refuses document type declarations and expands no entities, so that untrusted files can neither grow nor
// open other files.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

class XmlLeaves {
public:
    enum class Next { leaf, closed, end, fault };

    explicit XmlLeaves(std::string_view text) noexcept
        : rest_{text} {}

    /// leaf: an element with text alone has ended. closed: an element with children has ended. Any thread.
    Next next();

    /// Element names from the outermost to the one that has ended.
    const std::vector<std::string_view>& path() const noexcept { return path_; }
    std::string_view text() const noexcept { return text_; } ///< of a leaf, trimmed
    std::size_t line() const noexcept { return line_; }
    const std::string& fault() const noexcept { return fault_; } ///< what was expected

private:
    static constexpr std::size_t deepest = 16;

    Next fail(std::string expected);
    std::string_view take(std::size_t bytes) noexcept;
    bool skipTo(std::string_view end);
    bool open(std::string_view tag);
    Next close(std::string_view name);

    std::string_view rest_, text_;
    std::vector<std::string_view> path_;
    bool isLeaf_ = false, hasEnded_ = false; ///< isLeaf_: only text since the last element began; hasEnded_:
                                             ///< the last of path_ has ended
    std::size_t line_ = 1;
    std::string fault_;
};

} // namespace physvib
