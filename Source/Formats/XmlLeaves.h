// SPDX-License-Identifier: MIT
// Minimal XML pull parser that delivers the texts of innermost elements, in memory bounded by the file. It
// refuses document type declarations and expands no entities, so that untrusted files can neither grow nor
// open other files.
#pragma once
#include "Io/Text/NumberText.h"
#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace physvib {

class XmlLeaves {
public:
    enum class Next { leaf, closed, end, fault };

    explicit XmlLeaves(std::string_view text) noexcept
        : rest_{text} {}

    /// leaf: an element with text alone has ended. closed: an element with children has ended. Any thread.
    Next next() {
        if (std::exchange(hasEnded_, false)) path_.pop_back();
        for (;;) {
            const std::string_view before = take(rest_.find('<'));
            if (rest_.empty())
                return path_.empty() ? Next::end
                                     : fail("expected </" + printable(path_.back()) + ">, found the end");
            if (isLeaf_) text_ = trimmed(before);
            if (rest_.starts_with("<!--") || rest_.starts_with("<?")) {
                if (!skipTo(rest_[1] == '!' ? "-->" : "?>"))
                    return fail("expected the end of a comment, found the end");
                continue;
            }
            if (rest_.starts_with("<!"))
                return fail("expected elements and text alone, found " + inQuotes(rest_.substr(0, 9)));
            const std::size_t end = endOfTag(rest_);
            if (end == std::string_view::npos) return fail("expected the end of a tag, found the end");
            const std::string_view tag = take(end + 1).substr(1, end - 1);
            if (tag.starts_with('/')) return close(trimmed(tag.substr(1)));
            if (!open(tag))
                return fail("expected at most 16 elements within each other, each with a name, found " +
                            inQuotes(tag));
            if (tag.ends_with('/')) return close(path_.back());
        }
    }

    /// Element names from the outermost to the one that has ended.
    const std::vector<std::string_view>& path() const noexcept { return path_; }
    std::string_view text() const noexcept { return text_; } ///< of a leaf, trimmed
    std::size_t line() const noexcept { return line_; }
    const std::string& fault() const noexcept { return fault_; } ///< what was expected

private:
    static constexpr std::string_view space = " \t\r\n";
    static std::string_view trimmed(std::string_view text) {
        const std::size_t from = text.find_first_not_of(space);
        return from == std::string_view::npos ? std::string_view{}
                                              : text.substr(from, text.find_last_not_of(space) - from + 1);
    }
    /// End of a tag: a > in quotes is part of an attribute.
    static std::size_t endOfTag(std::string_view text) {
        char quote = 0;
        for (std::size_t i = 0; i < text.size(); ++i) {
            if (quote != 0)
                quote = text[i] == quote ? '\0' : quote;
            else if (text[i] == '"' || text[i] == '\'')
                quote = text[i];
            else if (text[i] == '>')
                return i;
        }
        return std::string_view::npos;
    }

    static constexpr std::size_t deepest = 16;

    Next fail(std::string expected) {
        fault_ = std::move(expected);
        return Next::fault;
    }
    std::string_view take(std::size_t bytes) noexcept {
        const std::string_view taken = rest_.substr(0, bytes);
        line_ += static_cast<std::size_t>(std::ranges::count(taken, '\n'));
        rest_.remove_prefix(taken.size());
        return taken;
    }
    bool skipTo(std::string_view end) {
        const std::size_t at = rest_.find(end);
        take(at == std::string_view::npos ? rest_.size() : at + end.size());
        return at != std::string_view::npos;
    }
    bool open(std::string_view tag) {
        const std::string_view name = tag.substr(0, tag.find_first_of(" \t\r\n/"));
        if (name.empty() || path_.size() == deepest) return false;
        path_.push_back(name);
        isLeaf_ = true;
        text_ = {};
        return true;
    }
    Next close(std::string_view name) {
        if (path_.empty() || path_.back() != name)
            return fail("expected " +
                        (path_.empty() ? std::string{"an element"} : "</" + printable(path_.back()) + ">") +
                        ", found </" + printable(name) + ">");
        hasEnded_ = true;
        return std::exchange(isLeaf_, false) ? Next::leaf : Next::closed;
    }

    std::string_view rest_, text_;
    std::vector<std::string_view> path_;
    bool isLeaf_ = false, hasEnded_ = false; ///< isLeaf_: only text since the last element began; hasEnded_:
                                             ///< the last of path_ has ended
    std::size_t line_ = 1;
    std::string fault_;
};

} // namespace physvib
