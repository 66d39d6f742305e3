// SPDX-License-Identifier: GPL-3.0-or-later
// Splits a byte stream into lines. Overlong lines are discarded, except that "silence" in them is reported.
#pragma once
#include "Live/Documents/InputLine.h"
#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

namespace physvib {

/// `take(std::string_view line, bool isWhole)` is called once per line. For a line longer than `longest`,
/// isWhole is false and the line is "silence" if it contains that word, else empty. One thread at a time.
class LineCutter {
public:
    static constexpr std::size_t longest = 65'536; // far above any valid line

    template <class Take>
    void add(std::string_view bytes, Take&& take) {
        for (std::size_t end = bytes.find('\n'); end != std::string_view::npos; end = bytes.find('\n')) {
            keep(bytes.substr(0, end));
            hand(take);
            bytes.remove_prefix(end + 1);
        }
        keep(bytes);
    }

    /// Ends the stream; text without a final newline is a line too.
    template <class Take>
    void end(Take&& take) {
        if (!line_.empty() || isTooLong_) hand(take);
    }

private:
    void keep(std::string_view part) {
        line_ += part;
        isTooLong_ = isTooLong_ || line_.size() > longest;
        if (!isTooLong_) return;
        namesSilence_ = namesSilence_ || namesSilence(line_);
        // keeps the end, which may be the first part of the word
        line_.erase(0, line_.size() - std::min(line_.size(), word.size() - 1));
    }
    template <class Take>
    void hand(Take&& take) {
        take(!isTooLong_ ? std::string_view{line_} : namesSilence_ ? word : "", !isTooLong_);
        line_.clear();
        isTooLong_ = namesSilence_ = false;
    }

    static constexpr std::string_view word = "silence";
    std::string line_;
    bool isTooLong_ = false, namesSilence_ = false;
};

} // namespace physvib
