// SPDX-License-Identifier: MIT
// Reads a whole file as text, or opens a regular file, with error messages; and the size limits of texts,
// tables, sounds and JSON that are read.
#pragma once
#include "Io/Disk/SystemFile.h"
#include "Io/Result.h"
#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>

namespace physvib {
struct FileCloser {
    void operator()(std::FILE* file) const noexcept { std::fclose(file); }
};
using FileHandle = std::unique_ptr<std::FILE, FileCloser>;

inline Failure readFailure(const std::filesystem::path& path, const std::string& reason) {
    return {path.string() + ": cannot be read: " + reason};
}
inline Failure readFailure(const std::filesystem::path& path, int code) {
    if (code == EINVAL || code == EISDIR)
        return readFailure(path, "expected a file or a pipe, found a folder or a device");
    return readFailure(path, code == EPIPE ? "no program writes to this pipe"
                                           : std::generic_category().message(code));
}
inline Failure tooLongFailure(const std::filesystem::path& path, std::size_t maxBytes) {
    return {path.string() + ": expected at most " + std::to_string(maxBytes) + " bytes, found more"};
}

constexpr std::size_t maxPipeBytes = 64'000'000; ///< because a pipe has no size and may never end

/// The bytes of a file or pipe, at most `maxBytes`, of a pipe also at most `maxPipeBytes`. Not on the render
/// thread.
inline Result<std::string> readFile(const std::filesystem::path& path, std::size_t maxBytes) {
    const FileHandle file{openForReading(path)};
    if (!file) return readFailure(path, errno);
    std::string text;
    std::error_code sizeError; // pipes have no size: the buffer grows
    if (const auto bytes = std::filesystem::file_size(path, sizeError); sizeError)
        maxBytes = std::min(maxBytes, maxPipeBytes);
    else if (bytes > maxBytes)
        return tooLongFailure(path, maxBytes);
    else
        text.reserve(bytes);
    std::array<char, 4096> block; // small, because stacks may be small
    while (const std::size_t count = std::fread(block.data(), 1, block.size(), file.get())) {
        text.append(block.data(), count);
        if (text.size() > maxBytes) return tooLongFailure(path, maxBytes);
    }
    if (std::ferror(file.get())) return readFailure(path, errno);
    return text;
}

/// The result of read(text, name) for a file, or the error of reading it. Message thread only.
template <class Read>
std::invoke_result_t<Read, std::string_view, std::string_view> loadText(const std::filesystem::path& path,
                                                                        std::size_t maxBytes, Read read) {
    const Result<std::string> text = readFile(path, maxBytes);
    if (!text) return Failure{text.error};
    return read(text.value, path.string());
}

struct RegularFile {
    FileHandle stream;
    std::size_t bytes = 0;
};

/// Opens a regular, seekable file of at most `maxBytes` at its beginning. Refuses folders, and pipes and
/// devices, which may block or never end. Any thread.
inline Result<RegularFile> openRegularFile(const std::filesystem::path& path, std::size_t maxBytes) {
    std::error_code code;
    const auto status = std::filesystem::status(path, code); // before opening, because opening a pipe blocks
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
        return readFailure(path, "expected a regular file, found a folder, a device or a pipe");
    RegularFile file{FileHandle{openStream(path, "rb")}};
    if (!file.stream) return readFailure(path, errno);
    file.bytes = std::filesystem::file_size(path, code);
    if (code) return readFailure(path, code.message());
    if (file.bytes > maxBytes) return tooLongFailure(path, maxBytes);
    return file;
}
} // namespace physvib

// Limits of texts, tables and sound files that are read, each with its reason.

namespace physvib::limits {
constexpr std::size_t maxTableRows = 1'000'000;   // an analysis needs three columns
constexpr std::size_t maxTableCells = 3'000'000;  // 150,000 trials of twenty columns: a thousand participants
constexpr std::size_t maxTableBytes = 64'000'000; // for tables of usually 200 bytes per trial
constexpr std::size_t maxTableColumns = 256;      // a trial has twenty; an exported matrix one per response
constexpr std::size_t maxCellBytes = 200'000; // the longest cell has the presentations of a trial: 64 parts
                                              // of 2000 bytes (Protocol.h), and their levels
constexpr std::int64_t maxRecordingSeconds = 600;        // a longer contact or stimulus is a mistake
constexpr std::int64_t maxRecordingSamples = 32'000'000; // of all channels: one channel of that length at 48
                                                         // kHz, 128 MB
constexpr std::size_t maxRecordingFileBytes = 256'000'000; // maxRecordingSamples of 64 bits
constexpr std::int64_t maxMusicSeconds = 86'400;           // read block by block: a day
constexpr std::size_t maxMusicFileBytes = 64'000'000'000;  // a day of two channels of 32 bits at 92 kHz
constexpr int maxRecordingChannels = 64;                   // the maximum number of outputs
// from slow accelerometers to the fastest converters
constexpr int minRecordingRateHz = 100, maxRecordingRateHz = 768'000;
constexpr std::size_t maxNameBytes = 200; // names and labels: one line on a screen
constexpr std::size_t maxJsonDepth = 16;  // our formats need fourteen levels
// number of characters , : [ { in a JSON text: a constant, and one per 8 bytes (an input has one per 12)
constexpr std::size_t maxJsonMarks = 1'000'000, jsonBytesPerMark = 8;
} // namespace physvib::limits
