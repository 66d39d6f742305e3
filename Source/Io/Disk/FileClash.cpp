// SPDX-License-Identifier: MIT
// Compares existing files by their identity in the file system, others by folder and name.
#include "Io/Disk/FileClash.h"
#include <algorithm>
#include <system_error>

namespace physvib {
namespace {

namespace fs = std::filesystem;

constexpr int maxLinks = 40; // limit for consecutive links, as in operating systems

std::string clashMessage(const std::string& output, const std::string& kind, const std::string& other) {
    return output + ": expected another file to write, this is the " + kind + " " + other;
}

} // namespace

fs::path parentFolder(const fs::path& file) {
    return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

bool isSameFile(const fs::path& a, const fs::path& b) {
    std::error_code code;
    if (fs::exists(a, code) || fs::exists(b, code)) return fs::equivalent(a, b, code) && !code;
    return a.filename() == b.filename() && fs::equivalent(parentFolder(a), parentFolder(b), code) && !code;
}

bool isWithin(const fs::path& folder, const fs::path& path) {
    std::error_code code;
    const fs::path canonicalFolder = fs::canonical(folder.empty() ? fs::path(".") : folder, code);
    if (code) return false;
    fs::path linkTarget = fs::absolute(path, code);
    // weakly_canonical() does not follow a link to a file that does not exist
    for (int links = 0; links < maxLinks && !code && fs::is_symlink(linkTarget, code); ++links)
        linkTarget = linkTarget.parent_path() / fs::read_symlink(linkTarget, code);
    code.clear(); // set if the last target does not exist
    const fs::path canonicalPath = fs::weakly_canonical(linkTarget, code);
    return !code && std::ranges::mismatch(canonicalFolder, canonicalPath).in1 == canonicalFolder.end();
}

// Two spellings of a new file that only the file system considers equal ("A.wav", "a.wav") are detected when
// they are created: see AtomicFile.
std::string fileClashError(std::span<const std::string> outputs, std::span<const std::string> inputs) {
    const auto sameAs = [](const std::string& path) {
        return [&path](const std::string& other) { return !other.empty() && isSameFile(path, other); };
    };
    for (auto output = outputs.begin(); output != outputs.end(); ++output) {
        if (output->empty()) continue;
        if (const auto input = std::ranges::find_if(inputs, sameAs(*output)); input != inputs.end())
            return clashMessage(*output, "input", *input);
        if (const auto other = std::find_if(outputs.begin(), output, sameAs(*output)); other != output)
            return clashMessage(*output, "output", *other);
    }
    return {};
}

} // namespace physvib
