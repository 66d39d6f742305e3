// SPDX-License-Identifier: MIT
// Iterates over the lines of a text, or of a file without loading all of it.
#pragma once
#include "Io/Text/CsvText.h"
#include <cstdio>
#include <string>
#include <string_view>

namespace physvib {

class TextLines {
public:
    static constexpr std::size_t mostBytes = 1'000'000; // limit for a line of a file

    explicit TextLines(std::string_view text)
        : rest_{text} {}
    /// Reads from the current position; does not close the file.
    explicit TextLines(std::FILE* file)
        : file_{file} {}
    TextLines(const TextLines&) = delete;
    TextLines& operator=(const TextLines&) = delete;
    TextLines(TextLines&&) = delete;

    /// The next line without its end, until the next call; false if there is none, or it is too long.
    bool next(std::string_view& line) {
        while (file_ != nullptr && rest_.find('\n') == std::string_view::npos)
            if (!readMore()) return false;
        if (rest_.empty()) return false;
        line = takeUntil('\n', rest_);
        return true;
    }

    bool isTooLong() const noexcept { return isTooLong_; }

private:
    bool readMore() {
        constexpr std::size_t most = 65536;
        isTooLong_ = rest_.size() > mostBytes;
        if (isTooLong_) return false;
        block_.erase(0, block_.size() - rest_.size()); // the unread rest
        const std::size_t begun = block_.size();
        block_.resize(begun + most);
        const std::size_t count = std::fread(block_.data() + begun, 1, most, file_);
        if (count == 0) file_ = nullptr; // end of file, or a read error
        block_.resize(begun + count);
        rest_ = block_;
        return true;
    }

    std::string_view rest_;
    std::string block_; // of a file; rest_ is its end
    std::FILE* file_ = nullptr;
    bool isTooLong_ = false;
};

} // namespace physvib
