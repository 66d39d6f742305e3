// SPDX-License-Identifier: MIT
// Compares existing files by their identity in the file system, others by folder and name.
#include "Io/Disk/FileClash.h"
#include <algorithm>
#include <system_error>

namespace physvib {
namespace {

namespace fs = std::filesystem;

constexpr int mostLinks = 40; // limit for consecutive links, as in operating systems

std::string clash(const std::string& output, const std::string& kind, const std::string& other) {
    return output + ": expected another file to write, this is the " + kind + " " + other;
}

} // namespace

fs::path folderOf(const fs::path& file) {
    return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

bool isSameFile(const fs::path& a, const fs::path& b) {
    std::error_code code;
    if (fs::exists(a, code) || fs::exists(b, code)) return fs::equivalent(a, b, code) && !code;
    return a.filename() == b.filename() && fs::equivalent(folderOf(a), folderOf(b), code) && !code;
}

bool isWithin(const fs::path& folder, const fs::path& path) {
    std::error_code failed;
    const fs::path home = fs::canonical(folder.empty() ? fs::path(".") : folder, failed);
    if (failed) return false;
    fs::path at = fs::absolute(path, failed);
    // also for a link whose target does not exist
    for (int links = 0; links < mostLinks && !failed && fs::is_symlink(at, failed); ++links)
        at = at.parent_path() / fs::read_symlink(at, failed);
    failed.clear(); // error of a target that does not exist
    const fs::path found = fs::weakly_canonical(at, failed);
    return !failed && std::ranges::mismatch(home, found).in1 == home.end();
}

// Two spellings of a new file that only the file system considers equal ("A.wav", "a.wav") are detected when
// they are created: see AtomicFile.
std::string fileClash(std::span<const std::string> outputs, std::span<const std::string> inputs) {
    const auto sameAs = [](const std::string& path) {
        return [&path](const std::string& other) { return !other.empty() && isSameFile(path, other); };
    };
    for (auto output = outputs.begin(); output != outputs.end(); ++output) {
        if (output->empty()) continue;
        if (const auto input = std::ranges::find_if(inputs, sameAs(*output)); input != inputs.end())
            return clash(*output, "input", *input);
        if (const auto other = std::find_if(outputs.begin(), output, sameAs(*output)); other != output)
            return clash(*output, "output", *other);
    }
    return {};
}

} // namespace physvib
