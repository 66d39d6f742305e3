// SPDX-License-Identifier: MIT
// The texts of an XML file's innermost elements, one after the other, in no more memory than the file. No
// declarations of types, no entities but in what nobody reads, so nothing grows and nothing else is opened.
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

    /// leaf: an element that holds text alone has ended. closed: one that holds others has. Any thread.
    Next next();

    /// Names from the outermost to the one that has ended.
    const std::vector<std::string_view>& path() const noexcept { return path_; }
    std::string_view text() const noexcept { return text_; } ///< of a leaf, without space around it
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
    bool isLeaf_ = false, hasEnded_ = false; ///< nothing but text since the last element began; path_'s last
                                             ///< has ended
    std::size_t line_ = 1;
    std::string fault_;
};

} // namespace physvib
