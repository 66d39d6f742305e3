// SPDX-License-Identifier: MIT
// Temporary siblings, renames, and sentences for what can go wrong with them.
#include "Files/AtomicFile.h"
#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>

namespace physvib {
namespace {

namespace fs = std::filesystem;

std::string reasonOf(int code) {
    return std::generic_category().message(code);
}

/// Opens and closes; 0 or the error number.
int tryOpen(const fs::path& path, const char* mode) {
    std::FILE* const file = std::fopen(path.string().c_str(), mode);
    return file != nullptr && std::fclose(file) == 0 ? 0 : errno;
}

/// Why nothing may be put at `target`; empty if something may.
std::string obstacle(const fs::path& target) {
    std::error_code code;
    const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
    if (!target.has_filename()) return "it names a folder, expected a file";
    const bool isThere = fs::exists(folder, code);
    if (code) return code.message();
    if (!isThere) return "the folder " + folder.string() + " does not exist";
    const fs::file_status present = fs::status(target, code);
    if (!fs::exists(present)) return {};
    if (!fs::is_regular_file(present)) return "expected a regular file, found a folder, a device or a pipe";
    const int denied = tryOpen(target, "r+b"); // a rename would not ask
    return denied == 0 ? std::string() : reasonOf(denied);
}

/// Creates the first free name.part, name.part2, ...; 0 or the error number.
int createSibling(const fs::path& target, fs::path& sibling) {
    constexpr int mostWriters = 1000; // at once, or left behind by a power cut
    int code = EEXIST;
    for (int i = 1; i <= mostWriters && code == EEXIST; ++i) {
        sibling = target;
        sibling += i == 1 ? ".part" : ".part" + std::to_string(i);
        code = tryOpen(sibling, "wbx");
    }
    return code;
}

} // namespace

AtomicFile::AtomicFile(const fs::path& path)
    : named_(path)
    , target_(path) {
    if (const std::string reason = prepare(); !reason.empty()) fail(reason);
}

AtomicFile::~AtomicFile() {
    removeTemporary();
}

const std::string& AtomicFile::write(std::string_view bytes) {
    if (!error_.empty()) return error_;
    std::FILE* const stream = std::fopen(temporary_.string().c_str(), "wb");
    bool written = stream != nullptr && std::fwrite(bytes.data(), 1, bytes.size(), stream) == bytes.size();
    int code = errno;
    if (stream != nullptr && std::fclose(stream) != 0 && written) {
        written = false;
        code = errno;
    }
    if (written) return error_;
    fail(reasonOf(code));
    removeTemporary();
    return error_;
}

const std::string& AtomicFile::commit() {
    if (!error_.empty()) return error_;
    std::error_code code;
    // Best effort: the permissions of another owner's file cannot always be copied.
    if (const fs::file_status present = fs::status(target_, code); fs::exists(present))
        fs::permissions(temporary_, present.permissions(), code);
    fs::rename(temporary_, target_, code);
    if (code) {
        fail(code.message());
        removeTemporary();
    }
    temporary_.clear();
    return error_;
}

std::string AtomicFile::prepare() {
    std::error_code code;
    if (fs::is_symlink(named_, code)) {
        target_ = fs::weakly_canonical(named_, code);
        if (code) return code.message();
    }
    if (std::string reason = obstacle(target_); !reason.empty()) return reason;
    fs::path sibling;
    if (const int denied = createSibling(target_, sibling); denied != 0) return reasonOf(denied);
    temporary_ = std::move(sibling);
    return {};
}

void AtomicFile::fail(std::string_view reason) {
    error_ = named_.string() + ": cannot be written: ";
    error_ += reason;
}

void AtomicFile::removeTemporary() noexcept {
    std::error_code ignored;
    if (!temporary_.empty()) fs::remove(temporary_, ignored);
    temporary_.clear();
}

std::string writeFile(const fs::path& path, std::string_view bytes) {
    AtomicFile file(path);
    file.write(bytes);
    return file.commit();
}

} // namespace physvib
