// SPDX-License-Identifier: GPL-3.0-or-later
// Cuts what arrives into lines; of one that is too long nothing is taken for another line, but that it names
// silence.
#pragma once
#include "Live/Documents/InputLine.h"
#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

namespace physvib {

/// `take(std::string_view line, bool isWhole)` is called for each line, once; of one that is longer than
/// `longest`, with false and the word "silence" if it stands in it, else nothing. One thread at a time.
class LineCutter {
public:
    static constexpr std::size_t longest = 65'536; // no line of ours comes near

    template <class Take>
    void add(std::string_view bytes, Take&& take) {
        for (std::size_t end = bytes.find('\n'); end != std::string_view::npos; end = bytes.find('\n')) {
            keep(bytes.substr(0, end));
            hand(take);
            bytes.remove_prefix(end + 1);
        }
        keep(bytes);
    }

    /// Nothing comes after this: what has no newline is a line as well.
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
        line_.erase(0, line_.size() - std::min(line_.size(), word.size() - 1)); // its last part may be half
                                                                                // of the word
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
