// SPDX-License-Identifier: MIT
// Iterates over the lines of a text, or of a file without loading all of it.
#pragma once
#include "Io/Text/CsvText.h"
#include <cstdio>
#include <string>
#include <string_view>

namespace physvib {

/// Text and file must outlive it. One thread at a time.
class TextLines {
public:
    static constexpr std::size_t maxLineBytes = 1'000'000; ///< limit for a line of a file

    explicit TextLines(std::string_view text)
        : unread_{text} {}
    /// Reads from the current position; does not close the file.
    explicit TextLines(std::FILE* file)
        : file_{file} {}
    TextLines(const TextLines&) = delete;
    TextLines& operator=(const TextLines&) = delete;
    TextLines(TextLines&&) = delete;

    /// The next line without its end, until the next call; false if there is none, or it is too long.
    bool next(std::string_view& line) {
        while (file_ != nullptr && unread_.find('\n') == std::string_view::npos)
            if (!readMore()) return false;
        if (unread_.empty()) return false;
        line = takeUntil('\n', unread_);
        return true;
    }

    bool isTooLong() const noexcept { return isTooLong_; } ///< why next() returned false

private:
    bool readMore() {
        constexpr std::size_t blockBytes = 65536;
        isTooLong_ = unread_.size() > maxLineBytes;
        if (isTooLong_) return false;
        block_.erase(0, block_.size() - unread_.size()); // the unread rest
        const std::size_t unreadBytes = block_.size();
        block_.resize(unreadBytes + blockBytes);
        const std::size_t count = std::fread(block_.data() + unreadBytes, 1, blockBytes, file_);
        if (count == 0) file_ = nullptr; // end of file, or a read error
        block_.resize(unreadBytes + count);
        unread_ = block_;
        return true;
    }

    std::string_view unread_;
    std::string block_; // last block of a file; unread_ views its end
    std::FILE* file_ = nullptr;
    bool isTooLong_ = false;
};

} // namespace physvib
